"""Figure transit: three cells in a chip's planar funnel, seen by both cameras, and what the tube's model makes of them."""

import numpy as np
from matplotlib.patches import Polygon

from rheocyte import colours
from rheocyte.contour import closed, resampled
from rheocyte.duct_picture import LIQUID, WALL_FACE
from rheocyte.figures import paper, style
from rheocyte.files import read_column
from rheocyte.time_picture import read_contours

RADIUS_UM, HEIGHT_UM, WIDE_UM = 6.0, 20.0, 100.0
FUNNEL_UM = (30.0, 70.0)  # from the start of the cell, at 45 degrees
CELLS = {2.5: "#c22f1d", 4.0: colours.INK, 8.0: "#2f6fa8"}  # modulus in kPa: colour
SHOWN_UM = (12.0, 168.0)  # of the way
PLACES_UM = [20.0, 40.0, 55.0, 70.0, 85.0, 105.0, 130.0, 155.0]  # of the outlines
ABOVE, ACROSS = "deformation_side", "deformation_across"
HALF_SHOWN_UM, WALL_UM = 21.0, 2.5
POINTS = 60  # of half an outline
BEHIND_UM = 10.0  # the funnel: greatest deformations are sought up to there
LEFT_IN, RIGHT_IN, FOOT_IN, CURVES_IN, GAP_IN, HEAD_IN = 0.6, 0.08, 0.34, 1.45, 0.26, 0.24


def make(laboratory):
    """The figure and the rows of its table."""
    cases = {f"transit-{section}-{modulus:g}kPa": case(section, modulus)
             for modulus in CELLS for section in ("square", "tube")}
    solved = laboratory.solve(cases)
    ways = {modulus: [Way(solved[f"transit-{section}-{modulus:g}kPa"]) for section in ("square", "tube")]
            for modulus in CELLS}
    return draw(ways), list(rows(ways))


def case(section, modulus_kPa):
    """A neo-Hookean cell on its way through the funnel into the channel, or through the tube of the same mean speeds."""
    time = {"end_um": 10000.0, "output_every_um": 5.0, "accuracy": 1e-4, "mesh_accuracy": 5e-3}  # until it has settled
    return {"channel.section": section,
            **paper.section("channel.profile", {"x_um": list(FUNNEL_UM), "width_um": [WIDE_UM, HEIGHT_UM]}),
            "flow.rate_ul_per_s": 0.04, "flow.viscosity_mPas": 15.0, "flow.density_kg_per_m3": 0.0,
            "cell.radius_um": RADIUS_UM, "cell.viscosity_mPas": 15.0, "cell.density_kg_per_m3": 0.0,
            "cell.bulk.law": "neo-hookean", "cell.bulk.young_modulus_kPa": modulus_kPa, **paper.section("time", time)}


class Way:
    """A cell on its way, at its steps and outputs."""

    def __init__(self, solution):
        self.solution = solution
        self.converged, self.trouble = solution.converged, solution.trouble
        if self.converged:
            self.outputs = read_column(solution.folder / "outputs.csv", "position_um")
            places = self.column("position_um")
            self.order = np.argsort(places, kind="stable")
            self.place = places[self.order]

    def column(self, name):
        """Values of a measure at the outputs, then at the steps."""
        return np.concatenate([read_column(self.solution.folder / file, name) for file in ("outputs.csv", "history.csv")])

    def course(self, name):
        """A measure over the places."""
        return self.column(name)[self.order]

    def shown(self):
        """Numbers of the outputs at the places of the figure."""
        return [int(np.argmin(np.abs(self.outputs - place))) for place in PLACES_UM]

    def outlines(self, file):
        """Closed outlines (n, 2) in um at the places of the figure."""
        _, shapes = read_contours(self.solution.folder / file)
        return [closed(resampled(shapes[k], POINTS)) + [self.outputs[k], 0] for k in self.shown()]

    def wall(self):
        """Places along the channel and half its width there, both in um."""
        file = self.solution.folder / "channel.csv"
        return read_column(file, "x_um"), read_column(file, "R_um")

    def extremes(self, name):
        """The greatest value, its place, the least one behind it, its place, and the last."""
        d = self.course(name)
        top = int(np.argmax(np.where(self.place < FUNNEL_UM[1] + BEHIND_UM, d, 0)))
        low = top + int(np.argmin(d[top:]))
        return d[top], self.place[top], d[low], self.place[low], d[-1]


def rows(ways):
    """Lines of the table: each cell as both cameras see it in the channel, and in the tube."""
    columns = ["greatest_deformation", "at_um", "least_deformation_behind", "least_at_um", "last_deformation"]
    for modulus, (square, tube) in ways.items():
        for seen, way, name in (("above", square, ABOVE), ("side", square, ACROSS), ("tube", tube, "deformation")):
            numbers = way.extremes(name) if way.converged else [""] * len(columns)
            yield {"young_modulus_kPa": modulus, "seen": seen, "status": way.solution.result["status"]} | {
                column: number and f"{number:.4g}" for column, number in zip(columns, numbers)}


def draw(ways):
    """Both views above, the deformations they show below, all over the place of the cell."""
    scale = (style.WIDTH_IN - LEFT_IN - RIGHT_IN) / (SHOWN_UM[1] - SHOWN_UM[0])
    above, side = 2 * scale * HALF_SHOWN_UM, 2 * scale * (HEIGHT_UM / 2 + WALL_UM)
    heights = [above, side, CURVES_IN, CURVES_IN]
    total = sum(heights) + 4 * HEAD_IN + 2 * GAP_IN + FOOT_IN - GAP_IN
    figure = style.new_figure(total)
    titles = ["a   from above, as the camera of a chip sees it", "b   from the side",
              "c   deformation seen from above", "d   deformation seen from the side"]
    top, panels = total, []
    for title, height in zip(titles, heights):
        figure.text(0.06 / style.WIDTH_IN, (top - 0.07) / total, title, va="top", weight="bold", fontsize=7.5)
        top -= HEAD_IN + height
        panels.append(figure.add_axes([LEFT_IN / style.WIDTH_IN, top / total,
                                       1 - (LEFT_IN + RIGHT_IN) / style.WIDTH_IN, height / total]))
        top -= GAP_IN if height == CURVES_IN else 0
    draw_views(panels[:2], ways)
    draw_curves(panels[2], ways, ABOVE)
    draw_curves(panels[3], ways, ACROSS)
    greatest = max(axes.get_ylim()[1] for axes in panels[2:])
    for axes in panels[2:]:
        axes.set_ylim(0, greatest)
    tell_cells(panels[2], ways)
    panels[3].set_xlabel("place of the cell from its start (µm)")
    return figure


def draw_views(panels, ways):
    """The cells at some places between the walls."""
    squares = {modulus: square for modulus, (square, _) in ways.items() if square.converged}
    for axes, half, file in zip(panels, (HALF_SHOWN_UM, HEIGHT_UM / 2 + WALL_UM),
                                ("contours.csv", "contours_across.csv")):
        axes.set(xlim=SHOWN_UM, ylim=(-half, half), aspect="equal")
        axes.axis("off")
        axes.set_facecolor(LIQUID)
        if not squares:
            style.note(axes, next(iter(ways.values()))[0].trouble)
            continue
        x, wall = next(iter(squares.values())).wall()
        x = np.concatenate([[SHOWN_UM[0]], x, [SHOWN_UM[1]]])
        wall = np.concatenate([wall[:1], wall, wall[-1:]]) if file == "contours.csv" else np.full(len(x), HEIGHT_UM / 2)
        axes.fill_between(x, -wall, wall, color=LIQUID, linewidth=0, zorder=0)
        for sign in (1, -1):
            axes.fill_between(x, sign * wall, sign * (wall + 2 * WIDE_UM), color=WALL_FACE, linewidth=0, zorder=1)
            axes.plot(x, sign * wall, color=colours.INK, linewidth=0.8, zorder=2)
        draw_cells(axes, squares, file)


def draw_cells(axes, squares, file):
    """Outlines of all cells at each place, the first one, which is softest, filled."""
    for order, (modulus, way) in enumerate(squares.items()):
        for outline in way.outlines(file):
            axes.add_patch(Polygon(outline, facecolor="#fdf0cf" if order == 0 else "none", edgecolor=CELLS[modulus],
                                   linewidth=0.8, zorder=3 + order))


def draw_curves(axes, ways, name):
    """What one camera sees of each cell, and the tube's model of it."""
    axes.axvspan(*FUNNEL_UM, color=WALL_FACE, alpha=0.5, linewidth=0, zorder=0)
    for modulus, (square, tube) in ways.items():
        if square.converged:
            axes.plot(square.place, square.course(name), color=CELLS[modulus], linewidth=1.2, zorder=3)
        if tube.converged:
            axes.plot(tube.place, tube.course("deformation"), color=CELLS[modulus], linewidth=0.8,
                      linestyle=(0, (1.2, 1.6)), zorder=2)
    axes.set(xlim=SHOWN_UM, ylabel="deformation $d$")


def tell_cells(axes, ways):
    """Legend of the moduli and of the tube."""
    handles = [axes.plot([], [], color=CELLS[modulus], linewidth=1.2, label=f"$E$ = {modulus:g} kPa")[0]
               for modulus in ways]
    handles.append(axes.plot([], [], color=colours.INK, linewidth=0.8, linestyle=(0, (1.2, 1.6)),
                             label="the tube of equal mean speeds")[0])
    axes.legend(handles=handles, frameon=False, loc="upper left")
