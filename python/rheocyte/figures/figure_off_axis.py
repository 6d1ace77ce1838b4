"""Figure off-axis: cells off the axis in height, as the camera sees them, and how soon they leave that place."""

import numpy as np

from rheocyte.figures import style

RADII_UM = [4.0, 6.0]
YOUNG_MODULI_KPA = [0.5, 1.0, 2.0]
OFFSETS_UM = {4.0: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0], 6.0: [0.0, 1.0, 2.0, 3.0]}
WIDTH_UM = 20.0
ACCURACY = 1e-2
CONDITIONS = {"channel.section": "square", "channel.width_um": WIDTH_UM, "flow.rate_ul_per_s": 0.04,
              "flow.density_kg_per_m3": 0, "flow.law": "power-law", "flow.consistency_Pa_sn": 0.4057,
              "flow.exponent": 0.6039, "numerics.accuracy": ACCURACY}
ENDS = ("surface-unstable", "limit-point", "branch-ended", "mesh-folded", "accuracy-not-reached")  # a cell that is too soft there
COLUMNS = ["deformation", "inertia_ratio", "mode_2", "mode_3", "cell_velocity_m_per_s", "drift_velocity_m_per_s",
           "rotation_rate_per_s"]
DRAWN = [("inertia_ratio", "inertia ratio"), ("mode_2", "$c_2$"), ("mode_3", "$c_3$"), ("deformation", "deformation")]


def make(laboratory):
    """The figure and the rows of its table."""
    cells = [(radius, young, offset) for radius in RADII_UM for young in YOUNG_MODULI_KPA
             for offset in OFFSETS_UM[radius]]
    solved = laboratory.solve({name(*cell): case(*cell) for cell in cells})
    states = {cell: solved[name(*cell)] for cell in cells}
    # Cells that are too soft to have a smooth stationary shape at their place are an answer, not a failure.
    laboratory.failures = [failure for failure in laboratory.failures if failure.result["status"] not in ENDS]
    return draw(states), [row(cell, state) for cell, state in states.items()]


def name(radius, young, offset):
    """Of the case."""
    return f"off-axis-{radius:g}um-{young:g}kPa-{offset:g}um"


def case(radius, young, offset):
    """A neo-Hookean solid off the axis in height, seen along it."""
    return {**CONDITIONS, "cell.radius_um": radius, "cell.bulk.law": "neo-hookean",
            "cell.bulk.young_modulus_kPa": young, "cell.offset_um": [0.0, offset]}


def row(cell, state):
    """Of the table: numbers, or empty fields where there is no smooth shape; on the axis nothing drifts or turns."""
    radius, young, offset = cell
    still = {"drift_velocity_m_per_s": 0.0, "rotation_rate_per_s": 0.0} if offset == 0 else {}
    numbers = [f"{still[key] if key in still else state[key]:.6g}" if state.converged else "" for key in COLUMNS]
    return {"radius_um": radius, "young_modulus_kPa": young, "offset_um": offset, "status": state.result["status"],
            **dict(zip(COLUMNS, numbers))}


def fading_length_um(state, offset):
    """Way along the channel in which the offset would fall by a factor of e at the present drift."""
    return -offset * state["cell_velocity_m_per_s"] / state["drift_velocity_m_per_s"]


def draw(states):
    """The measures against the offset, one column for each radius, and the length on which the offset fades."""
    figure = style.new_figure(6.6)
    axes = figure.subplots(len(DRAWN) + 1, len(RADII_UM), sharex="col", sharey="row")
    colours = dict(zip(YOUNG_MODULI_KPA, [style.LINEAR, style.ANALYTICAL, style.NEO_HOOKEAN]))
    for column, radius in zip(axes.T, RADII_UM):
        for young in YOUNG_MODULI_KPA:
            there = [(offset, states[radius, young, offset]) for offset in OFFSETS_UM[radius]
                     if states[radius, young, offset].converged]
            line = {"color": colours[young], "linewidth": 0.9, "marker": "o", "markersize": 2.5}
            offsets = np.array([offset for offset, _ in there])
            for ax, (key, _) in zip(column, DRAWN):
                ax.plot(offsets, [state[key] for _, state in there], label=f"{young:g} kPa", **line)
            moved = [(offset, fading_length_um(state, offset)) for offset, state in there if offset > 0]
            column[-1].semilogy(*np.array(moved).reshape(-1, 2).T, **line)
        column[0].set_title(f"$r_0$ = {radius:g} µm")
        column[-1].set_xlabel("offset in height (µm)")
    for ax, label in zip(axes[:, 0], [label for _, label in DRAWN] + ["way of the\noffset's decay (µm)"]):
        ax.set_ylabel(label)
    axes[0, 0].legend(frameon=False, title="$E$")
    figure.subplots_adjust(left=0.11, right=0.98, top=0.95, bottom=0.07, hspace=0.15, wspace=0.08)
    return figure
