"""Figure 6: the deformation of a linear solid against the bending stiffness and against the Reynolds number."""

from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, MultipleLocator

from rheocyte import colours
from rheocyte.figures import paper, style
from rheocyte.page import thousands

AREA_UM2 = 137.6  # of the deformed cell at rho = 1000 kg/m3 and without bending stiffness
AREA_TOLERANCE = 2e-5
MOST_TRIALS = 8
SOFT_KPA, STIFF_KPA = 2.29, 4.58
BENDING_KBT = [0, 1e2, 2e2, 5e2, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 1.5e5, 2e5, 2.5e5]
FLAT_KBT, MEMBRANE_KBT = 1e4, (25, 100)  # the paper's limit; lipid bilayers
FLAT = 0.005  # a relative change that a camera does not resolve
DENSITIES = [1e3, 5e3, 1e4, 2e4, 3e4, 4e4, 5e4, 6e4, 7e4, 8e4, 9e4, 1e5, 1.08e5]  # the last one for Re = 13.3
FOLDS = {10: 1e4, 100: 1e5}  # of the first density
ACCURACY = 1e-5  # of the deformation: the changes to be seen are as small as 1e-3
GREATEST_RISE = 0.19  # top of the axes, relative to the first deformation


@dataclass
class Series:
    """Solutions in the order of a parameter; the first one is the state to which changes relate."""

    values: list
    solutions: list

    def converged(self):
        """Values and solutions that may be drawn."""
        return [(value, solution) for value, solution in zip(self.values, self.solutions) if solution.converged]

    def deformations(self):
        return np.array([solution["deformation"] for _, solution in self.converged()])

    def change(self, value):
        """Relative change of the deformation from the first state to the one at a value; nan if either is missing."""
        first, there = self.solutions[0], self.solutions[self.values.index(value)]
        return there["deformation"] / first["deformation"] - 1 if first.converged and there.converged else np.nan


@dataclass
class Line:
    """Least-squares line d = start + slope Re, and how far the points are from it, relative to the first."""

    start: float
    slope: float
    distance: float


def make(laboratory):
    """The figure and the rows of its table."""
    radii = radii_of_area(laboratory, [SOFT_KPA, STIFF_KPA])
    cases = {}
    if SOFT_KPA in radii:
        cases |= {f"bending-{c:g}kBT": cell(radii, SOFT_KPA) | {"cell.cortex.bending_kBT": float(c)}
                  for c in BENDING_KBT}
    cases |= {density_name(e, rho): cell(radii, e) | {"flow.density_kg_per_m3": rho}
              for e in radii for rho in DENSITIES}
    solved = laboratory.solve(cases)
    bending = Series(BENDING_KBT, [solved[f"bending-{c:g}kBT"] for c in BENDING_KBT]) if SOFT_KPA in radii else None
    inertia = {e: Series(DENSITIES, [solved[density_name(e, rho)] for rho in DENSITIES]) for e in radii}
    return draw(radii, bending, inertia), list(rows(radii, bending, inertia))


def density_name(modulus, density):
    """Name of a case of the right panel."""
    return f"density-{density:g}kg_m3-{modulus:g}kPa"


def cell(radii, modulus):
    """The case without bending stiffness."""
    return paper.solid(radii[modulus], modulus, "linear", accuracy=ACCURACY)


def radii_of_area(laboratory, moduli):
    """Modulus -> radius at rest in um of the cell whose deformed area is AREA_UM2, by secant steps of all at once.

    A modulus is left out if a cell on the way does not converge or the steps do not end.
    """
    # The area grows like the square of the radius, and so does each step until there are two points.
    trials = {modulus: [float(np.sqrt(AREA_UM2 / np.pi))] for modulus in moduli}
    areas, found = {modulus: [] for modulus in moduli}, {}
    for trial in range(1, MOST_TRIALS + 1):
        sought = [modulus for modulus in trials if modulus not in found]
        if not sought:
            break
        names = {f"radius-{modulus:g}kPa-{trial}": modulus for modulus in sought}
        solutions = laboratory.solve({name: cell({modulus: trials[modulus][-1]}, modulus)
                                      for name, modulus in names.items()})
        for name, modulus in names.items():
            if not solutions[name].converged:
                del trials[modulus]
                continue
            areas[modulus].append(solutions[name]["area_um2"])
            if abs(areas[modulus][-1] / AREA_UM2 - 1) < AREA_TOLERANCE:
                found[modulus] = trials[modulus][-1]
            trials[modulus].append(next_radius(trials[modulus], areas[modulus]))
    return {modulus: found[modulus] for modulus in moduli if modulus in found}


def next_radius(radii, areas):
    """Secant step to the requested area, in the square of the radius; rounded, so that case files stay legible."""
    squares = np.square(radii)
    slope = (areas[-1] - areas[-2]) / (squares[-1] - squares[-2]) if len(areas) > 1 else areas[-1] / squares[-1]
    return round(float(np.sqrt(squares[-1] + (AREA_UM2 - areas[-1]) / slope)), 6)


def fitted(series):
    """The line through the points of a series over the Reynolds number; None if fewer than three converged."""
    points = [(solution["reynolds"], solution["deformation"]) for _, solution in series.converged()]
    if len(points) < 3:
        return None
    reynolds, deformation = np.array(points).T
    slope, start = np.polyfit(reynolds, deformation, 1)
    return Line(start, slope, float(np.abs(start + slope * reynolds - deformation).max() / deformation[0]))


def rows(radii, bending, inertia):
    """Lines of the table: numbers, or empty fields where a cell did not converge or its radius was not found."""
    density = paper.CONDITIONS["flow.density_kg_per_m3"]
    panels = [("left", SOFT_KPA, bending, [(value, density) for value in BENDING_KBT])]
    panels += [("right", modulus, inertia.get(modulus), [(0, value) for value in DENSITIES])
               for modulus in (SOFT_KPA, STIFF_KPA)]
    for panel, modulus, series, conditions in panels:
        for index, (stiffness, density) in enumerate(conditions):
            yield {"panel": panel, "young_modulus_kPa": modulus, "radius_um": radii.get(modulus, ""),
                   "bending_kBT": stiffness, "density_kg_per_m3": density, **outcome(series, index)}


def outcome(series, index):
    """The line of the table for one solution."""
    status = series.solutions[index].result["status"] if series else "radius not found"
    digits = {"reynolds": 5, "area_um2": 4, "deformation": 7}
    if status != "converged":
        return {"status": status, **dict.fromkeys(digits, ""), "relative_change": ""}
    change = series.change(series.values[index])
    return {"status": status, **{key: f"{series.solutions[index][key]:.{n}f}" for key, n in digits.items()},
            "relative_change": f"{change:.6f}" if np.isfinite(change) else ""}


def draw(radii, bending, inertia):
    """Bending on the left; on the right one axis for each modulus, with equal relative scales."""
    figure = style.new_figure(3.1)
    left = figure.add_axes([0.094, 0.142, 0.330, 0.765])
    draw_bending(left, radii, bending)
    upper, lower = (figure.add_axes([0.598, bottom, 0.330, 0.355]) for bottom in (0.552, 0.142))
    for axes, modulus, colour in ((upper, SOFT_KPA, style.LINEAR), (lower, STIFF_KPA, style.ANALYTICAL)):
        draw_inertia(axes, modulus, radii, inertia.get(modulus), colour)
    for axes, title, x in ((left, "a   linear solid, bending stiffness of its surface", 0.008),
                           (upper, "b   linear solid, inertia of the liquid", 0.512)):
        figure.text(x, 0.945, title, weight="bold", fontsize=7.5)
        axes.yaxis.set_label_coords(-0.215, 0.5)
    lower.yaxis.set_label_coords(-0.215, 0.5)
    upper.tick_params(labelbottom=False)
    lower.set_xlabel(r"Reynolds number $\rho_0 v_{cell} R/\eta_0$")
    return figure


def draw_bending(axes, radii, series):
    """Deformation against bending stiffness: zero has its place on the axis, then decades."""
    axes.set_xscale("symlog", linthresh=MEMBRANE_KBT[1], linscale=0.6)
    axes.set(xlim=(-12, 4.2e5), xlabel=r"bending stiffness $c_b$ ($k_BT$)", ylabel="deformation $d$")
    axes.xaxis.set_major_locator(FixedLocator([0, 1e2, 1e3, 1e4, 1e5]))
    axes.xaxis.set_minor_locator(FixedLocator([k * 10**n for n in (2, 3, 4, 5) for k in range(2, 10)]))
    axes.axvspan(*MEMBRANE_KBT, color="#e4e6e8", linewidth=0, zorder=0)
    points = series.converged() if series else []
    if not points or points[0][0] != 0:
        style.note(axes, trouble(series, f"the cell of {AREA_UM2:g} µm² was not found"))
        return
    values, deformations = [value for value, _ in points], series.deformations()
    start = deformations[0]
    axes.axhline(start, color="#9aa3ab", linewidth=0.6, zorder=1)
    axes.plot(values, deformations, color=style.LINEAR, marker="o", markersize=3.6, linewidth=1, zorder=3,
              markeredgecolor="white", markeredgewidth=0.4)
    axes.set_ylim(start * 0.93, start * 1.012)
    axes.yaxis.set_major_locator(MultipleLocator(1e-3))
    relative_axis(axes, start)
    if np.isfinite(change := series.change(FLAT_KBT)):
        axes.plot([FLAT_KBT] * 2, [start * 0.978, start], color=colours.INK, linewidth=0.6, dashes=(3, 2), zorder=1)
        verdict = "flat below $10^4$ $k_BT$,\nthere" if abs(change) < FLAT else "$10^4$ $k_BT$:"
        axes.text(FLAT_KBT, start * 0.977, f"{verdict} {style.percent(change)}", ha="center", va="top", fontsize=6.5)
    axes.annotate(f"{thousands(values[-1])} $k_BT$: {style.percent(deformations[-1] / start - 1)}",
                  (values[-1], deformations[-1]), xytext=(-7, -1), textcoords="offset points", ha="right", va="center",
                  fontsize=6.5)
    axes.text(np.mean(MEMBRANE_KBT), start * 0.9315, "lipid bilayers", rotation=90, ha="center",
              va="bottom", fontsize=6)
    axes.text(0.99, 0.985, cell_text(SOFT_KPA, radii), transform=axes.transAxes, ha="right",
              va="top", fontsize=6.5)
    tell_failures(axes, series)


def draw_inertia(axes, modulus, radii, series, colour):
    """Deformation against the Reynolds number with its line, and the rise from the first to the last point."""
    axes.set(xlim=(0, 13.9), ylabel="deformation $d$")
    points = series.converged() if series else []
    if not points or points[0][0] != DENSITIES[0]:
        style.note(axes, trouble(series, f"E = {modulus:g} kPa: the cell of {AREA_UM2:g} µm² was not found"))
        return
    deformations = series.deformations()
    reynolds = np.array([solution["reynolds"] for _, solution in points])
    axes.set_ylim(deformations[0] * 0.985, deformations[0] * (1 + GREATEST_RISE))
    axes.yaxis.set_major_locator(MaxNLocator(5))
    relative_axis(axes, deformations[0])
    line = fitted(series)
    if line:
        ends = np.array([0, reynolds[-1]])
        axes.plot(ends, line.start + line.slope * ends, color=colours.INK, linewidth=0.7, dashes=(3, 2), zorder=2)
    axes.plot(reynolds, deformations, color=colour, linestyle="none", marker="o", markersize=3.8, zorder=3,
              markeredgecolor="white", markeredgewidth=0.4)
    told = [cell_text(modulus, radii)]
    told += [f"{factor}-fold $Re$: {style.percent(series.change(density))}" for factor, density in FOLDS.items()
             if np.isfinite(series.change(density))]
    if line:
        told.append(f"off the line by {100 * line.distance:.1f} % at most")
    axes.text(0.03, 0.97, "\n".join(told), transform=axes.transAxes, va="top", fontsize=6.5, linespacing=1.35)
    tell_failures(axes, series)


def cell_text(modulus, radii):
    """Which cell a curve belongs to."""
    return f"$E$ = {modulus:g} kPa, area {AREA_UM2:g} µm² ($r_0$ = {radii[modulus]:.3f} µm)"


def relative_axis(axes, start):
    """A second axis on the right: the same change in per cent of the first deformation."""
    percent = axes.secondary_yaxis("right", functions=(lambda deformation: 100 * (deformation / start - 1),
                                                       lambda change: start * (1 + change / 100)))
    percent.set_ylabel("change (%)")
    percent.yaxis.set_major_locator(MaxNLocator(5))
    percent.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:+g}".replace("-", "\u2212")
                                                    if value else "0"))
    percent.spines["right"].set_visible(True)


def trouble(series, otherwise):
    """Why the first state of a series is not there."""
    return series.solutions[0].trouble if series and not series.solutions[0].converged else otherwise


def tell_failures(axes, series):
    """A note with the values that are missing."""
    missing = [f"{value:g}" for value, solution in zip(series.values, series.solutions) if not solution.converged]
    if missing:
        style.note(axes, f"not solved at {', '.join(missing)}", y=0.3)
