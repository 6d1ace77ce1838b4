"""python -m rheocyte.population_picture DIR: pictures of what `rheocyte population` found, from population.json in DIR.

Writes, as PNG and SVG: population (Young's moduli, one dot a session, the ratios, the cells) and population-checks (what the
fitted cells predict against what was measured). Exit code 2 and one sentence if the file is missing or damaged.
"""

import json
import sys
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullFormatter

from rheocyte import colours, dose_picture, former_population, page
from rheocyte.files import InputError, reason, run, save_figure
from rheocyte.figures.style import STYLE

OF_CONDITIONS = ("#2f6fa8", "#d0572b", "#3d7a4a", "#8a5a9e", "#b08a1e", "#5b6770", "#c05a86", "#1f8a8a", "#7b5a3a", "#3b3f8f")
LONGEST_NAME, POINTS_OF_LETTER = 24, 3.9
FAINT, BAND = "#aab3bb", "#eef1f4"
SHARE_OF_PLACE = 0.5  # of the distance between conditions, over which their sessions are spread
WORDS = {"ln A": "area", "c3": "asymmetry c3", "c4": "c4", "c5": "c5", "d": "deformation"}
YOUNG = {"quantity": "young_modulus", "median": "young_modulus_median_kPa"}
STIFFNESS = {"quantity": "stiffness", "median": "stiffness_median_kPa", "symbol": "E + E2D/r0", "unit": "kPa"}
DAMAGE = (AttributeError, KeyError, TypeError)  # of a record that is not whole
MOST_OFF = 1.0  # of a spread, drawn in the checks


def read_record(folder):
    """The dictionary of population.json in a folder."""
    path = Path(folder) / "population.json"
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    except ValueError as error:
        raise InputError(f"{path} is damaged: {error}.") from error
    if not isinstance(record, dict) or record.get("made_by") != "rheocyte population":
        raise InputError(f"{path} is not a file of rheocyte population.")
    try:
        return former_population.renamed(record)
    except DAMAGE as error:
        raise InputError(f"{path} is damaged: {error}.") from error


class Story:
    """What the pictures need of a record."""

    def __init__(self, record):
        self.record = record
        self.conditions = record["conditions"]
        self.names = [each["condition"] for each in self.conditions]
        self.paired = any(each["test"] == "paired t" for each in record["comparisons"])

    def colour(self, name):
        """Of a condition."""
        return OF_CONDITIONS[self.names.index(name) % len(OF_CONDITIONS)]

    def recordings(self, name):
        """Those of a condition in the order of their sessions."""
        return [each for each in self.record["recordings"] if each["condition"] == name]

    def modulus(self, name, session, median):
        """The number of this column in a recording, NaN where there is none."""
        return next((interval_of(each, median)[0] for each in self.recordings(name) if each["session"] == session), np.nan)

    def comparisons(self, quantity):
        """Those of a quantity."""
        return [each for each in self.record["comparisons"] if each["quantity"] == quantity]

    def places(self, name, centre):
        """Of the sessions of a condition, round its own place."""
        count = len(self.recordings(name))
        return centre + SHARE_OF_PLACE * (np.arange(count) - (count - 1) / 2) / max(count, 3)


def interval_of(row, name, ends=None):
    """Value, lower and upper end in a row of the record; NaN where there is none."""
    found = (row.get(each) for each in (name, f"{ends or name}_low", f"{ends or name}_high"))
    return tuple(np.nan if value is None else value for value in found)


def draw(record):
    """The figure of moduli, ratios and cells."""
    story = Story(record)
    return draw_several(story) if record["model"] != "solid" else draw_solids(story)


def draw_solids(story):
    """Young's moduli, their ratios, and the cells."""
    compared = bool(story.record["comparisons"])
    widths = [1 + 0.35 * len(story.names), 0.75 + 0.45 * len(story.record["comparisons"]), 1.7]
    figure = page.new_figure(page.WIDTH_IN, 2.75, STYLE, layout="constrained")
    axes = list(figure.subplots(1, 3 if compared else 2, width_ratios=widths if compared else widths[::2]))
    draw_moduli(axes.pop(0), story, YOUNG["median"], "median Young's modulus (kPa)")
    if compared:
        draw_ratios(axes.pop(0), story, YOUNG, "ratio of the medians")
    draw_cells(axes.pop(0), story)
    draw_legend(figure, story)
    return figure


def draw_several(story):
    """A column for each quantity: its medians, and below them the ratios."""
    quantities = story.record["quantities"] or [STIFFNESS]
    compared = bool(story.record["comparisons"])
    figure = page.new_figure(page.WIDTH_IN, 4.4 if compared else 2.75, STYLE, layout="constrained")
    panels = figure.subplots(2 if compared else 1, len(quantities), squeeze=False)
    for column, each in enumerate(quantities):
        draw_moduli(panels[0, column], story, each["median"], f"{each['symbol']} ({each['unit']})")
        if compared and dose_picture.has_doses(story.record, each["quantity"]):
            dose_picture.draw_doses(panels[1, column], story, each, ratios_of)
        elif compared and story.comparisons(each["quantity"]):
            draw_ratios(panels[1, column], story, each, "ratio")
        elif compared:
            panels[1, column].set_visible(False)
    draw_legend(figure, story)
    return figure


def draw_moduli(axes, story, median, title):
    """One dot a session with its interval, the condition beside them."""
    axes.set_title(title)
    if story.paired:
        draw_pairs(axes, story, median)
    for centre, name in enumerate(story.names):
        colour = story.colour(name)
        for place, recording in zip(story.places(name, centre), story.recordings(name)):
            draw_recording(axes, place, recording, median, colour)
        value, lower, upper = interval_of(story.conditions[centre], median)
        if np.isfinite(value):
            draw_mean(axes, centre + 0.36, (value, lower, upper), colour)
    axes.set_xlim(-0.5, len(story.names) - 0.4)
    name_places(axes, [shortened(name) for name in story.names])
    scaled(axes, [value for each in story.record["recordings"] for value in interval_of(each, median)])


def shortened(name):
    """A name of a condition where there is little room."""
    return name if len(name) <= LONGEST_NAME else name[:LONGEST_NAME - 1] + "\u2026"


def name_places(axes, names):
    """Words below the places 0, 1, ...; slanted where they would lie on one another."""
    slots = axes.get_subplotspec().get_gridspec()
    fraction = (slots.get_width_ratios() or [1] * slots.ncols)[axes.get_subplotspec().colspan.start]
    width = 0.8 * 72 * axes.figure.get_size_inches()[0] * fraction / sum(slots.get_width_ratios() or [1] * slots.ncols)
    longest = max(len(line) for name in names for line in name.split("\n"))
    is_crowded = longest * POINTS_OF_LETTER * len(names) > width
    axes.set_xticks(range(len(names)), names)
    axes.tick_params(axis="x", length=0)
    if is_crowded:
        for label in axes.get_xticklabels():
            label.set(rotation=40, ha="right", rotation_mode="anchor", fontsize=6)


def draw_pairs(axes, story, median):
    """Lines that join the recordings of a session."""
    for k in range(len(story.recordings(story.names[0]))):
        across = [story.places(name, centre)[k] for centre, name in enumerate(story.names)]
        axes.plot(across, [interval_of(story.recordings(name)[k], median)[0] for name in story.names], color=FAINT,
                  linewidth=0.7, zorder=1)


def draw_recording(axes, place, recording, median, colour):
    """A full dot, an open one where the checks do not hold, an arrow where there is a limit alone."""
    value, lower, upper = interval_of(recording, median)
    if not np.isfinite(value):
        for side, end in (("above", 1.25), ("below", 0.8)):
            if limit := recording.get(median.replace("_median_", f"_{side}_")):
                axes.annotate("", (place, limit * end), (place, limit), arrowprops={"arrowstyle": "->", "color": colour})
                axes.plot(place, limit, "_", color=colour, markersize=6)
        return
    fits = all(check["fits"] for check in recording["checks"])
    axes.plot([place] * 2, [lower, upper], color=colour, linewidth=0.8, zorder=2)
    axes.plot(place, value, "o", markersize=4.4, markeredgewidth=0.9, markeredgecolor=colour,
              markerfacecolor=colour if fits else "white", zorder=3)


def draw_mean(axes, place, interval, colour):
    """A bar for the interval and a diamond for the mean."""
    value, lower, upper = interval
    axes.plot([place] * 2, [lower, upper], color=colour, linewidth=2.4, alpha=0.35, solid_capstyle="butt", zorder=2)
    axes.plot(place, value, "D", markersize=5, color=colour, zorder=3)


def scaled(axes, values):
    """Logarithmic over a factor of four and more; room at both ends."""
    known = np.array([value for value in values if np.isfinite(value)])
    if len(known) == 0:
        return
    if known.max() > 4 * known.min():
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.yaxis.set_minor_formatter(NullFormatter())
    else:
        axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
    axes.margins(y=0.08)


def draw_ratios(axes, story, quantity, title):
    """One dot a session, and the mean with its interval; 1 is no difference."""
    comparisons = story.comparisons(quantity["quantity"])
    axes.set_title(title)
    axes.axhline(1, color=colours.INK, linewidth=0.6, zorder=0)
    for place, each in enumerate(comparisons):
        colour = story.colour(each["treated"])
        ratios = ratios_of(story, each, quantity["median"])
        spread = SHARE_OF_PLACE * (np.arange(len(ratios)) - (len(ratios) - 1) / 2) / max(len(ratios), 3)
        axes.plot(place + spread, ratios, "o", markersize=4.4, color=colour, zorder=3)
        by_recordings = each["p"] is not None
        interval = interval_of(each, "ratio", None if by_recordings else "ratio_by_sampling")
        draw_mean(axes, place + 0.36, interval, colour)
        words = f"p = {each['p']:.2g}" if by_recordings else "no p"
        axes.annotate(f"{interval[0]:.3f}\n{words}", (place, 1), (0, -1), xycoords=("data", "axes fraction"),
                      textcoords="offset points", ha="center", va="top", fontsize=6)
    axes.set_xlim(-0.5, len(comparisons) - 0.4)
    name_places(axes, [f"{shortened(each['treated'])} /\n{shortened(each['control'])}" for each in comparisons])
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.05 * (high - low), high + 0.28 * (high - low))  # for the words


def ratios_of(story, comparison, median):
    """Of each session if they are pairs; else of each recording to the mean of the control."""
    treated, control = (story.recordings(comparison[name]) for name in ("treated", "control"))
    values = [interval_of(each, median)[0] for each in treated]
    if comparison["test"] == "paired t":
        return [value / story.modulus(comparison["control"], each["session"], median) for value, each in zip(values, treated)]
    mean = np.exp(np.mean([np.log(interval_of(each, median)[0]) for each in control]))
    return [value / mean for value in values]


def draw_cells(axes, story):
    """The distributions of E of the cells, and what single images have, noise and all."""
    axes.set_title("the cells")
    ends = []
    for name in story.names:
        known = [each for each in story.recordings(name) if np.isfinite(interval_of(each, YOUNG["median"])[0])]
        for cells in known:
            middle, spread = np.log(cells[YOUNG["median"]]), cells["young_modulus_ln_spread"]
            at = np.linspace(middle - 3.2 * spread, middle + 3.2 * spread, 160)
            axes.plot(np.exp(at), np.exp(-0.5 * ((at - middle) / spread) ** 2) / spread / np.sqrt(2 * np.pi),
                      color=story.colour(name), linewidth=0.9, zorder=3)
            ends += [middle - 3.2 * spread, middle + 3.2 * spread]
        draw_single_images(axes, known, story.colour(name))
    axes.set_xscale("log")
    if ends:
        axes.set_xlim(np.exp(min(ends) - 0.2), np.exp(max(ends) + 0.2))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(FuncFormatter(lambda value, _: f"{value:g}" if f"{value:.0e}"[0] in "235" else ""))
    axes.tick_params(axis="x", which="minor", labelsize=6)
    axes.set(xlabel="Young's modulus (kPa)", yticks=[], ylim=(0, None))
    axes.spines["left"].set_visible(False)


def draw_single_images(axes, known, colour):
    """Steps: the density of the moduli of single images of all recordings of a condition, with those that have none."""
    histograms = [cells["moduli_of_single_images"] for cells in known if cells.get("moduli_of_single_images")]
    if not histograms:
        return
    step = 1.5 * max(each["step"] for each in histograms)
    first = min(each["ln_modulus_from"] for each in histograms)
    last = max(each["ln_modulus_from"] + each["step"] * len(each["counts"]) for each in histograms)
    edges = np.arange(first, last + step, step)
    total, events = np.zeros(len(edges) - 1), 0
    for each in histograms:
        below = np.concatenate([[0], np.cumsum(each["counts"])])
        ends = each["ln_modulus_from"] + each["step"] * np.arange(len(below))
        total += np.diff(np.interp(edges, ends, below))
        events += below[-1] + each["without"]
    axes.stairs(total / max(events, 1) / step, np.exp(edges), color=colour, alpha=0.16, fill=True, linewidth=0, zorder=1)


def draw_legend(figure, story):
    """What the signs mean, below the axes."""
    level = f"{100 * story.record['level']:g} %"
    dot = {"linestyle": "", "marker": "o", "markersize": 4.4, "color": "#5b6770"}
    entries = [Line2D([], [], **dot, label=f"a recording, with the {level} interval of its events"),
               Line2D([], [], linestyle="", marker="D", markersize=4.6, color="#5b6770",
                      label=f"condition, with the {level} interval by {how_known(story)}")]
    if story.record["model"] == "solid":
        entries += [Line2D([], [], color="#5b6770", linewidth=0.9, label="cells of a recording, without noise"),
                    Line2D([], [], color="#5b6770", linewidth=5, alpha=0.25, label="moduli of single images")]
    if any(not check["fits"] for each in story.record["recordings"] for check in each["checks"]):
        entries.insert(1, Line2D([], [], **dot, markerfacecolor="white", label="checks do not hold"))
    legend_below(figure, entries, 3, columnspacing=1.6, handlelength=1.6, labelspacing=0.25)


def how_known(story):
    """What the intervals of the conditions come from."""
    first = (story.record["quantities"] or [STIFFNESS])[0]["quantity"]
    intervals_by = (each.get(f"{first}_interval_by") for each in story.conditions)
    by_recordings = {each == "scatter of the recordings" for each in intervals_by if each}
    return {(True,): "its recordings", (False,): "sampling alone"}.get(tuple(by_recordings), "its recordings (one: by sampling)")


def legend_below(figure, entries, columns, **style):
    """A legend below all axes, for which the layout leaves room: matplotlib 3.6 knows no place "outside"."""
    points, height = 5.8, figure.get_size_inches()[1]
    fraction = (-(-len(entries) // columns) * 1.5 * points / 72 + 0.05) / height
    figure.get_layout_engine().set(rect=(0, fraction, 1, 1 - fraction))
    figure.legend(handles=entries, loc="lower center", ncols=columns, frameon=False, fontsize=points, **style)


def draw_checks(record):
    """One panel a measure: quantiles of the fitted cells less those that were measured, in spreads. None if nothing was
    checked."""
    story = Story(record)
    checked = [each for each in record["recordings"] if each["checks"]]
    if not checked:
        return None
    measures = [check["measure"] for check in checked[0]["checks"]]
    columns = 3
    rows = -(-len(measures) // columns)
    figure = page.new_figure(page.WIDTH_IN, 0.5 + 1.45 * rows, STYLE, layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, measure in zip(panels.flat, measures):
        draw_measure(axes, story, measure, [(each, check_of(each, measure)) for each in checked])
    for axes in list(panels.flat)[len(measures):]:
        axes.set_visible(False)
    for axes in panels[-1]:
        axes.set_xlabel("fraction of the events below")
    for axes in panels[:, 0]:
        axes.set_ylabel("predicted \u2212 measured\n(in spreads)")
    legend_below(figure, [Line2D([], [], color=story.colour(name), label=name) for name in story.names],
                 min(len(story.names), 6))
    return figure


def check_of(recording, measure):
    """The check of one measure, None if it was not checked."""
    return next((check for check in recording["checks"] if check["measure"] == measure), None)


def draw_measure(axes, story, measure, checks):
    """A line for each recording; flat at 0 if the fitted cells are the measured ones."""
    fractions = np.arange(1, 20) * 0.05
    known = [(recording, check) for recording, check in checks if check]
    axes.axhspan(-0.2, 0.2, color=BAND, zorder=0, linewidth=0)
    axes.axhline(0, color=FAINT, linewidth=0.6, zorder=1)
    for recording, check in known:
        off = np.subtract(check["predicted_quantiles"], check["measured_quantiles"]) / (check["spread"] or 1)
        axes.plot(fractions, off, color=story.colour(recording["condition"]), linewidth=0.8 if check["fits"] else 1.4,
                  linestyle="-" if check["fits"] else (0, (3, 1.2)), zorder=2)
    misfits = sum(not check["fits"] for _, check in known)
    fitted = known and known[0][1]["fitted"]
    axes.set_title(f"{WORDS.get(measure, measure)}{' (fitted)' if fitted else ''}", pad=9)
    words = f"fits in all {len(known)}" if misfits == 0 else f"does not fit in {misfits} of {len(known)}"
    axes.annotate(words, (0, 1), (0, 2), xycoords="axes fraction", textcoords="offset points", fontsize=6,
                  color=colours.ALARM if misfits else "#56616b")
    axes.set(xlim=(0, 1), ylim=(-MOST_OFF, MOST_OFF))


def main():
    """Command line."""
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        raise InputError("give the folder of the results: python -m rheocyte.population_picture DIR.")
    folder = Path(sys.argv[1])
    record = read_record(folder)
    try:
        figures = {"population": draw(record), "population-checks": draw_checks(record)}
    except DAMAGE as error:
        raise InputError(f"{folder / 'population.json'} is damaged: {error}.") from error
    for name, figure in figures.items():
        if figure:
            save_figure(figure, folder / name)


if __name__ == "__main__":
    run(main)
