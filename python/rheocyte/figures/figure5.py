"""Figure 5: shapes of solids and shells after the analytical model, the linear and the neo-Hookean law."""

from dataclasses import dataclass

import numpy as np
from matplotlib.patches import Rectangle

from rheocyte import colours
from rheocyte.contour import bridges, closed, convex_hull, resampled
from rheocyte.figures import paper, style
from rheocyte.body import seen

SOLIDS = [(4.38, 9.16), (7.11, 9.16), (5.69, 2.29)]  # radius in um, Young's modulus in kPa
SHELLS = [(5.47, 20.9), (7.11, 20.9), (8.37, 20.9)]  # radius in um, E2D in mN/m
LAWS = ["linear", "neo-hookean"]
MODELS = {"analytical": ("analytical", style.ANALYTICAL), "linear": ("linear", style.LINEAR),
          "neo-hookean": ("neo-Hookean", style.NEO_HOOKEAN)}
WALL = 0.14  # thickness of the drawn wall, in channel radii
HALF_LENGTH_UM = 14.3
SIDE_IN, GAP_IN = 0.06, 0.14  # beside and between the panels
PANEL_IN = (style.WIDTH_IN - 2 * SIDE_IN - 2 * GAP_IN) / 3
HEAD_IN, LINES_IN, VIEWS_IN, FOOT_IN = 0.36, 0.47, 1.6, 0.30  # titles, numbers, row of views, legend
BEHIND_DEG = (52, 18)  # azimuth and elevation of the eye
VIEW_UM, PIXELS = 11.5, 340  # half the width of a view, and its width
POINTS = 480  # of a drawn contour
LEAST_DENT_UM = 0.1  # depth from which the chord over a dent is drawn
MARKS = 40  # dots on a whole contour
SEEN = 5e-4  # a raw deformation that differs by less is not seen


@dataclass
class Shape:
    """One cell in all models: name of model -> Solution."""

    title: str
    solutions: dict


def make(laboratory):
    """The figure and the rows of its table."""
    cells = {f"solid-{r:g}um-{e:g}kPa": (paper.solid, r, e) for r, e in SOLIDS}
    cells |= {f"shell-{r:g}um-{e:g}mN_m": (paper.shell, r, e) for r, e in SHELLS}
    solved = laboratory.solve({f"{name}-{law}": kind(radius, modulus, law)
                               for name, (kind, radius, modulus) in cells.items() for law in LAWS})
    shapes = []
    for name, (kind, radius, modulus) in cells.items():
        analytical = laboratory.analytic(f"{name}-analytical", kind(radius, modulus, "linear"))
        stiffness = f"$E$ = {modulus:g} kPa" if kind is paper.solid else f"$E_{{2D}}$ = {modulus:g} mN/m"
        shapes.append(Shape(f"$r_0$ = {radius:g} µm,  {stiffness}",
                            {"analytical": analytical} | {law: solved[f"{name}-{law}"] for law in LAWS}))
    return draw(shapes), [row for name, shape in zip(cells, shapes) for row in rows(name, shape)]


def rows(name, shape):
    """Lines of the table: numbers, or empty fields and the reason."""
    columns = {"deformation": 7, "deformation_raw": 7, "area_um2": 4, "area_raw_um2": 4}
    for model, solution in shape.solutions.items():
        yield {"cell": name, "model": model, "status": solution.result["status"],
               **{key: f"{solution[key]:.{digits}f}" if solution.converged else "" for key, digits in columns.items()}}


def draw(shapes):
    """Two rows of three cells, each in its piece of the channel; the dented one seen in space; the legend below."""
    height = PANEL_IN * (1 + WALL) * paper.CHANNEL_RADIUS_UM / HALF_LENGTH_UM
    row_height = HEAD_IN + height + LINES_IN
    total = FOOT_IN + VIEWS_IN + HEAD_IN + 2 * row_height
    figure = style.new_figure(total)
    for index, shape in enumerate(shapes):
        row, column = divmod(index, 3)
        bottom = total - (row + 1) * row_height + LINES_IN
        left = panel_left(column)
        axes = figure.add_axes([left / style.WIDTH_IN, bottom / total, PANEL_IN / style.WIDTH_IN, height / total])
        draw_channel(axes)
        if column == 0:
            draw_scale_and_flow(axes)
        draw_shape(axes, shape)
        tell_numbers(figure, shape, left, bottom - 0.06, total)
        tell_above(figure, column, bottom + height, shape.title, total)
    draw_views(figure, shapes[-1].solutions["linear"], total)
    titles = ["a   elastic solids",
              f"b   elastic shells with tension {paper.TENSION_RATIO:g} $E_{{2D}}$ round a liquid",
              f"c   the camera does not see the dent: linear shell, {shapes[-1].title}"]
    for row, title in enumerate(titles):
        figure.text(SIDE_IN / style.WIDTH_IN, (total - row * row_height - 0.02) / total, title, va="top", weight="bold",
                    fontsize=7.5)
    draw_legend(figure, FOOT_IN, total)
    return figure


def panel_left(column):
    """Left edge of a column in inches."""
    return SIDE_IN + column * (PANEL_IN + GAP_IN)


def tell_above(figure, column, top, text, total):
    """The title of one panel."""
    figure.text((panel_left(column) + PANEL_IN / 2) / style.WIDTH_IN, (top + 0.05) / total, text, ha="center",
                va="bottom")


def draw_views(figure, solution, total):
    """The last shell from behind and from the side, and its section with the part that the convex hull adds."""
    half = VIEWS_IN / PANEL_IN * HALF_LENGTH_UM  # of the height, at the scale of the rows above
    titles = ["seen from behind", "seen from the side, as in the channel", "section and its convex hull"]
    for column, (title, angles) in enumerate(zip(titles, [BEHIND_DEG, (0, 0), None])):
        axes = figure.add_axes([panel_left(column) / style.WIDTH_IN, FOOT_IN / total, PANEL_IN / style.WIDTH_IN,
                                VIEWS_IN / total])
        axes.set(xlim=(-HALF_LENGTH_UM, HALF_LENGTH_UM), ylim=(-half, half), aspect="equal")
        axes.axis("off")
        tell_above(figure, column, FOOT_IN + VIEWS_IN - 0.03, title, total)
        if not solution.converged:
            style.note(axes, solution.trouble)
        elif angles:
            edge = VIEW_UM
            axes.imshow(seen(solution.contour(), *angles, edge, PIXELS, colours.CELL), origin="lower",
                        extent=(-edge, edge, -edge, edge), interpolation="antialiased")
            axes.set(xlim=(-HALF_LENGTH_UM, HALF_LENGTH_UM), ylim=(-half, half))
        else:
            draw_dent(axes, solution)


def draw_dent(axes, solution):
    """The section, and hatched what is added to make it convex."""
    outline = drawn(solution)
    axes.fill(*outline[convex_hull(outline)].T, facecolor="white", edgecolor="#9aa3ab", hatch="////////", linewidth=0,
              zorder=1)
    axes.fill(*outline.T, facecolor="#fdf0cf", edgecolor=style.LINEAR, linewidth=1.0, zorder=2)
    for chord in bridges(outline, convex_hull(outline), least_depth=LEAST_DENT_UM):
        axes.plot(*chord.T, color=style.LINEAR, linewidth=0.8, dashes=(3, 1.6), zorder=3)
    raw, convex = solution["deformation_raw"], solution["deformation"]
    axes.text(0.5, 0, f"section\n$d$ = {raw:.4f}\n\nconvex\n$d$ = {convex:.4f}", ha="center", va="center", fontsize=6.5,
              zorder=4)


def draw_channel(axes):
    """Liquid, walls and the axis of symmetry."""
    radius, thickness = paper.CHANNEL_RADIUS_UM, WALL * paper.CHANNEL_RADIUS_UM
    axes.set(xlim=(-HALF_LENGTH_UM, HALF_LENGTH_UM), ylim=(-radius - thickness, radius + thickness), aspect="equal")
    axes.axis("off")
    axes.add_patch(Rectangle((-HALF_LENGTH_UM, -radius), 2 * HALF_LENGTH_UM, 2 * radius, color="#eef4f8", zorder=0,
                             linewidth=0))
    for lower in (radius, -radius - thickness):
        axes.add_patch(Rectangle((-HALF_LENGTH_UM, lower), 2 * HALF_LENGTH_UM, thickness, color="#d3d8dc", linewidth=0,
                                 zorder=1))
    for wall in (radius, -radius):
        axes.plot([-HALF_LENGTH_UM, HALF_LENGTH_UM], [wall, wall], color=colours.INK, linewidth=0.9, zorder=1.1)
    axes.plot([-HALF_LENGTH_UM, HALF_LENGTH_UM], [0, 0], color="#9aa3ab", linewidth=0.4, dashes=(8, 3, 1, 3),
              zorder=0.5)


def draw_scale_and_flow(axes):
    """Scale bar in the lower wall, flow direction in the upper one."""
    thickness = WALL * paper.CHANNEL_RADIUS_UM
    level, plate = paper.CHANNEL_RADIUS_UM + thickness / 2, {"facecolor": "white", "linewidth": 0, "zorder": 2}
    axes.add_patch(Rectangle((-HALF_LENGTH_UM, level - thickness / 2), 7.2, thickness, **plate))
    axes.text(-HALF_LENGTH_UM + 0.4, level, "flow", va="center_baseline", fontsize=6.5, zorder=3)
    axes.annotate("", xy=(-HALF_LENGTH_UM + 6.8, level), xytext=(-HALF_LENGTH_UM + 3.0, level), zorder=3,
                  arrowprops={"arrowstyle": "-|>,head_length=0.35,head_width=0.16", "color": colours.INK,
                              "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 10})
    axes.add_patch(Rectangle((HALF_LENGTH_UM - 9.3, -level - thickness / 2), 9.3, thickness, **plate))
    axes.plot([HALF_LENGTH_UM - 5.4, HALF_LENGTH_UM - 0.4], [-level, -level], color=colours.INK, linewidth=1.8,
              zorder=3, solid_capstyle="butt")
    axes.text(HALF_LENGTH_UM - 5.8, -level, "5 µm", ha="right", va="center_baseline", fontsize=6.5, zorder=3)


def draw_shape(axes, shape):
    """Line, dots and circles, as in the paper, over the filled cell; what failed is a note."""
    outlines = {model: drawn(solution) for model, solution in shape.solutions.items() if solution.converged}
    filled = outlines.get("neo-hookean", outlines.get("linear"))
    if filled is not None:
        axes.fill(*filled.T, facecolor="#fdf0cf", zorder=3, linewidth=0)
    for model, outline in outlines.items():
        draw_outline(axes, model, outline)
    failed = [f"{MODELS[model][0]}: {solution.trouble}" for model, solution in shape.solutions.items()
              if not solution.converged]
    for index, text in enumerate(failed):
        style.note(axes, text, y=0.5 + 0.24 * ((len(failed) - 1) / 2 - index))


def drawn(solution):
    """The whole contour as a closed polygon that is fine enough for print."""
    return closed(resampled(solution.contour(), POINTS // 2 + 1))


def draw_outline(axes, model, outline):
    """One contour in its model's way."""
    colour = MODELS[model][1]
    if model == "neo-hookean":
        axes.plot(*outline.T, color=colour, linewidth=1.0, zorder=4, solid_joinstyle="round")
        for chord in bridges(outline, convex_hull(outline), least_depth=LEAST_DENT_UM):
            axes.plot(*chord.T, color=colour, linewidth=0.8, dashes=(3, 1.6), zorder=4)
    elif model == "linear":
        axes.plot(*spaced(outline, 0.5).T, color=colour, linestyle="none", marker="o", markersize=2.0,
                  markeredgewidth=0, zorder=5)
    else:
        axes.plot(*spaced(outline, 0).T, color=colour, linestyle="none", marker="o", markersize=3.2,
                  markerfacecolor="none", markeredgewidth=0.7, zorder=4.5)


def spaced(outline, shift):
    """Marks at equal distances along a closed polygon, the first one `shift` distances from its start."""
    return resampled(outline, MARKS + 1, shift)[:-1]


def tell_numbers(figure, shape, left, top, total):
    """Deformation after each model below the cell, with that of the raw contour where the rear is dented."""
    for index, (model, solution) in enumerate(shape.solutions.items()):
        y = (top - 0.125 * index) / total
        name, colour = MODELS[model]
        columns = [(0.02, name), (0.68, number(solution))]
        if solution.converged and abs(solution["deformation_raw"] - solution["deformation"]) > SEEN:
            columns.append((1.28, f"with the dent {solution['deformation_raw']:.4f}"))
        for x, text in columns:
            figure.text((left + x) / style.WIDTH_IN, y, text, va="top", color=colour, fontsize=6.5)


def number(solution):
    """The deformation, a small one with one digit more."""
    if not solution.converged:
        return "–"
    deformation = solution["deformation"]
    return f"$d$ = {deformation:.{5 if deformation < 0.01 else 4}f}"


def draw_legend(figure, foot, total):
    """What the marks mean."""
    axes = figure.add_axes([0, 0, 1, foot / total])
    axes.axis("off")
    handles = [
        axes.plot([], [], color=style.ANALYTICAL, linestyle="none", marker="o", markersize=3.2,
                  markerfacecolor="none", markeredgewidth=0.7, label="analytical, small deformations")[0],
        axes.plot([], [], color=style.LINEAR, linestyle="none", marker="o", markersize=2.4, markeredgewidth=0,
                  label="linear law")[0],
        axes.plot([], [], color=style.NEO_HOOKEAN, linewidth=1.0, label="neo-Hookean law")[0],
        axes.plot([], [], color=style.NEO_HOOKEAN, linewidth=0.8, dashes=(3, 1.6),
                  label="convex hull, as the camera sees the cell ($d$)")[0]]
    axes.legend(handles=handles, loc="center", ncol=4, frameon=False, handlelength=1.8, columnspacing=2.2,
                borderaxespad=0)
