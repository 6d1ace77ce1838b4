"""Figure 3: lines of equal stiffness of solids and shells, the analytical model against the linear law."""

import numpy as np

from rheocyte import colours
from rheocyte.figures import lines, plane, style

HIGHEST, CLOSE_UP = 0.1, 0.02
OFF = 0.1  # relative difference of the deformation at which the model is called wrong
CROWDED = 0.05  # no marks below this fraction of the height; the close-up shows them
FIGURE_2 = {"solid": (7.66, 3.44), "shell": (7.66, 31.3)}  # radius at rest in um and modulus of the cells in figure 2


def make(laboratory):
    """The figure and the rows of its table."""
    families = []
    for kind in (lines.SOLIDS, lines.SHELLS):
        families.append((kind, lines.numerical(laboratory, kind, "linear"), lines.analytical(laboratory, kind)))
    return draw(families), [row for kind, numerical, analytical in families
                            for model, drawn in (("linear", numerical), ("analytical", analytical))
                            for row in lines.rows(kind, model, drawn, ["deformation"])]


def draw(families):
    """Solids on the left, shells on the right; below them the range of small deformations."""
    figure = style.new_figure(5.6)
    for column, (kind, numerical, analytical) in enumerate(families):
        left = plane.head(figure, column, kind)
        for bottom, highest in ((0.557, HIGHEST), (0.105, CLOSE_UP)):
            axes = figure.add_axes([left, bottom, plane.WIDTH, 0.377])
            plane.prepare(axes, "deformation $d$", 0, highest)
            draw_families(axes, numerical, analytical)
            if not numerical:
                plane.missing(axes, "linear law")
        mark_figure_2(figure.axes[-2], kind, numerical)
        figure.axes[-2].set_xlabel("")
    plane.draw_legend(figure, legend(), [line for _, numerical, _ in families for line in numerical])
    return figure


def draw_families(axes, numerical, analytical):
    """Both families, the places from which on they differ, and the moduli."""
    plane.draw_lines(axes, analytical, "deformation", color=style.ANALYTICAL, linewidth=0.8, dashes=(4, 1.8), zorder=2)
    plane.draw_lines(axes, numerical, "deformation", color=style.LINEAR, linewidth=1.0, zorder=3)
    plane.tell_moduli(axes, numerical, "deformation", style.LINEAR)
    for line in numerical:
        place = first_off(line, analytical)
        if place is not None and place[1] > CROWDED * axes.get_ylim()[1]:
            axes.plot(*place, linestyle="none", marker="o", markersize=3.4, markerfacecolor="white",
                      markeredgecolor=style.LINEAR, markeredgewidth=0.8, zorder=4)


def first_off(line, analytical):
    """Area and deformation from which on the model is off by OFF; None if it never is."""
    reference = next((other for other in analytical if other.modulus == line.modulus), None)
    if reference is None:
        return None
    area, difference = lines.relative_difference(reference, line)
    off = np.flatnonzero(np.abs(difference) > OFF)
    return (area[off[0]], line.at_area(area[off[0]], "deformation")) if len(off) else None


def mark_figure_2(axes, kind, numerical):
    """The cell of the paper's figure 2."""
    radius, modulus = FIGURE_2[kind.name]
    for line in numerical:
        if line.modulus == modulus:
            axes.plot(line.at_radius(radius, "area_um2"), line.at_radius(radius, "deformation"), linestyle="none",
                      marker="o", markersize=4, color=colours.INK, zorder=5)


def legend():
    """What the marks mean."""
    return [({"color": style.LINEAR, "linewidth": 1.0}, "linear law"),
            ({"color": style.ANALYTICAL, "linewidth": 0.8, "dashes": (4, 1.8)}, "analytical, small deformations"),
            ({"color": style.LINEAR, "linestyle": "none", "marker": "o", "markersize": 3.4,
              "markerfacecolor": "white", "markeredgewidth": 0.8}, f"$d$ differs by {100 * OFF:g} % for the first time"),
            ({"color": colours.INK, "linestyle": "none", "marker": "o", "markersize": 4}, "cell of the paper's figure 2")]
