"""Figure square: what the tube of equal pressure drop does to cells in a square channel, and what the camera's view does."""

import numpy as np
from matplotlib.patches import Circle

from rheocyte import colours, duct_picture
from rheocyte.contour import closed
from rheocyte.duct_picture import CELL, COLOURS, LIQUID, WALL, WALL_FACE
from rheocyte.duct_surface import IMAGES, front_view, surface_faces
from rheocyte.figures import style
from rheocyte.files import read_contour
from rheocyte.vtu import read_vtu

WIDTH_UM, RATE_UL_S, ACCURACY = 20.0, 0.04, 2e-3
HALF_UM, TUBE_UM = WIDTH_UM / 2, 0.547 * WIDTH_UM
SIDE, DIAGONAL, TUBE = COLOURS
LIQUIDS = {"newtonian": {"flow.viscosity_mPas": 15.0},
           "cellcarrier": {"flow.law": "power-law", "flow.consistency_Pa_sn": 0.2079, "flow.exponent": 0.6548}}
# Radius in um: Young's modulus in kPa at which the deformation is about 0.01 in a Newtonian liquid.
SIZES = {3.5: 2.3, 4.25: 2.85, 5.0: 3.4, 6.0: 4.5, 7.0: 6.1, 8.0: 9.0, 8.6: 11.5}
SOFTNESS = (3.0, 1.7, 0.78, 0.62)  # times that, for other deformations
SOFTER = (4.25, 6.0, 8.0)  # radii of which there are such
SHOWN = (4.25, 6.0, 8.6)  # radii of the outlines
THINNING = 0.36  # modulus in CellCarrier over that in the Newtonian liquid, for about the same deformation
TOP_IN, ROW_IN, HEAD_IN, FOOT_IN, SIDE_IN = 2.35, 1.62, 0.34, 0.3, 0.06


def make(laboratory):
    """The figure and the rows of its table."""
    cells = {f"{liquid}-{radius:g}um-{fraction:g}": (liquid, radius, fraction * modulus)
             for liquid in LIQUIDS for radius, modulus in SIZES.items()
             for fraction in (1.0, *(SOFTNESS if radius in SOFTER and liquid == "newtonian" else ()))}
    cases = {f"{name}-{section}": case(section, *cell) for name, cell in cells.items() for section in ("square", "tube")}
    solved = laboratory.solve(cases)
    pairs = {name: Pair(*cell, solved[f"{name}-square"], solved[f"{name}-tube"]) for name, cell in cells.items()}
    return draw(pairs), [row for name, pair in pairs.items() for row in pair.rows(name)]


def case(section, liquid, radius_um, modulus_kPa):
    """A neo-Hookean solid in one liquid and channel."""
    modulus = modulus_kPa * (1 if liquid == "newtonian" else THINNING)
    return {"channel.section": section, "channel.width_um": WIDTH_UM, "flow.rate_ul_per_s": RATE_UL_S, **LIQUIDS[liquid],
            "flow.density_kg_per_m3": 0.0, "cell.radius_um": radius_um, "cell.bulk.law": "neo-hookean",
            "cell.bulk.young_modulus_kPa": modulus, "numerics.accuracy": ACCURACY if section == "square" else 1e-4}


class Pair:
    """The same cell in the square channel and in the tube."""

    def __init__(self, liquid, radius, modulus, square, tube):
        self.liquid, self.radius, self.modulus = liquid, radius, modulus
        self.square, self.tube = square, tube

    @property
    def converged(self):
        """Whether there is something to compare."""
        return self.square.converged and self.tube.converged

    def ratio(self, view):
        """Deformation in a view over that in the tube."""
        return self.square[f"deformation_{view}"] / self.tube["deformation"]

    def rows(self, name):
        """The line of the table."""
        head = {"cell": name, "liquid": self.liquid, "radius_um": f"{self.radius:g}", "status": self.square.result["status"]}
        columns = ["deformation_tube", "deformation_side", "deformation_diagonal", "area_um2", "volume_ratio"]
        numbers = [self.tube["deformation"], self.square["deformation_side"], self.square["deformation_diagonal"],
                   self.square["area_um2"], self.square["volume_of_revolution_um3"] / self.square["volume_um3"]
                   ] if self.converged else []
        yield head | {column: f"{number:.6g}" for column, number in zip(columns, numbers)} | {
            column: "" for column in columns[len(numbers):]}


def draw(pairs):
    """Ratios above, outlines below."""
    total = FOOT_IN + ROW_IN + HEAD_IN + TOP_IN + HEAD_IN
    figure = style.new_figure(total)
    bottom = FOOT_IN + ROW_IN + HEAD_IN + 0.42
    over_size = figure.add_axes([0.5 / style.WIDTH_IN, bottom / total, 2.95 / style.WIDTH_IN, (TOP_IN - 0.42) / total])
    over_shape = figure.add_axes([4.05 / style.WIDTH_IN, bottom / total, 2.95 / style.WIDTH_IN, (TOP_IN - 0.42) / total])
    draw_over_size(over_size, pairs)
    draw_over_deformation(over_shape, pairs)
    for x, top, text in ((0.06, total - 0.06, "a   over the size of the cell, $d$ about 0.01"),
                         (3.62, total - 0.06, "b   over its deformation, Newtonian liquid"),
                         (0.06, FOOT_IN + ROW_IN + HEAD_IN - 0.06, "c   the same cell in both channels, Newtonian liquid")):
        figure.text(x / style.WIDTH_IN, top / total, text, va="top", weight="bold", fontsize=7.5)
    shown = [pairs[f"newtonian-{radius:g}um-1"] for radius in SHOWN]
    for column, pair in enumerate(shown):
        draw_outlines(panel(figure, column, total), pair)
    draw_along_the_flow(panel(figure, len(SHOWN), total), shown[-1])
    axes = figure.add_axes([0, 0, 1, FOOT_IN / total])
    axes.axis("off")
    handles = [axes.plot([], [], color=colour, linewidth=1.1, label=label)[0]
               for colour, label in ((SIDE, "square, seen from the side"), (DIAGONAL, "square, along the diagonal"),
                                     (TUBE, "tube of equal pressure drop"))]
    axes.legend(handles=handles, loc="center", ncol=3, frameon=False, borderaxespad=0)
    return figure


def panel(figure, column, total):
    """Axes of one of four places in the lower row."""
    width = (style.WIDTH_IN - 2 * SIDE_IN - 3 * 0.1) / 4
    return figure.add_axes([(SIDE_IN + column * (width + 0.1)) / style.WIDTH_IN, FOOT_IN / total, width / style.WIDTH_IN,
                            ROW_IN / total])


def draw_over_size(axes, pairs):
    """Ratios of both views in both liquids."""
    for liquid, line, label in (("newtonian", "-", "Newtonian"), ("cellcarrier", "--", "CellCarrier")):
        chosen = [pair for name, pair in pairs.items() if pair.liquid == liquid and name.endswith("-1") and pair.converged]
        for view, colour in (("side", SIDE), ("diagonal", DIAGONAL)):
            axes.plot([pair.radius / HALF_UM for pair in chosen], [pair.ratio(view) for pair in chosen], color=colour,
                      linestyle=line, linewidth=1.1, marker="o", markersize=2.2)
        axes.plot([], [], color=colours.INK, linestyle=line, linewidth=1.1, label=label)
    finish(axes, "radius of the cell / half width of the channel")
    axes.legend(frameon=False, loc="lower left", handlelength=2.6)


def draw_over_deformation(axes, pairs):
    """Ratios of both views at three sizes."""
    for radius, marker in zip(SOFTER, ("o", "s", "^")):
        chosen = sorted((pair for pair in pairs.values() if pair.liquid == "newtonian" and pair.radius == radius
                         and pair.converged), key=lambda pair: pair.tube["deformation"])
        for view, colour in (("side", SIDE), ("diagonal", DIAGONAL)):
            axes.plot([pair.tube["deformation"] for pair in chosen], [pair.ratio(view) for pair in chosen], color=colour,
                      linewidth=1.1, marker=marker, markersize=2.4)
        if chosen:
            axes.annotate(f"$r_0$ = {radius:g} µm", (chosen[0].tube["deformation"], chosen[0].ratio("side")),
                          textcoords="offset points", xytext=(0, 4), ha="left", fontsize=6)
    axes.set_xscale("log")
    finish(axes, "deformation in the tube")


def finish(axes, label):
    """Labels, and the line of the tube itself."""
    axes.axhline(1, color=TUBE, linewidth=1.1, zorder=1)
    axes.set(xlabel=label, ylabel="deformation in the square / in the tube")


def draw_outlines(axes, pair):
    """Both silhouettes and the tube's outline over each other."""
    half = 13.2
    axes.set(xlim=(-half, half), ylim=(-1.16 * TUBE_UM, 1.52 * TUBE_UM), aspect="equal")
    axes.axis("off")
    axes.fill_between([-half, half], -HALF_UM, HALF_UM, color=LIQUID, linewidth=0, zorder=0)
    for sign in (1, -1):
        axes.fill_between([-half, half], sign * HALF_UM, sign * (1 + WALL) * HALF_UM, color=WALL_FACE, linewidth=0, zorder=0)
        axes.plot([-half, half], [sign * TUBE_UM] * 2, color=TUBE, linewidth=0.7, zorder=1)
        axes.plot([-half, half], [sign * HALF_UM] * 2, color=colours.INK, linewidth=0.9, zorder=1)
    if not pair.converged:
        style.note(axes, pair.square.trouble or pair.tube.trouble, width=24)
        return
    outlines = [(closed(pair.tube.contour()), TUBE, pair.tube["deformation"])]
    outlines += [(closed(read_contour(pair.square.folder / f"contour_{view}.csv")), colour,
                  pair.square[f"deformation_{view}"]) for view, colour in (("diagonal", DIAGONAL), ("side", SIDE))]
    axes.fill(*outlines[-1][0].T, facecolor=CELL, linewidth=0, zorder=2)
    for index, (outline, colour, deformation) in enumerate(outlines):
        axes.plot(*outline.T, color=colour, linewidth=0.9, zorder=3 + index, solid_joinstyle="round")
        axes.text(half * (0.68, 0, -0.68)[index], 1.2 * TUBE_UM, f"{deformation:.4f}", color=colour, ha="center", va="center",
                  fontsize=6)
    axes.text(0, 1.4 * TUBE_UM, f"$r_0$ = {pair.radius:g} µm,  $E$ = {pair.modulus:g} kPa,  $d$ =", ha="center", va="center",
              fontsize=6)


def draw_along_the_flow(axes, pair):
    """The cell in the square seen along the flow, with the tube's wall and cell."""
    duct_picture.draw_section(axes, HALF_UM, HALF_UM)
    axes.add_patch(Circle((0, 0), TUBE_UM, fill=False, edgecolor=TUBE, linewidth=0.7, zorder=2))
    if pair.converged:
        faces = surface_faces(read_vtu(pair.square.folder / "fields.vtu", ["region"]))
        axes.fill(*front_view(faces, IMAGES["square"]).T, facecolor=CELL, edgecolor=SIDE, linewidth=0.9, zorder=3)
        axes.add_patch(Circle((0, 0), pair.tube.contour()[:, 1].max(), fill=False, edgecolor=TUBE, linewidth=0.9, zorder=4))
    axes.text(0, 1.4 * TUBE_UM, f"along the flow, $r_0$ = {pair.radius:g} µm", ha="center", va="center", fontsize=6)
    half = 13.2
    axes.set(xlim=(-half, half), ylim=(-1.16 * TUBE_UM, 1.52 * TUBE_UM), aspect="equal")
    axes.axis("off")
