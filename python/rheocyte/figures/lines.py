"""Lines of equal stiffness in the plane of area and a measure, from the branches of tables or the analytical model."""

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from rheocyte.figures import paper
from rheocyte.figures.cases import analytic_options
from rheocyte.figures.tables import MEASURES, branches

NODES = 6  # of the polynomials between radii
POINTS = 400
BEYOND = 0.15  # of the distance between radii: so far polynomials go beyond their nodes
ANALYTICAL_RADII_UM = np.linspace(3.8, 9.4, 21)
STEP_UM2 = 5  # of the rows in the tables
LEAST_RADII = 3


@dataclass
class Kind:
    """Solids or shells: their moduli, tables and cells."""

    name: str
    unit: str
    symbol: str
    moduli: list
    table: object  # name, law -> spec
    cell: object  # radius, modulus, law -> case
    power: int  # the strain is a function of r0^power / modulus in a wide channel


SOLIDS = Kind("solid", "kPa", "$E$", paper.YOUNG_MODULI_KPA, paper.solid_table, paper.solid, 1)
SHELLS = Kind("shell", "mN/m", "$E_{2D}$", paper.CORTEX_MODULI_MN_PER_M, paper.shell_table, paper.shell, 2)


@dataclass
class Line:
    """Cells of one modulus, dense in the radius at rest."""

    modulus: float
    radius_um: np.ndarray
    measures: dict  # name -> values
    ended: bool  # where the smooth branches end

    def __getitem__(self, name):
        return self.measures[name]

    def at_area(self, area, name):
        """A measure at areas; nan where the line has none."""
        return np.interp(area, self["area_um2"], self[name], left=np.nan, right=np.nan)

    def at_radius(self, radius_um, name):
        """A measure at a radius at rest; nan where the line has none."""
        return float(np.interp(radius_um, self.radius_um, self[name], left=np.nan, right=np.nan))


def numerical(laboratory, kind, law):
    """Lines of a law; an empty list if its table failed."""
    name = f"{law}-{kind.name}"
    found = branches(laboratory, name, kind.table(name, law), kind.moduli)
    lines = [line_of_branches(found, modulus, kind.power) for modulus in kind.moduli]
    return [line for line in lines if line]


def line_of_branches(found, modulus, power):
    """The line of a modulus up to the first radius whose branch ends before; None if there are too few radii.

    Between the radii runs a polynomial through the states of neighbours at nearly equal strain, which is a function of
    r0^power / modulus: along them everything changes slowly. Where the branches of neighbours end before that, it runs
    through their states of this modulus.
    """
    reached = [k for k, branch in enumerate(found) if branch.reaches(modulus)]
    if len(reached) < LEAST_RADII:
        return None
    first = reached[0]
    last = next((k for k in range(first, len(found)) if not found[k].reaches(modulus)), len(found)) - 1
    nodes = [(branch.radius_um, branch.at(modulus)) for branch in found[first:last + 1]]
    beyond = BEYOND * (found[1].radius_um - found[0].radius_um)
    end = end_between(found, last, modulus)
    if end:
        nodes = [node for node in nodes if end[0] - node[0] > beyond] + [end]
    if len(nodes) < LEAST_RADII:
        return None
    radii = np.linspace(nodes[0][0] - beyond, nodes[-1][0] + (0 if end else beyond), POINTS)
    line, strained = line_through(modulus, nodes, radii), at_equal_strain(found, modulus, power, radii, beyond)
    measures = {name: np.where(np.isfinite(strained[name]), strained[name], line[name]) for name in MEASURES}
    return Line(modulus, radii, measures, end is not None)


def at_equal_strain(found, modulus, power, radii, beyond):
    """Measures at radii from the branches at equal strain; nan where there are too few around."""
    own = np.array([branch.radius_um for branch in found])
    states = [branch.at(modulus * (branch.radius_um / radii) ** power) for branch in found]
    value = {name: np.array([state[name] for state in states]) for name in MEASURES}
    value["deformation"] = np.log(value["deformation"])
    value["area_um2"] /= own[:, None] ** 2
    measures = {name: np.full(len(radii), np.nan) for name in MEASURES}
    for k, radius in enumerate(radii):
        chosen, weights = neighbours(own, radius, np.isfinite(value["deformation"][:, k]))
        if len(chosen) >= LEAST_RADII and own[chosen[0]] - beyond <= radius <= own[chosen[-1]] + beyond:
            for name in MEASURES:
                measures[name][k] = weights @ value[name][chosen, k]
    return measures | {"deformation": np.exp(measures["deformation"]), "area_um2": measures["area_um2"] * radii**2}


def neighbours(own, radius, usable):
    """The usable radii nearest to a place, and the weights of their values there."""
    chosen = np.flatnonzero(usable)
    chosen = np.sort(chosen[np.argsort(np.abs(own[chosen] - radius), kind="stable")[:NODES]])
    return chosen, weights_at(own[chosen], radius)


def end_between(found, last, modulus):
    """Radius and measures where the branches of two neighbours end just at the modulus; None if they do not."""
    if last + 1 >= len(found) or not (found[last].ended and found[last + 1].ended):
        return None
    here, there = found[last], found[last + 1]
    if not here.modulus[-1] < modulus < there.modulus[-1]:
        return None
    fraction = np.log(modulus / here.modulus[-1]) / np.log(there.modulus[-1] / here.modulus[-1])
    measures = {name: (1 - fraction) * here.measures[name][-1] + fraction * there.measures[name][-1] for name in MEASURES}
    return (1 - fraction) * here.radius_um + fraction * there.radius_um, measures


def analytical(laboratory, kind):
    """Lines of the analytical model, each up to the greatest radius for which it answers."""
    cells = [(modulus, radius) for modulus in kind.moduli for radius in ANALYTICAL_RADII_UM]
    with ThreadPoolExecutor(laboratory.processors) as pool:
        answers = dict(zip(cells, pool.map(lambda cell: analytical_cell(laboratory, kind, *cell), cells)))
    lines = []
    for modulus in kind.moduli:
        nodes = []
        for radius in ANALYTICAL_RADII_UM:
            if answers[modulus, radius] is None:
                break
            nodes.append((radius, answers[modulus, radius]))
        if len(nodes) >= LEAST_RADII:
            lines.append(line_through(modulus, nodes, np.linspace(nodes[0][0], nodes[-1][0], POINTS)))
    return lines


def analytical_cell(laboratory, kind, modulus, radius):
    """Measures of one cell, None where the model refuses."""
    case = kind.cell(round(float(radius), 6), modulus, "linear")
    ended = laboratory.call("analytic", "cell", *analytic_options(case), "--json")
    if ended.returncode != 0:
        return None
    try:
        answer = json.loads(ended.stdout)
        return {name: float(answer[name]) for name in MEASURES}
    except (json.JSONDecodeError, KeyError, TypeError, ValueError):
        return None


def line_through(modulus, nodes, radii):
    """A line at radii through nodes (radius, measures); the deformation, which spans decades, by its logarithm."""
    own = np.array([radius for radius, _ in nodes])
    values = {name: np.array([measures[name] for _, measures in nodes]) for name in MEASURES}
    dense = {name: smooth(own, values[name], radii) for name in MEASURES}
    return Line(modulus, radii, dense | {"deformation": np.exp(smooth(own, np.log(values["deformation"]), radii))}, False)


def smooth(own, values, places):
    """Values at places of the polynomials through the nodes around them."""
    everywhere = np.ones(len(own), dtype=bool)
    between = [neighbours(own, place, everywhere) for place in places]
    return np.array([weights @ values[chosen] for chosen, weights in between])


def weights_at(nodes, place):
    """Weights of the values at nodes in the polynomial through them, at a place."""
    return np.array([np.prod((place - np.delete(nodes, k)) / (node - np.delete(nodes, k)))
                     for k, node in enumerate(nodes)])


def relative_difference(line, reference, name="deformation"):
    """Areas within the paper's, and the relative difference of a line from another one there."""
    area = np.linspace(*paper.AREAS_UM2, POINTS)
    difference = line.at_area(area, name) / reference.at_area(area, name) - 1
    known = np.isfinite(difference)
    return area[known], difference[known]


def rows(kind, model, lines, names):
    """Lines of the table: measures at round areas, and where a line ends."""
    for line in lines:
        areas = [(float(area), "") for area in np.arange(paper.AREAS_UM2[0], paper.AREAS_UM2[1] + STEP_UM2 / 2, STEP_UM2)
                 if np.isfinite(line.at_area(area, "deformation"))]
        end = float(line["area_um2"][-1])
        if line.ended and end < paper.AREAS_UM2[1]:
            areas.append((end, "end of the smooth branch"))
        for area, note in areas:
            yield {"cell": kind.name, "model": model, "modulus": f"{line.modulus:g}", "unit": kind.unit,
                   "area_um2": f"{area:.2f}",
                   "radius_um": f"{np.interp(area, line['area_um2'], line.radius_um):.4f}",
                   **{name: f"{line.at_area(area, name):.7f}" for name in names}, "note": note}
