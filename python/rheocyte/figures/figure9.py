"""Figure 9: deformation against the ratio of the moments of area for cells with a bulk and a cortex; and both moduli
from images of such cells, one by one and as a population."""

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from rheocyte.figures import bulk_and_cortex, paper, style

RADIUS_UM = 7.27
YOUNG_MODULI_KPA = [0.763, 1.527, 2.291, 3.055]
CORTEX_MODULI_MN_PER_M = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
FIRST_CORTEX = {0.763: 4.0}  # with less cortex there is no smooth shape at all
IMAGE_CELL = (2.3, 0.5)  # what the paper reads from its image: kPa, mN/m
LAW, ACCURACY = "neo-hookean", 1e-3
BENDING_KBT = 3e4  # keeps the cortex from wrinkling where it is compressed
ENDS = ("surface-unstable", "limit-point", "branch-ended", "mesh-folded", "accuracy-not-reached")  # a cell that is too soft
COLUMNS = ["young_modulus_kPa", "cortex_modulus_mN_per_m", "tension_mN_per_m", "status", "area_um2", "deformation",
           "moment_ratio"]


def make(laboratory):
    """The figure and the rows of its table."""
    cells = [(young, cortex) for young in YOUNG_MODULI_KPA for cortex in CORTEX_MODULI_MN_PER_M
             if cortex >= FIRST_CORTEX.get(young, 0)] + [IMAGE_CELL]
    solved = laboratory.solve({name(*cell): case(*cell) for cell in cells})
    states = {cell: solved[name(*cell)] for cell in cells}
    # Cells that are too soft to have a smooth stationary shape are an answer, not a failure.
    laboratory.failures = [failure for failure in laboratory.failures if failure.result["status"] not in ENDS]
    return draw(states, bulk_and_cortex.measured(laboratory)), [row(cell, state) for cell, state in states.items()]


def name(young, cortex):
    """Of the case."""
    return f"combined-{young:g}kPa-{cortex:g}mN_m"


def case(young, cortex):
    """A cell with a bulk, a cortex, and the paper's tension."""
    return {**paper.CONDITIONS, "cell.radius_um": RADIUS_UM, "cell.bulk.law": LAW, "cell.bulk.young_modulus_kPa": young,
            "cell.cortex.law": LAW, "cell.cortex.modulus_mN_per_m": cortex,
            "cell.cortex.tension_ratio": paper.TENSION_RATIO, "cell.cortex.bending_kBT": BENDING_KBT,
            "numerics.accuracy": ACCURACY}


def row(cell, state):
    """Of the table: numbers, or empty fields where there is no smooth shape."""
    numbers = [f"{state[key]:.6g}" if state.converged else "" for key in COLUMNS[4:]]
    return dict(zip(COLUMNS, [cell[0], cell[1], f"{paper.TENSION_RATIO * cell[1]:g}", state.result["status"], *numbers]))


def draw(states, measured):
    """One line for each Young's modulus, the cortex by colour, the image cell on top; below it moduli of virtual cells."""
    figure = style.new_figure(6.6)
    axes = figure.add_axes([0.085, 0.485, 0.775, 0.470])
    colours = colormaps["viridis"].reversed()
    scale = Normalize(CORTEX_MODULI_MN_PER_M[0] - 0.5, CORTEX_MODULI_MN_PER_M[-1] + 0.5)
    for young in YOUNG_MODULI_KPA:
        draw_line(axes, young, states, lambda cortex: colours(scale(cortex)))
    draw_image_cell(axes, states[IMAGE_CELL])
    axes.set(xlabel="$\\Lambda_1/\\Lambda_2$", ylabel="deformation $d$")
    axes.margins(0.09, 0.08)
    bar = figure.colorbar(ScalarMappable(scale, colours), cax=figure.add_axes([0.890, 0.485, 0.018, 0.470]))
    bar.set_label("$E_{2D}$ (mN/m)")
    bar.outline.set_visible(False)
    figure.text(0.008, 0.972, f"neo-Hookean bulk and cortex, $r_0$ = {RADIUS_UM:g} µm, "
                f"$\\gamma$ = {paper.TENSION_RATIO:g} $E_{{2D}}$", weight="bold", fontsize=7.5)
    figure.text(0.008, 0.395, "both moduli from images: virtual cells, masks of 0.34 µm pixels", weight="bold", fontsize=7.5)
    bulk_and_cortex.draw(figure.add_axes([0.085, 0.065, 0.775, 0.310]), *measured)
    return figure


def draw_line(axes, young, states, colour_of):
    """The cells of one Young's modulus with its value; dashed if some of them are too soft for a smooth shape."""
    points = [(cortex, states[young, cortex]) for cortex in CORTEX_MODULI_MN_PER_M if (young, cortex) in states]
    there = [(cortex, state) for cortex, state in points if state.converged]
    if not there:
        style.note(axes, f"E = {young:g} kPa: no smooth shape", x=0.3, y=0.95)
        return
    x = np.array([state["moment_ratio"] for _, state in there])
    y = np.array([state["deformation"] for _, state in there])
    is_whole = len(there) == len(points)
    axes.plot(x, y, color=style.NEO_HOOKEAN, linewidth=0.8, dashes=() if is_whole else (3, 1.5), zorder=2)
    axes.scatter(x, y, s=26, c=[colour_of(cortex) for cortex, _ in there], edgecolors="white", linewidths=0.4, zorder=3)
    if is_whole:
        axes.annotate(f"{1000 * young:.0f} Pa", (x[-1], y[-1]), xytext=(5, -3), textcoords="offset points", ha="left",
                      va="top", fontsize=6.5)
    else:
        leftmost = min(state["moment_ratio"] for state in states.values() if state.converged)
        beside = {"xytext": (6, 2), "ha": "left", "va": "bottom"} if x[0] == leftmost else {"xytext": (-5, -2), "ha": "right", "va": "top"}
        axes.annotate(f"{1000 * young:.0f} Pa, dashed:\nno smooth shape below {there[0][0]:g} mN/m", (x[0], y[0]),
                      textcoords="offset points", fontsize=6.5, **beside)


def draw_image_cell(axes, state):
    """Where the paper's moduli put its image cell."""
    if not state.converged:
        style.note(axes, f"the image cell: {state.trouble}", x=0.3, y=0.85)
        return
    axes.scatter([state["moment_ratio"]], [state["deformation"]], s=42, color="black", zorder=5)
    axes.annotate(f"image cell of the paper\n$E$ = {1000 * IMAGE_CELL[0]:g} Pa, $E_{{2D}}$ = {IMAGE_CELL[1]:g} mN/m",
                  (state["moment_ratio"], state["deformation"]), xytext=(-8, -2), textcoords="offset points", ha="right",
                  va="top", fontsize=6.5)
