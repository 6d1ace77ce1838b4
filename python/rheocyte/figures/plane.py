"""Drawing of lines of equal stiffness: axes of area and a measure, lines, their ends and their moduli."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from rheocyte import colours
from rheocyte.figures import paper, style

LEFT, COLUMN, WIDTH = 0.080, 0.505, 0.366  # first panel, distance of the second one, width, in widths of the figure
TITLE_IN = 0.09  # below the upper edge
NAME_PLACE = (-0.158, 0.5)  # of the vertical axis, in sizes of the axes
GAP = 0.036  # least distance between two moduli at the right edge, in heights of the axes
ROOM = 0.05  # least distance between two moduli above the upper edge, in widths of the axes


def head(figure, column, kind):
    """The title over a column; the place of its axes."""
    left = LEFT + COLUMN * column
    figure.text(left - 0.070, 1 - TITLE_IN / figure.get_figheight(), va="center", weight="bold", fontsize=7.5,
                s=f"{'ab'[column]}   elastic {kind.name}s, {kind.symbol} in {kind.unit}")
    return left


def draw_legend(figure, marks, lines):
    """What the marks mean, below everything; that of the ends if there are any."""
    if any(line.ended and line["area_um2"][-1] < paper.AREAS_UM2[1] for line in lines):
        marks = [*marks, ({"color": colours.INK, "linestyle": "none", "marker": "x", "markersize": 4},
                          "end of the smooth branch")]
    figure.legend(handles=[Line2D([], [], label=label, **how) for how, label in marks], loc="lower center",
                  ncol=len(marks), frameon=False, handlelength=2.2, columnspacing=1.6, fontsize=6.5,
                  bbox_to_anchor=(0.5, 0.004), borderaxespad=0)


def prepare(axes, name, lowest, highest):
    """Limits and names of the axes."""
    axes.set(xlim=paper.AREAS_UM2, ylim=(lowest, highest), xlabel="area (µm²)", ylabel=name)
    axes.set_xticks(np.arange(60, 241, 20))
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    axes.yaxis.set_label_coords(*NAME_PLACE)


def draw_lines(axes, lines, name, **how):
    """The lines inside the axes; a short bar closes each that ends with the smooth branches."""
    for line in lines:
        axes.plot(line["area_um2"], line[name], solid_capstyle="butt", **how)
        if line.ended:
            axes.plot(line["area_um2"][-1], line[name][-1], linestyle="none", marker="x", markersize=4,
                      markeredgewidth=1.0, color=how["color"], zorder=how.get("zorder", 2) + 1)


def tell_moduli(axes, lines, name, colour):
    """The modulus of each line where it leaves the axes: above the upper edge, beside the right one, or at its end."""
    (low, high), right, above = axes.get_ylim(), [], []
    for line in lines:
        area, value = inside(line, name, low, high)
        if len(area) == 0:
            continue
        if value[-1] > high - 0.01 * (high - low):
            above.append([fraction_x(axes, area[-1]), f"{line.modulus:g}"])
        elif area[-1] > paper.AREAS_UM2[1] - 2:
            right.append([(value[-1] - low) / (high - low), f"{line.modulus:g}"])
        else:
            below = value[-1] < low + 0.01 * (high - low)
            axes.annotate(f"{line.modulus:g}", (area[-1], value[-1]), xytext=(-5, 3) if below else (0, 3.5),
                          textcoords="offset points", ha="right" if below else "center", va="bottom", fontsize=6,
                          color=colour)
    for place, text in apart(right, GAP):
        axes.text(1.012, place, text, transform=axes.transAxes, va="center", fontsize=6, color=colour)
    for place, text in apart(above, ROOM):
        axes.text(place, 1.012, text, transform=axes.transAxes, ha="center", va="bottom", fontsize=6, color=colour)


def inside(line, name, low, high):
    """Areas and values of a line from its start to where it leaves the axes."""
    area = np.linspace(*paper.AREAS_UM2, 800)
    value = line.at_area(area, name)
    known = np.isfinite(value)
    area, value = area[known], value[known]
    outside = np.flatnonzero((value > high) | (value < low))
    last = outside[0] if len(outside) else len(area)
    return area[:last], value[:last]


def fraction_x(axes, area):
    """Place of an area in widths of the axes."""
    low, high = axes.get_xlim()
    return (area - low) / (high - low)


def apart(labels, gap):
    """Places (with texts) moved up until they are at least a gap apart."""
    moved = []
    for place, text in sorted(labels):
        moved.append((max(place, moved[-1][0] + gap) if moved else place, text))
    return moved


def missing(axes, model):
    """In place of the lines of a table that failed."""
    style.note(axes, f"{model}: the table could not be computed")
