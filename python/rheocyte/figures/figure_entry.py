"""Figure entry: a cell enters a narrow channel, for several viscosities of the cell; not in the paper, its announced work."""

import numpy as np
from matplotlib import colormaps

from rheocyte import colours
from rheocyte.contour import closed
from rheocyte.figures import paper, style
from rheocyte.files import number, read_table
from rheocyte.time_picture import read_contours

RADIUS_UM, YOUNG_MODULUS_KPA = 7.0, 4.58
WIDE_UM, NARROW_UM = 21.88, paper.CHANNEL_RADIUS_UM
CONTRACTION_UM = (60.0, 100.0)  # from the start of the cell
END_US = 4000.0
VISCOSITIES = [5.0, 15.0, 50.0, 150.0]
SHOWN_UM = (40.0, 320.0)  # of the way
PLACES_UM = [45.0, 72.0, 93.0, 118.0, 150.0, 190.0]  # of the contours
FILL, EDGE, WALL = "#fbc873", "#9c1f3a", "#9aa5ad"


def make(laboratory):
    """The figure and the rows of its table."""
    narrow = paper.solid(RADIUS_UM, YOUNG_MODULUS_KPA, "neo-hookean")
    cases = {"entry-stationary": narrow} | {f"entry-{eta:g}mPas": entering(narrow, eta) for eta in VISCOSITIES}
    solved = laboratory.solve(cases)
    return draw(solved), list(rows(solved))


def entering(narrow, viscosity):
    """The cell on its way from the wide channel into the narrow one."""
    case = {key: value for key, value in narrow.items() if key != "channel.radius_um"}
    profile = {"x_um": list(CONTRACTION_UM), "R_um": [WIDE_UM, NARROW_UM]}
    return paper.section("channel.profile", profile) | case | {
        "cell.viscosity_mPas": viscosity, **paper.section("time", {"end_us": END_US, "output_every_us": 25.0})}


def columns(path, names):
    """Columns of a table as arrays."""
    return np.array([[number(row, name, path) for name in names] for row in read_table(path, names)]).T


def history(solution):
    """Time in us, place in um, deformation."""
    return columns(solution.folder / "history.csv", ["t_us", "position_um", "deformation"])


def peak(x, d):
    """Step, place and value of the greatest deformation in the contraction: of the parabola through three steps."""
    k = np.argmax(np.where(x < CONTRACTION_UM[1] + RADIUS_UM, d, 0))
    a, b, c = np.polyfit(x[k - 1:k + 2] - x[k], d[k - 1:k + 2], 2)
    return k, x[k] - b / (2 * a), c - b * b / (4 * a)


def rows(solved):
    """Lines of the table."""
    still = solved["entry-stationary"]
    for eta in VISCOSITIES:
        solution = solved[f"entry-{eta:g}mPas"]
        row = {"cell_viscosity_mPas": eta, "status": solution.result["status"]}
        row |= dict.fromkeys(["peak_deformation", "peak_position_um", "least_deformation_behind", "deformation_at_end",
                              "stationary_deformation", "relative_difference",
                              "greatest_relative_volume_change"], "")
        if solution.converged and still.converged:
            t, x, d = history(solution)
            top, place, highest = peak(x, d)
            volume = columns(solution.folder / "history.csv", ["relative_volume_change"])
            row |= {"peak_deformation": f"{highest:.5f}", "peak_position_um": f"{place:.1f}",
                    "least_deformation_behind": f"{d[top:].min():.5f}", "deformation_at_end": f"{d[-1]:.7f}",
                    "stationary_deformation": f"{still['deformation']:.7f}",
                    "relative_difference": f"{d[-1] / still['deformation'] - 1:.1e}",
                    "greatest_relative_volume_change": f"{np.abs(volume).max():.1e}"}
        yield row


def draw(solved):
    """The cell in the channel above its deformation over place and time."""
    figure = style.new_figure(3.6, layout="constrained")
    grid = figure.add_gridspec(2, 2, height_ratios=[1, 1.5])
    channel, left, right = (figure.add_subplot(part) for part in (grid[0, :], grid[1, 0], grid[1, 1]))
    draw_channel(channel, solved["entry-15mPas"])
    still = solved["entry-stationary"]
    for k, eta in enumerate(VISCOSITIES):
        solution = solved[f"entry-{eta:g}mPas"]
        if not solution.converged:
            style.note(left, f"{eta:g} mPa s: {solution.trouble}")
            continue
        t, x, d = history(solution)
        colour = colormaps["viridis"](k / len(VISCOSITIES))
        left.plot(x, d, color=colour, linewidth=1, label=rf"$\eta_1$ = {eta:g} mPa s")
        right.plot(t - np.interp(CONTRACTION_UM[1], x, t), d, color=colour, linewidth=1)
    for axes in (left, right):
        axes.set(ylabel="deformation $d$")
        axes.set_ylim(bottom=0)
        if still.converged:
            axes.axhline(still["deformation"], color=WALL, linewidth=0.6, zorder=0)
    left.axvspan(*CONTRACTION_UM, color=WALL, alpha=0.25, linewidth=0)
    left.set(xlim=SHOWN_UM, xlabel="place of the cell (µm)", title="b   along the channel; grey: contraction")
    right.set(xlim=(-600, 1000), xlabel="time after the contraction (µs)", title="c   over time; grey: stationary")
    left.legend(frameon=False, fontsize=6, loc="lower right")
    return figure


def draw_channel(axes, solution):
    """The wall, and the cell at some places."""
    axes.set(title=r"a   the cell of $\eta_1$ = 15 mPa s on its way", xlabel="µm")
    if not solution.converged:
        style.note(axes, solution.trouble)
        return
    x, radius = columns(solution.folder / "channel.csv", ["x_um", "R_um"])
    x, radius = np.append(x, SHOWN_UM[1]), np.append(radius, radius[-1])
    for side in (-1, 1):
        axes.fill_between(x, side * radius, side * 1.15 * WIDE_UM, color=WALL, linewidth=0)
    times, shapes = read_contours(solution.folder / "contours.csv")
    t, way, _ = history(solution)
    places = np.interp(times, t, way)
    for place in PLACES_UM:
        k = int(np.argmin(np.abs(places - place)))
        axes.fill(*(closed(shapes[k]) + [places[k], 0]).T, facecolor=FILL, edgecolor=EDGE, linewidth=0.6)
    axes.set(xlim=(SHOWN_UM[0] - 15, 220), ylim=(-1.15 * WIDE_UM, 1.15 * WIDE_UM), aspect="equal", yticks=[-20, 0, 20])
