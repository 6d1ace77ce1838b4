"""Figure real-cells: whether the cells of recordings have the shapes of the model, and both moduli of each recording; with
a combined table also their median outlines over those of the model."""

import subprocess
from pathlib import Path

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from rheocyte.figures import median_outlines, style
from rheocyte.files import InputError, read_table

ELONGATED, OF_THE_MODEL, DOUBTFUL = style.LINEAR, style.SECOND, style.ANALYTICAL
COLOURS = {"elongated": ELONGATED, "model": OF_THE_MODEL, "doubtful": DOUBTFUL, "other-table": DOUBTFUL,
           "rounder": DOUBTFUL, "unknown": "#9aa3ab"}
WANTED = ["recording", "shapes", "inertia_ratio_median", "inertia_ratio_expected", "shape_excess_median",
          "shape_excess_median_error", "elongated_percent", "odd_fraction_median", "red_cells", "deformation_change",
          "deformation_change_error", "young_modulus_median_kPa", "young_modulus_first_quartile_kPa",
          "young_modulus_third_quartile_kPa", "young_modulus_elongated_median_kPa",
          "young_modulus_elongated_first_quartile_kPa", "young_modulus_elongated_third_quartile_kPa",
          "deformation_over_elongated_modulus", "with_elongation", "recommended_modulus",
          "recommended_young_modulus_median_kPa", "axial_tension_median_Pa", "shapes_text", "trend_text", "remarks"]


def make(laboratory):
    """The figure and the rows of its table."""
    rows = [row for row in read_rows(laboratory) if row["shapes"]]
    if not rows:
        raise InputError("no recording could be used; `rheocyte extract` says why.")
    cells = median_outlines.median_cells(laboratory) if laboratory.table else {}
    height = 1.1 + 0.24 * len(rows)
    if not cells:
        figure = style.new_figure(height, layout="constrained")
        draw(figure, rows)
        return figure, rows
    outlines = 1.6 * median_outlines.rows_of(len(cells))
    figure = style.new_figure(height + outlines, layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=[height, outlines])
    draw(above, rows)
    median_outlines.draw(below, cells)
    return figure, rows


def read_rows(laboratory):
    """One row per recording from the summary of `rheocyte extract`."""
    folder = Path(laboratory.folder) / "real-cells"
    summary = folder / "rheocyte_summary.tsv"
    summary.unlink(missing_ok=True)
    call = [laboratory.program, "extract", "--quiet", "-o", folder, *laboratory.recordings, *laboratory.options]
    ended = subprocess.run(list(map(str, call)), capture_output=True, text=True, check=False)
    for line in ended.stderr.splitlines():
        laboratory.tell(line)
    if not summary.exists():
        raise InputError(ended.stderr.strip().splitlines()[-1] if ended.stderr.strip() else "extract failed")
    return [{name: row.get(name, "") for name in WANTED} for row in read_table(summary, ["recording", "shapes"], "\t")]


def value(row, name):
    """A number of the summary; NaN where there is none."""
    return float(row[name]) if row[name] else np.nan


def label(row):
    """The name of the recording, short."""
    name = Path(row["recording"]).stem
    return name if len(name) <= 26 else name[:12] + "…" + name[-12:]


def draw(figure, rows):
    """Measured and expected inertia ratios, and moduli from deformation and as of elongated cells."""
    ratios, moduli = figure.subplots(1, 2, sharey=True)
    places = np.arange(len(rows))[::-1]
    for place, row in zip(places, rows):
        colour = COLOURS[row["shapes"]]
        measured, expected = value(row, "inertia_ratio_median"), value(row, "inertia_ratio_expected")
        ratios.plot([expected, measured], [place, place], color=colour, linewidth=0.8)
        ratios.plot(expected, place, "o", markerfacecolor="white", color=colour, markersize=4)
        ratios.plot(measured, place, "o", color=colour, markersize=4)
        for name, offset, face in (("young_modulus", 0.12, "white"), ("young_modulus_elongated", -0.12, colour)):
            low, middle, high = (value(row, f"{name}_{part}_kPa") for part in ("first_quartile", "median",
                                                                               "third_quartile"))
            moduli.plot([low, high], [place + offset] * 2, color=colour, linewidth=1)
            moduli.plot(middle, place + offset, "s", markerfacecolor=face, color=colour, markersize=4)
    ratios.set_yticks(places, [label(row) for row in rows], fontsize=6)
    ratios.set(title="a   inertia ratio: ○ expected, ● measured", xlabel="inertia ratio",
               ylim=(-0.7, len(rows) - 0.3))
    ratios.axvline(1, color="#9aa3ab", linewidth=0.6, zorder=0)
    moduli.set(title="b   from □ deformation, ■ elongated cells", xlabel="Young's modulus (kPa), median and quartiles",
               xscale="log")
    moduli.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    moduli.xaxis.set_major_formatter(FuncFormatter(lambda kPa, _: f"{kPa:g}"))
    moduli.xaxis.set_minor_locator(NullLocator())
    for name, text, x in (("model", "shapes of the model", 0.02), ("doubtful", "doubtful", 0.42),
                          ("elongated", "elongated", 0.66)):
        moduli.text(x, 1.0, text, color=COLOURS[name], fontsize=6, va="bottom", transform=moduli.transAxes)
    moduli.set_title(moduli.get_title(loc="left"), loc="left", pad=12)
    ratios.set_title(ratios.get_title(loc="left"), loc="left", pad=12)
