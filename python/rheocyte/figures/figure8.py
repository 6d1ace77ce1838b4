"""Figure 8: lines of equal stiffness in the plane of area and the ratio of the moments of area, neo-Hookean law."""

import numpy as np

from rheocyte.figures import lines, paper, plane, style

LAW, MEASURE = "neo-hookean", "moment_ratio"
LIMITS = {"solid": (0.6, 1.05), "shell": (0.8, 1.15)}  # of the paper's axes
CLOSE = 1e-4  # a smaller difference of the ratio counts as none: the tables' accuracy


def make(laboratory):
    """The figure and the rows of its table."""
    families = [(kind, lines.numerical(laboratory, kind, LAW)) for kind in (lines.SOLIDS, lines.SHELLS)]
    return draw(families), [row for kind, drawn in families for row in lines.rows(kind, LAW, drawn, [MEASURE])]


def draw(families):
    """Solids on the left, shells on the right; where lines overlap is shaded."""
    figure = style.new_figure(3.1)
    for column, (kind, drawn) in enumerate(families):
        left = plane.head(figure, column, kind)
        axes = figure.add_axes([left, 0.130, plane.WIDTH, 0.765])
        plane.prepare(axes, "$\\Lambda_1/\\Lambda_2$", *LIMITS[kind.name])
        axes.axhline(1, color="#9aa3ab", linewidth=0.6, zorder=1)
        plane.draw_lines(axes, drawn, MEASURE, color=style.NEO_HOOKEAN, linewidth=0.9, zorder=3)
        plane.tell_moduli(axes, drawn, MEASURE, style.NEO_HOOKEAN)
        if drawn:
            shade_overlap(axes, drawn)
        else:
            plane.missing(axes, "neo-Hookean law")
    return figure


def shade_overlap(axes, drawn):
    """The areas at which lines cross or have crossed."""
    area, overlap = overlapping(drawn)
    for start, stop in stretches(overlap):
        axes.axvspan(area[start], area[stop], facecolor="#fbe3d9", linewidth=0, zorder=0)
    text = "no lines overlap" if not overlap.any() else "shaded: lines overlap"
    axes.text(0.03, 0.04, text, transform=axes.transAxes, fontsize=6.5)


def overlapping(drawn):
    """Areas, and whether there the ratio does not rise strictly with the modulus."""
    area = np.linspace(*paper.AREAS_UM2, lines.POINTS)
    ordered = sorted(drawn, key=lambda line: line.modulus)
    ratio = np.array([line.at_area(area, MEASURE) for line in ordered])
    overlap = np.zeros(len(area), dtype=bool)
    for column in range(len(area)):
        known = ratio[np.isfinite(ratio[:, column]), column]
        overlap[column] = np.any(np.diff(known) < CLOSE)
    return area, overlap


def stretches(flags):
    """First and last index of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(int), [0]])))
    return [(int(start), int(stop) - 1) for start, stop in zip(edges[::2], edges[1::2])]
