"""python -m rheocyte.event_plot DIR OUT: area against deformation of the events of recordings, one panel each.

DIR holds plot.json and the events of each panel, as `rheocyte plot` writes them: pairs of 32-bit numbers, area (um^2)
and deformation. Writes OUT.png and OUT.svg.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.collections import Collection
from matplotlib.colors import PowerNorm
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from rheocyte import colours, page
from rheocyte.density import Density, levels_enclosing, thinned
from rheocyte.files import InputError, reason, run, save_figure
from rheocyte.figures.style import STYLE
from rheocyte.page import thousands

AXES_IN = np.array([2.6, 2.15])
MARGINS_IN = (0.5, 0.4, 0.42, 0.67)  # of each panel: left, right, bottom, top
LEGEND_IN = 0.26  # below all panels
GREATEST_NUMBER = 12000  # of events drawn in a panel; all count for colours and contours
STANDARD_AREA, STANDARD_WIDTH = 200, 20
LEAST_DEFORMATION = 0.03  # at the end of an axis: below, pixels are most of it
LABELS = {"area_um": "area (µm²)", "deform": "deformation", "emodulus": "Young's modulus (kPa)",
          "volume": "volume (µm³)", "temp": "temperature (°C)", "time": "time (s)",
          "inertia_ratio_expected": "inertia ratio of the model's cell", "inertia_ratio": "inertia ratio, measured"}
LINE, SUPPORT, HALF, GATE = "#7d8891", "#eef1f4", "#ffffff", "#b3261e"


@dataclass
class Panel:
    """One recording; lines and support are polylines (n, 2)."""

    story: dict
    events: np.ndarray  # (n, 2)
    lines: list  # of (modulus in kPa, points)
    support: np.ndarray | None
    gates: dict  # see draw_gates


def polyline(entry):
    """Points (n, 2) of an entry of the file."""
    return np.stack([np.array(entry["area_um2"], float), np.array(entry["deformation"], float)], axis=1)


def read_panels(folder):
    """All panels of the hand-over folder."""
    path = Path(folder) / "plot.json"
    try:
        panels = []
        handed = json.loads(path.read_text(encoding="utf-8"))
        for story in handed["panels"]:
            events = np.fromfile(Path(folder) / story["events_file"], "<f4").reshape(-1, 2).astype(float)
            lines = [(float(line["young_modulus_kPa"]), polyline(line)) for line in story["lines"]]
            support = polyline(story["support"]) if "support" in story else None
            panels.append(Panel(story, events, lines, support, handed.get("gates", {})))
        return panels
    except OSError as error:
        raise InputError(f"{path.parent} cannot be read: {reason(error)}.") from error
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path} is damaged: {error}.") from error


def upper_end(values, standard):
    """The standard end of an axis, or a round one farther out if more than 1 % of the events lie beyond it."""
    needed = float(np.quantile(values, 0.99))
    if needed <= standard:
        return standard
    needed *= 1.08
    step = 10 ** np.floor(np.log10(needed)) / 2
    return float(np.ceil(needed / step) * step)


def values_range(values):
    """Round ends of an axis that hold 99 % of the values and some room."""
    low, high = np.quantile(values, [0.005, 0.995])
    room = 0.08 * (high - low) or 0.5 * abs(high) or 1.0
    low, high = low - room if low < 0 or low > 2 * room else 0.0, high + room
    step = 10 ** np.floor(np.log10(high - low)) / 10
    return float(np.floor(low / step) * step), float(np.ceil(high / step) * step)


def ratio_range(ratios, low, high):
    """An axis that holds 99 % of the inertia ratios, and at least these two."""
    return float(min(low, np.quantile(ratios, 0.005))), float(max(high, np.quantile(ratios, 0.99)))


def common_ranges(panels):
    """Axes of other features, alike for all panels."""
    events = np.concatenate([panel.events for panel in panels])
    if is_comparison(panels[0].story):
        return [(ratio_range(events[:, 0], 0.97, 1.1), ratio_range(events[:, 1], 0.9, 1.15))] * len(panels)
    return [(values_range(events[:, 0]), values_range(events[:, 1]))] * len(panels)


def label_of(feature):
    """What stands at the axis."""
    return LABELS.get(feature, feature.replace("_", " "))


def is_usual(story):
    """Whether the axes are area and deformation."""
    return (story.get("x", "area_um"), story.get("y", "deform")) == ("area_um", "deform")


def is_comparison(story):
    """Whether measured stand against expected inertia ratios."""
    return (story.get("x"), story.get("y")) == ("inertia_ratio_expected", "inertia_ratio")


def ranges(panels):
    """Axes ((0, area), (0, deformation)) of each panel: areas alike for channels of one width, deformations for all."""
    if not is_usual(panels[0].story):
        return common_ranges(panels)
    deformation = max(upper_end(panel.events[:, 1], LEAST_DEFORMATION) for panel in panels)
    area = {}
    for panel in panels:
        width = panel.story["width_um"] or STANDARD_WIDTH
        end = upper_end(panel.events[:, 0], STANDARD_AREA * (width / STANDARD_WIDTH) ** 2)
        area[panel.story["width_um"]] = max(area.get(panel.story["width_um"], 0.0), end)
    return [((0.0, area[panel.story["width_um"]]), (0.0, deformation)) for panel in panels]


def draw(panels):
    """The figure."""
    columns = 2 if len(panels) == 4 else min(len(panels), 3)
    rows = -(-len(panels) // columns)
    left, right, bottom, top = MARGINS_IN
    size = np.array([columns * (left + AXES_IN[0] + right), rows * (bottom + AXES_IN[1] + top) + LEGEND_IN])
    figure = page.new_figure(*size, STYLE)
    for k, (panel, rectangle) in enumerate(zip(panels, ranges(panels))):
        corner = np.array([left + k % columns * (left + AXES_IN[0] + right),
                           LEGEND_IN + bottom + (rows - 1 - k // columns) * (bottom + AXES_IN[1] + top)])
        draw_panel(figure.add_axes([*(corner / size), *(AXES_IN / size)]), panel, rectangle)
    draw_legend(figure, panels)
    return figure


def draw_panel(axes, panel, rectangle):
    """Support, lines, events, contours, labels, from back to front."""
    axes.set(xlim=rectangle[0], ylim=rectangle[1], xlabel=label_of(panel.story.get("x", "area_um")),
             ylabel=label_of(panel.story.get("y", "deform")))
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
    if panel.support is not None:
        axes.add_patch(Polygon(panel.support, facecolor=SUPPORT, edgecolor="none", zorder=0))
    for _, points in panel.lines:
        axes.plot(*smoothed(points).T, color=LINE, linewidth=0.6, zorder=1, solid_capstyle="round")
    if is_comparison(panel.story):
        axes.plot(*[(0.5, 5)] * 2, color=LINE, linewidth=0.8, zorder=1)
        axes.fill_between((0.5, 5), (0.45, 4.95), (0.55, 5.05), color=SUPPORT, linewidth=0, zorder=0)
    draw_events(axes, panel.events, rectangle)
    draw_gates(axes, panel.gates)
    label_lines(axes, panel.lines, rectangle)
    draw_words(axes, panel, rectangle)


def draw_events(axes, events, rectangle):
    """Points coloured by their density, and the contours that enclose 50 and 95 % of them."""
    x, y = events.T
    density = Density(x, y, rectangle)
    seen = density.at(x, y)
    kept = thinned(seen, GREATEST_NUMBER)
    size = np.clip(4.5 * (2000 / max(len(events), 1)) ** 0.35, 1.2, 12)
    axes.scatter(x[kept], y[kept], c=seen[kept], s=size, cmap="viridis", norm=PowerNorm(0.7, 0, seen.max()),
                 linewidths=0, zorder=2, rasterized=len(kept) > 1500)
    if len(events) < 20:
        return
    levels = levels_enclosing(seen, [0.95, 0.5])
    if not 0 < levels[0] < levels[1] < density.values.max():
        return
    for level, style, width in ((levels[0], "solid", 1.1), (levels[1], (0, (3, 1.6)), 0.8)):
        contour = axes.contour(density.x, density.y, density.values, levels=[level], colors=colours.INK, linewidths=width,
                               linestyles=[style], zorder=3)
        # One collection since matplotlib 3.8, one per level before it.
        for collection in [contour] if isinstance(contour, Collection) else contour.collections:
            collection.set_path_effects([withStroke(linewidth=width + 1.1, foreground=HALF, alpha=0.7)])


def limits_of(gates):
    """Pairs of an axis, "x" or "y", and a limit of its feature."""
    return [(axis, limit) for axis in ("x", "y") for limit in gates.get(axis, []) if limit is not None]


def draw_gates(axes, gates):
    """Limits of the features on the axes, and polygons over both: {"x": [min, max], "y": ..., "polygons": ...}."""
    style = {"color": GATE, "linewidth": 0.8, "zorder": 3.5}
    for axis, limit in limits_of(gates):
        (axes.axvline if axis == "x" else axes.axhline)(limit, **style)
    for polygon in gates.get("polygons", []):
        axes.plot([*polygon["x"], polygon["x"][0]], [*polygon["y"], polygon["y"][0]], **style)


def smoothed(points):
    """The line without the small steps of a table's interpolation: quadratics through 11 neighbours at a time."""
    count = len(points)
    if count < 40:
        return points
    weights = np.array([-36, 9, 44, 69, 84, 89, 84, 69, 44, 9, -36]) / 429
    y = points[:, 1].copy()
    y[5:-5] = np.convolve(y, weights, mode="valid")
    return np.stack([points[:, 0], y], axis=1)


def visible_part(points, rectangle):
    """The polyline inside the axes, its last point where it leaves them."""
    (_, right), (_, top) = rectangle
    inside = (points[:, 0] <= right) & (points[:, 1] <= top) & (points[:, 1] >= 0)
    if not inside.any():
        return points[:0]
    first = int(np.argmax(inside))
    beyond = np.flatnonzero(~inside[first:])
    last = first + int(beyond[0]) if beyond.size else len(points)
    part = points[first:last]
    if last < len(points):
        a, b = points[last - 1], points[last]
        fraction = min(1.0, *((limit - a[k]) / (b[k] - a[k]) for k, limit in ((0, right), (1, top)) if b[k] > limit))
        part = np.vstack([part, a + fraction * (b - a)])
    return part


def label_lines(axes, lines, rectangle):
    """Moduli at the ends of the lines: beside the axes where lines leave them, otherwise behind their last point."""
    (_, right), (_, top) = rectangle
    taken = []
    first = True
    for modulus, points in lines:
        part = visible_part(points, rectangle)
        if len(part) < 2:
            continue
        end = part[-1] / (right, top)
        at_right, at_top = end[0] > 0.999, end[1] > 0.999
        if any((np.abs(end - other) * AXES_IN < room).all() for other, room in taken):
            continue
        taken.append((end, (0.36 if first else 0.22, 0.085)))  # inches that the words need
        offset, alignment = ((3, 0), ("left", "center")) if at_right else ((0, 2), ("center", "bottom"))
        text = f"{modulus:#.2g}" if modulus < 10 else f"{modulus:.0f}"
        if first:
            text, first = text + " kPa", False
        axes.annotate(text, part[-1], xytext=offset, textcoords="offset points", ha=alignment[0], va=alignment[1],
                      fontsize=5.6, color="#56616b", annotation_clip=False, zorder=4,
                      path_effects=None if at_right or at_top else [withStroke(linewidth=1.4, foreground="white")])


def draw_words(axes, panel, rectangle):
    """File, sample, number of events, conditions and the modulus to report, in four rows above the labels of the lines."""
    story = panel.story
    small = {"xycoords": "axes fraction", "textcoords": "offset points", "fontsize": 5.8, "color": "#56616b"}
    ink = {**small, "color": colours.INK}
    axes.set_title(shortened(story["title"], 44), pad=35)
    axes.annotate(shortened(story["sample"], 34), (0, 1), xytext=(0, 27), **small)
    axes.annotate(number_of_events(panel, rectangle), (1, 1), xytext=(0, 27), ha="right", **ink)
    axes.annotate(shortened(story["measured"], 64), (0, 1), xytext=(0, 19), **small)
    axes.annotate(story.get("recommended", "").replace("+-", "±"), (0, 1), xytext=(0, 11), **ink)


def number_of_events(panel, rectangle):
    """All events, and how many of them are not in the picture."""
    story = panel.story
    low, high = np.array(rectangle).T
    outside = int(np.sum(((panel.events < low) | (panel.events > high)).any(axis=1)))
    words = [f"{thousands(story['events'])} event" + ("s" if story["events"] != 1 else "")]
    gated = story.get("gated", 0)
    if gated:
        words.append(f"{thousands(gated)} gated")
    if story["drawable"] + gated < story["events"]:
        without = "shape" if is_usual(story) else "values"
        words.append(f"{thousands(story['events'] - gated - story['drawable'])} without {without}")
    if outside:
        words.append(f"{thousands(outside)} outside")
    return ", ".join(words)


def shortened(text, longest):
    """The text, or its beginning and an ellipsis."""
    return text if len(text) <= longest else text[:longest - 1] + "\u2026"


def draw_legend(figure, panels):
    """What lines, shading and contours mean, below all panels."""
    entries = [Line2D([], [], color=colours.INK, linewidth=0.8, linestyle=(0, (3, 1.6)), label="50 % of the events"),
               Line2D([], [], color=colours.INK, linewidth=1.1, label="95 %")]
    drawn = [panel for panel in panels if panel.lines]
    if drawn:
        note = "" if drawn[0].story["pixels"] else ", without pixelation"
        entries.append(Line2D([], [], color=LINE, linewidth=0.7, label=f"equal E from deformation, {drawn[0].story['table']}{note}"))
    if any(panel.support is not None for panel in panels):
        entries.append(Patch(facecolor=SUPPORT, edgecolor="#c9d0d6", linewidth=0.4, label="range of the table"))
    if limits_of(panels[0].gates) or panels[0].gates.get("polygons"):
        entries.append(Line2D([], [], color=GATE, linewidth=0.8, label="gates"))
    columns = len(entries) if len(panels) > 1 else 2
    figure.legend(handles=entries, loc="lower center", bbox_to_anchor=(0.5, 0), ncol=columns, frameon=False, fontsize=5.8,
                  borderaxespad=0.3, columnspacing=1.6, handlelength=2.2, labelspacing=0.25)


def main():
    """Command line."""
    arguments = [argument for argument in sys.argv[1:] if argument != "--"]
    if len(arguments) != 2:
        raise InputError("give the hand-over folder and the name of the pictures: python -m rheocyte.event_plot DIR OUT.")
    stem = Path(arguments[1])
    if not stem.parent.is_dir():
        raise InputError(f"{stem.parent}: there is no such folder; make it, or give another name with -o.")
    save_figure(draw(read_panels(arguments[0])), stem, 300, svg_dpi=300)


if __name__ == "__main__":
    run(main)
