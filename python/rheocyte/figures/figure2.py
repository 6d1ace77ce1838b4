"""Figure 2: the way to the stationary shape of the paper's four models, their volume, and the cell's viscosity."""

import numpy as np
from matplotlib import colormaps

from rheocyte.figures import paper, style
from rheocyte.files import number, read_table

RADIUS_UM, YOUNG_MODULUS_KPA, SHELL_MODULUS = 7.66, 3.437, 31.3
END_US, SHOWN_US = 3000.0, 800.0
VISCOSITY_MPAS = 15.0  # of the cell; the paper's is that of the liquid
VISCOSITIES = [5.0, 15.0, 50.0, 150.0]
SETTLED = 0.01  # a deformation that stays this close to its end, relatively
MODELS = {"linear-solid": ("linear solid", style.LINEAR, "-"),
          "neo-hookean-solid": ("neo-Hookean solid", style.NEO_HOOKEAN, "-"),
          "linear-shell": ("linear shell", style.ANALYTICAL, "-"),
          "neo-hookean-shell": ("neo-Hookean shell", style.SECOND, "--")}


def make(laboratory):
    """The figure and the rows of its table."""
    cases = {f"stationary-{name}": model(name) for name in MODELS}
    cases |= {f"time-{name}": in_time(model(name), VISCOSITY_MPAS) for name in MODELS}
    cases |= {f"viscosity-{eta:g}mPas": in_time(model("neo-hookean-solid"), eta) for eta in VISCOSITIES}
    solved = laboratory.solve(cases)
    return draw(solved), list(rows(solved))


def model(name):
    """The stationary case of one of the four models."""
    law, kind = name.rsplit("-", 1)
    if kind == "solid":
        return paper.solid(RADIUS_UM, YOUNG_MODULUS_KPA, law)
    return paper.shell(RADIUS_UM, SHELL_MODULUS, law)


def in_time(case, viscosity):
    """The same case followed from the sphere."""
    return {**case, "cell.viscosity_mPas": viscosity,
            **paper.section("time", {"end_us": END_US, "output_every_us": 100.0})}


def history(solution):
    """Columns of history.csv: time in us, deformation, relative change of the volume."""
    path = solution.folder / "history.csv"
    names = ["t_us", "deformation", "relative_volume_change"]
    return np.array([[number(row, name, path) for name in names] for row in read_table(path, names)]).T


def settling_time(t, d):
    """The time in us after which the deformation stays within SETTLED of its end."""
    outside = np.flatnonzero(np.abs(d / d[-1] - 1) > SETTLED)
    k = outside[-1]
    fraction = (np.abs(d[k] / d[-1] - 1) - SETTLED) / np.abs(d[k] - d[k + 1]) * d[-1]
    return t[k] + fraction * (t[k + 1] - t[k])


def rows(solved):
    """Lines of the table."""
    runs = [(name, VISCOSITY_MPAS, f"time-{name}") for name in MODELS]
    runs += [("neo-hookean-solid", eta, f"viscosity-{eta:g}mPas") for eta in VISCOSITIES]
    for name, viscosity, run in runs:
        solution, stationary = solved[run], solved[f"stationary-{name}"]
        row = {"model": name, "cell_viscosity_mPas": viscosity, "status": solution.result["status"]}
        row |= dict.fromkeys(["deformation_at_end", "stationary_deformation", "relative_difference",
                              "max_deformation", "settled_us", "greatest_relative_volume_change"], "")
        if solution.converged and stationary.converged:
            t, d, volume = history(solution)
            still = stationary["deformation"]
            row |= {"deformation_at_end": f"{d[-1]:.7f}", "stationary_deformation": f"{still:.7f}",
                    "relative_difference": f"{d[-1] / still - 1:.1e}", "max_deformation": f"{d.max():.6f}",
                    "settled_us": f"{settling_time(t, d):.1f}",
                    "greatest_relative_volume_change": f"{np.abs(volume).max():.1e}"}
        yield row


def draw(solved):
    """Deformation, volume, and the influence of the cell's viscosity."""
    figure = style.new_figure(2.5, layout="constrained")
    panels = figure.subplots(1, 3)
    for name, (label, colour, line) in MODELS.items():
        solution, stationary = solved[f"time-{name}"], solved[f"stationary-{name}"]
        if not solution.converged:
            style.note(panels[0], f"{label}: {solution.trouble}")
            continue
        t, d, volume = history(solution)
        panels[0].plot(t, d, line, color=colour, linewidth=1, label=label)
        panels[1].semilogy(t[1:], np.maximum(np.abs(volume[1:]), 1e-16), line, color=colour, linewidth=0.8)
        if stationary.converged:
            panels[0].plot(SHOWN_US, stationary["deformation"], "<", color=colour, markersize=4, clip_on=False)
    for k, eta in enumerate(VISCOSITIES):
        solution = solved[f"viscosity-{eta:g}mPas"]
        if not solution.converged:
            style.note(panels[2], f"{eta:g} mPa s: {solution.trouble}")
            continue
        t, d, _ = history(solution)
        panels[2].plot(t, d, color=colormaps["viridis"](k / len(VISCOSITIES)), linewidth=1,
                       label=rf"$\eta_1$ = {eta:g} mPa s")
    titles = ("a   four models, \u25c2 stationary", "b   volume of the cell", "c   viscosity of the cell")
    for axes, title in zip(panels, titles):
        axes.set(xlim=(0, SHOWN_US), xlabel="time (µs)", title=title)
    for axes in (panels[0], panels[2]):
        axes.set(ylim=(0, 0.046), ylabel="deformation $d$")
        axes.legend(frameon=False, fontsize=6, loc="lower right")
    panels[1].set(ylim=(1e-16, 1e-2), ylabel=r"$|V - V_0|\,/\,V_0$")
    panels[1].axhline(2e-3, color="#9aa3ab", linewidth=0.6)
    panels[1].text(SHOWN_US, 2.6e-3, "the paper's", ha="right", va="bottom", fontsize=6)
    return figure
