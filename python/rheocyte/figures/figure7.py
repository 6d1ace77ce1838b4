"""Figure 7: the study of beads on virtual ones. How well do moduli read off a recording meet those that it was made with?

The paper measured beads of polyacrylamide and compared with atomic-force microscopy. Here the truth is known: a small
table of neo-Hookean spheres is computed, virtual beads get their shapes from it and are rendered to pixels; then their
moduli are read off, by the paper's quadratic spline and by the table.
"""

import csv
import hashlib

import numpy as np

from rheocyte import colours
from rheocyte.density import Density, thinned
from rheocyte.figures import style
from rheocyte.figures.cases import last_line, make_folder, toml
from rheocyte.files import InputError, number, read_table, reason, write_text

CONDITIONS = {"channel.width_um": 20.0, "flow.rate_ul_per_s": 0.08, "flow.viscosity_mPas": 7.9}
LEVELS_KPA = [2.405, 3.607, 4.809, 6.011, 7.213, 9.618, 12.023]  # the paper's lines
AREA_UM2, HALF_WIDTH_UM2 = 144.0, 2.0  # the beads whose moduli are printed
BEADS, MEAN_KPA, DEVIATION_KPA = 3000, 5.5, 1.1
RADIUS_UM, RADIUS_DEVIATION_UM = 6.87, 0.2  # pixels make the areas some 3 % smaller: 144 um^2 are measured
TABLE = {**CONDITIONS, "flow.density_kg_per_m3": 1000.0, "cell.bulk.law": "neo-hookean", "table.identifier": "BEADS-7",
         "table.stiffness": "cell.bulk.young_modulus_kPa", "table.min_area_um2": 105, "table.max_area_um2": 205,
         "table.min_deformation": 3e-4, "table.max_deformation": 0.06, "table.radii": 7,
         "table.rows_per_radius": 80, "table.accuracy": 1e-3}
QUANTILES = [0.05, 0.25, 0.5, 0.75, 0.95]
NORMAL = np.array([-1.6449, -0.6745, 0, 0.6745, 1.6449])  # of the normal distribution at these


def make(laboratory):
    """The figure and the rows of its table."""
    table = computed_table(laboratory)
    states = read_states(table / f"table_{TABLE['table.identifier']}.csv")
    spec = {"recording.cells": BEADS, "recording.pictures": "none", "recording.sample": "virtual beads", **CONDITIONS,
            "cell.radius_um.mean": RADIUS_UM, "cell.radius_um.sd": RADIUS_DEVIATION_UM,
            "cell.bulk.young_modulus_kPa.mean": MEAN_KPA, "cell.bulk.young_modulus_kPa.sd": DEVIATION_KPA,
            "shapes.table": str(table.resolve())}
    beads, moduli = measured_beads(laboratory, spec, table)
    lines = [line(states, level) for level in LEVELS_KPA]
    chosen = np.abs(beads[:, 0] - AREA_UM2) <= HALF_WIDTH_UM2
    spline = QuadraticSpline(*points_at_area(lines))
    methods = {"paper's spline,\nas measured": spline(beads[chosen, 1]),
               "table,\nas measured": moduli["plain"][chosen],
               "table,\ndeformation\ncorrected": moduli["deformation"][chosen],
               "own way: both\ncorrected": moduli["own"][chosen]}
    boxes = {name: box(values) for name, values in methods.items()}
    boxes["truth"] = {"count": BEADS, "quantiles": MEAN_KPA + DEVIATION_KPA * NORMAL}
    return draw(beads, lines, boxes), [row(name, one) for name, one in boxes.items()]


def computed_table(laboratory):
    """The folder of the table; one that is there already, of the same spec, is used again."""
    text = toml(TABLE)
    folder = laboratory.folder / f"beads-table-{hashlib.sha256(text.encode()).hexdigest()[:8]}"
    make_folder(laboratory.folder)
    file = folder.with_suffix(".toml")
    write_text(file, text)
    laboratory.tell(f"table of {TABLE['table.radii']} radii in {folder}")
    finish(laboratory, "table", file, "-o", folder)
    return folder


def finish(laboratory, *arguments):
    """A call of the program that must succeed."""
    ended = laboratory.call(*arguments)
    if ended.returncode != 0:
        raise InputError(last_line(ended.stderr) or f"`rheocyte {arguments[0]}` ended without a word.")


def measured_beads(laboratory, spec, table):
    """Area and deformation (n, 2) of virtual beads, and their moduli by the table: in the way of the field's programs,
    without and with its correction for pixels, and in rheocyte's own."""
    lut = table / f"lut_{TABLE['table.identifier']}.txt"
    file, recording = laboratory.folder / "beads.toml", laboratory.folder / "beads.rtdc"
    write_text(file, toml(spec))
    laboratory.tell(f"{BEADS} virtual beads in {recording}")
    finish(laboratory, "synth", file, "-o", recording, "--force")
    moduli = {}
    for name, source, options in (("plain", lut, ["--no-pixelation"]), ("deformation", lut, []), ("own", table, [])):
        finish(laboratory, "extract", recording, "--table", source, "--viscosity-mPas", CONDITIONS["flow.viscosity_mPas"], "-o",
               laboratory.folder / f"beads-{name}", *options)
        events = read_events(laboratory.folder / f"beads-{name}" / "beads_rheocyte.tsv")
        moduli[name] = events[:, 2]
    return events[:, :2], moduli


def read_events(path):
    """Area, deformation and modulus (n, 3) of a table of events; NaN where there is none."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader((text for text in file if not text.startswith("#")), delimiter="\t"))
        return np.array([[float(one[key]) for key in ("area_um2", "deformation", "young_modulus_kPa")] for one in rows])
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error


def read_states(path):
    """States of the table by radius: a list of arrays (n, 3) of modulus, area and deformation, by falling modulus."""
    columns = ["radius_um", "young_modulus_kPa", "area_um2", "deformation"]
    values = np.array([[number(one, column, path) for column in columns] for one in read_table(path, columns)])
    return [values[values[:, 0] == radius, 1:] for radius in np.unique(values[:, 0])]


def line(states, level):
    """Area and deformation (n, 2) at one modulus, by radius; radii whose states do not reach it are left out."""
    points = []
    for branch in states:
        falling = branch[np.argsort(branch[:, 0])]
        if falling[0, 0] <= level <= falling[-1, 0]:
            place = np.log(level), np.log(falling[:, 0])
            points.append([np.interp(*place, falling[:, 1]), np.exp(np.interp(*place, np.log(falling[:, 2])))])
    return np.array(points)


def points_at_area(lines):
    """Deformations and moduli where the lines have the beads' area, by growing deformation."""
    found = [(np.interp(AREA_UM2, *points.T), level) for points, level in zip(lines, LEVELS_KPA)
             if len(points) > 1 and points[0, 0] <= AREA_UM2 <= points[-1, 0]]
    if len(found) < 3:
        raise InputError(f"the table has only {len(found)} of the paper's moduli at {AREA_UM2:g} um^2; remove its folder.")
    return np.array(sorted(found)).T


class QuadraticSpline:
    """The piecewise quadratic function with a continuous slope through points of growing x; knots lie midway between
    them, but not beside the ends. NaN outside the points."""

    def __init__(self, x, y):
        middles = (x[1:] + x[:-1]) / 2
        self.knots = np.concatenate([[x[0]] * 3, middles[1:-1], [x[-1]] * 3])
        self.ends = x[0], x[-1]
        self.weights = np.linalg.solve(self.basis(x), y)

    def basis(self, x):
        """Values (n, functions) of the B-splines by the recurrence of Cox and de Boor."""
        t = self.knots
        inside = np.clip(np.atleast_1d(x), *self.ends)[:, None]
        last = np.searchsorted(t, self.ends[1]) - 1  # the interval that owns the right end
        values = ((t[:-1] <= inside) & (inside < t[1:])).astype(float)
        values[inside[:, 0] == self.ends[1], :] = np.arange(len(t) - 1) == last
        for degree in (1, 2):
            with np.errstate(invalid="ignore", divide="ignore"):
                up = (inside - t[:-degree - 1]) / (t[degree:-1] - t[:-degree - 1])
                down = (t[degree + 1:] - inside) / (t[degree + 1:] - t[1:-degree])
            values = np.nan_to_num(up, posinf=0, neginf=0) * values[:, :-1] + np.nan_to_num(
                down, posinf=0, neginf=0) * values[:, 1:]
        return values

    def __call__(self, x):
        value = (self.basis(x) @ self.weights).reshape(np.shape(x))
        return np.where((x >= self.ends[0]) & (x <= self.ends[1]), value, np.nan)


def box(values):
    """Number and quantiles of the moduli that are numbers."""
    good = values[np.isfinite(values)]
    if len(good) == 0:
        raise InputError("no bead has a modulus; remove the folder of the beads' table and try again.")
    return {"count": len(good), "quantiles": np.quantile(good, QUANTILES)}


def row(name, one):
    """A line of the table."""
    return {"moduli": name.replace("\n", " "), "beads": one["count"],
            **{f"quantile_{fraction:g}_kPa": f"{value:.4f}" for fraction, value in zip(QUANTILES, one["quantiles"])}}


def draw(beads, lines, boxes):
    """Beads between the paper's lines on the left, boxes of the moduli on the right."""
    figure = style.new_figure(2.75, layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_beads(left, beads, lines)
    draw_boxes(right, boxes)
    return figure


def draw_beads(axes, beads, lines):
    """Events coloured by density, isoelasticity lines, and the areas that are chosen."""
    rectangle = ((100.0, 190.0), (0.0, 0.045))
    axes.set(xlim=rectangle[0], ylim=rectangle[1], xlabel="area (µm²)", ylabel="deformation",
             title="a   virtual beads as measured, with 0.34 µm pixels")
    axes.axvspan(AREA_UM2 - HALF_WIDTH_UM2, AREA_UM2 + HALF_WIDTH_UM2, color="#eef1f4", linewidth=0)
    for points, level in zip(lines, LEVELS_KPA):
        if len(points) < 2:
            continue
        axes.plot(*points.T, color="#7d8891", linewidth=0.7)
        height = np.interp(rectangle[0][1], *points.T)
        if height < rectangle[1][1]:
            axes.annotate(f"{1000 * level:.0f} Pa", (rectangle[0][1], height), xytext=(3, 0), fontsize=5.6,
                          textcoords="offset points", color="#56616b", va="center", annotation_clip=False)
    seen = Density(*beads.T, rectangle).at(*beads.T)
    kept = thinned(seen, 8000)
    axes.scatter(*beads[kept].T, c=seen[kept], s=2.6, cmap="viridis", linewidths=0, rasterized=True, zorder=2)


def draw_boxes(axes, boxes):
    """Medians, quartiles, whiskers at 5 and 95 %."""
    stats = [{"whislo": q[0], "q1": q[1], "med": q[2], "q3": q[3], "whishi": q[4]}
             for q in (one["quantiles"] for one in boxes.values())]
    drawn = axes.bxp(stats, showfliers=False, widths=0.5, patch_artist=True,
                     medianprops={"color": colours.INK, "linewidth": 1.1}, whiskerprops={"linewidth": 0.7},
                     capprops={"linewidth": 0.7})
    for patch, colour in zip(drawn["boxes"], ["#f2d7cf", "#dbe3ea", "#b9d4e6", "#bfe3c8", "#fdf0cf"]):
        patch.set(facecolor=colour, linewidth=0.7)
    truth = boxes["truth"]["quantiles"][2]
    axes.axhline(truth, color=colours.INK, linewidth=0.6, dashes=(4, 3), zorder=0)
    axes.set_xticks(range(1, len(boxes) + 1), list(boxes), fontsize=5.4)
    greatest = max(one["quantiles"][-1] for one in boxes.values())
    axes.set(ylabel="Young's modulus (kPa)", ylim=(0, 1.2 * greatest),
             title=f"b   moduli of beads of {AREA_UM2:g} ± {HALF_WIDTH_UM2:g} µm²")
    for place, one in enumerate(boxes.values(), start=1):
        change = "" if place == len(boxes) else style.percent(one["quantiles"][2] / truth - 1)
        axes.annotate(f"{one['quantiles'][2]:.2f} kPa\n{change}", (place, one["quantiles"][4]), xytext=(0, 3),
                      textcoords="offset points", ha="center", fontsize=6)
