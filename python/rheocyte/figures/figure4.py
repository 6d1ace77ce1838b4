"""Figure 4: lines of equal stiffness of solids and shells, the neo-Hookean law against the linear one."""

import numpy as np

from rheocyte import colours
from rheocyte.figures import lines, plane, style

HIGHEST = 0.1
LAWS = {"linear": style.LINEAR, "neo-hookean": style.NEO_HOOKEAN}
NAMES = {"linear": "linear law", "neo-hookean": "neo-Hookean law"}


def make(laboratory):
    """The figure and the rows of its table."""
    families = [(kind, {law: lines.numerical(laboratory, kind, law) for law in LAWS})
                for kind in (lines.SOLIDS, lines.SHELLS)]
    return draw(families), [row for kind, by_law in families for law, drawn in by_law.items()
                            for row in lines.rows(kind, law, drawn, ["deformation"])]


def draw(families):
    """Solids on the left, shells on the right; below them the difference between the laws."""
    figure = style.new_figure(5.2)
    for column, (kind, by_law) in enumerate(families):
        left = plane.head(figure, column, kind)
        upper = figure.add_axes([left, 0.515, plane.WIDTH, 0.415])
        plane.prepare(upper, "deformation $d$", 0, HIGHEST)
        for law, drawn in by_law.items():
            dashes = {"dashes": (4, 1.8)} if law == "linear" else {}
            plane.draw_lines(upper, drawn, "deformation", color=LAWS[law], linewidth=0.9, zorder=3, **dashes)
        plane.tell_moduli(upper, by_law["neo-hookean"], "deformation", style.NEO_HOOKEAN)
        for law in [law for law, drawn in by_law.items() if not drawn]:
            plane.missing(upper, NAMES[law])
        draw_difference(figure.add_axes([left, 0.115, plane.WIDTH, 0.295]), by_law)
    plane.draw_legend(figure, legend(), [line for _, by_law in families for drawn in by_law.values() for line in drawn])
    return figure


def pairs(by_law):
    """Lines of both laws with the same modulus: linear, neo-Hookean."""
    return [(line, other) for line in by_law["linear"] for other in by_law["neo-hookean"]
            if line.modulus == other.modulus]


def draw_difference(axes, by_law):
    """How much more or less the neo-Hookean cell deforms at equal area and modulus, against the deformation."""
    axes.axhline(0, color="#9aa3ab", linewidth=0.6, zorder=1)
    axes.set(xlabel="deformation $d$ after the linear law", ylabel="neo-Hookean $-$ linear (%)")
    both = pairs(by_law)
    for index, (linear, neo_hookean) in enumerate(both):
        area, difference = lines.relative_difference(neo_hookean, linear)
        deformation = linear.at_area(area, "deformation")
        shown = deformation <= HIGHEST
        colour = colours.LIQUID(0.35 + 0.6 * index / max(len(both) - 1, 1))
        axes.plot(deformation[shown], 100 * difference[shown], color=colour, linewidth=1.0, zorder=2 + 0.1 * index)
        if shown.any():
            axes.annotate(f"{linear.modulus:g}", (deformation[shown][-1], 100 * difference[shown][-1]), xytext=(2, -2),
                          textcoords="offset points", ha="right", va="top", fontsize=6, color=colour)
    axes.margins(y=0.12)
    axes.set_xlim(left=0)
    axes.yaxis.set_label_coords(*plane.NAME_PLACE)


def legend():
    """What the marks mean."""
    return [({"color": LAWS["neo-hookean"], "linewidth": 0.9}, NAMES["neo-hookean"]),
            ({"color": LAWS["linear"], "linewidth": 0.9, "dashes": (4, 1.8)}, NAMES["linear"])]
