#!/usr/bin/env python3
"""How the shape of a cell in the square channel differs from that of the cell of the combined table: square_law.h.

    studies/square_law.py FILE [--cells 2900] [--workers 2] [--law src/infer/square_changes.h]

Random neo-Hookean cells with bulk, cortex and a tension of the liquid are solved in the square channel, with liquids of
exponents from 0.5 to 1 and the bending stiffness of a thin cortex, and in the tube with the Newtonian liquid of the same
viscosity at the wall and the bending stiffness of the table. FILE keeps what is solved, one line a cell; a second run goes
on from there. A law is fitted to how the cells in the square differ from those of the table, which differ from those in
the tube by what it leaves between its branches. Prints what the law leaves of cells that were left out of the fit.
"""
import argparse
import itertools
import json
import math
import subprocess
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import rheocyte

WIDTH_UM, RATE_UL_S, VISCOSITY_MPAS = 20.0, 0.04, 6.0
WALL_STRESS_PA = 228.0  # of the tube; any number near it would do
# In the tube that of examples/tables/combined-elongated.toml, which keeps the cortex of its cells smooth; in the square that
# of a cortex of 0.2 um, E2D h^2 / 9.
BENDING_KBT = {"tube": 3e4, "square": 2e3}
FEATURES = ["area_um2", "deformation", "moment_ratio"] + [f"mode_{k}" for k in range(2, 8)]
MODE_2, MODE_3 = FEATURES.index("mode_2"), FEATURES.index("mode_3")
# Of the numbers of the law.
RANGES = np.array([[0.40, 0.82], [-0.06, 0.42], [0, 0.12], [0, 1], [0, 0.85], [0, 0.5]])
LEAST_MODE_3, GREATEST_MODE_3 = 0.006, 0.12
STIFF_CELLS, ALL_CELLS = 874, 1601  # the others are as those of real recordings
MORE_ELONGATED_FROM = 2124          # the rest are, too, under greater axial tensions
GREATEST_TENSION = 0.85             # of the cortex over its modulus, in the table; cells beyond it do not count
PATIENCE_S = 6  # of processor time; cells at the end of their branch take minutes


class Cell:
    """At random: radius over half the width, fraction of the cortex, its tension over its modulus, the liquid's over S, the
    liquid's exponent, and S over the stress at the wall."""

    def __init__(self, number):
        random = np.random.default_rng([13, number])
        self.radius = random.uniform(0.40, 0.80)
        self.fraction = random.choice([0, random.uniform(0, 0.75), random.uniform(0.75, 1)], p=[0.08, 0.8, 0.12])
        self.axial = random.choice([0, random.uniform(-0.06, 1)], p=[0.15, 0.85])
        # A cortex without tension, drawn out, wrinkles in the middle: combined tables begin at 0.11.
        self.tension = random.uniform(0.1, 0.85)
        if self.axial == 0 and random.uniform() < 0.3:
            self.tension = random.uniform(0, 0.1)
        self.exponent = random.choice([1, random.uniform(0.5, 1)], p=[0.5, 0.5])
        self.stiffness = math.exp(random.uniform(math.log(1.2), math.log(20)))
        if number >= STIFF_CELLS:  # c3 is then evenly distributed
            self.stiffness = 1 / random.uniform(1 / 6, 1 / 1.4)
        if number >= ALL_CELLS:
            self.radius, self.fraction, self.axial = random.uniform(0.55, 0.72), random.uniform(0.2, 0.75), random.uniform(0.1, 0.8)
            self.tension, self.exponent = random.uniform(0.2, 0.85), random.choice([1, random.uniform(0.55, 0.75)], p=[0.2, 0.8])
            self.stiffness = random.uniform(1.5, 4)
        if number >= MORE_ELONGATED_FROM:
            self.radius, self.fraction, self.axial = random.uniform(0.5, 0.76), random.uniform(0.15, 0.75), random.uniform(0, 1.4)
            self.tension, self.stiffness = random.uniform(0.5, 1.6), random.uniform(0.5, 3)

    def case(self, section):
        stress = self.stiffness * WALL_STRESS_PA
        cortex_mN_per_m = self.fraction * stress * self.radius * WIDTH_UM / 2 * 1e-3
        flow = {"rate_ul_per_s": RATE_UL_S, "axial_tension_Pa": self.axial * stress}
        if section == "tube" or self.exponent == 1:
            flow["viscosity_mPas"] = VISCOSITY_MPAS
        else:
            shear_rate = 8 * RATE_UL_S / (1e-3 * WIDTH_UM) ** 3 * (0.6671 + 0.2121 / self.exponent)
            flow |= {"law": "power-law", "exponent": self.exponent,
                     "consistency_Pa_sn": 1e-3 * VISCOSITY_MPAS * shear_rate ** (1 - self.exponent)}
        cell = {"radius_um": self.radius * WIDTH_UM / 2, "bulk": {"law": "none"}}
        if self.fraction < 1:
            cell["bulk"] = {"law": "neo-hookean", "young_modulus_kPa": (1 - self.fraction) * stress * 1e-3}
        if self.fraction > 0:
            cell["cortex"] = {"law": "neo-hookean-reference", "modulus_mN_per_m": cortex_mN_per_m,
                              "tension_mN_per_m": self.tension * cortex_mN_per_m, "bending_kBT": BENDING_KBT[section]}
        return {"channel": {"section": section, "width_um": WIDTH_UM}, "flow": flow, "cell": cell,
                "numerics": {"accuracy": 2e-3 if section == "tube" else 4e-3}}


class TooSlow(Exception):
    pass


def solved(number):
    """Features in both sections, or why there are none."""
    cell, found, end = Cell(number), {"number": number}, time.process_time() + PATIENCE_S

    def goes_on(_):
        if time.process_time() > end:
            raise TooSlow

    for section in ("tube", "square"):
        try:
            state = rheocyte.solve(cell.case(section), progress=goes_on).to_dict()
        except TooSlow:
            return found | {"reason": f"{section}: over {PATIENCE_S} s"}
        except rheocyte.UserError as error:
            return found | {"reason": str(error)}
        if state["status"] != "converged" or not LEAST_MODE_3 < state["mode_3"] < GREATEST_MODE_3:
            return found | {"reason": f"{section}: {state['status']}, c3 {state['mode_3']:.3g}"}
        found[section] = [state[name] for name in FEATURES]
    return found


def solve_cells(file, cells, workers):
    known = {json.loads(line)["number"] for line in file.read_text().splitlines()} if file.exists() else set()
    with ProcessPoolExecutor(workers) as pool, file.open("a") as out:
        for found in pool.map(solved, [n for n in range(cells) if n not in known]):
            out.write(json.dumps(found) + "\n")
            out.flush()


def in_table(found, options):
    """Features of the cells by the table; of those outside it by the tube."""
    def line(cell):
        young = (1 - cell.fraction) * cell.stiffness * WALL_STRESS_PA * 1e-3
        radius_um = cell.radius * WIDTH_UM / 2
        cortex = cell.fraction * cell.stiffness * WALL_STRESS_PA * 1e-3 * radius_um
        return f"{radius_um} {young} {cortex} {cell.tension} {cell.axial * cell.stiffness * WALL_STRESS_PA}"

    lines = "\n".join(line(Cell(one["number"])) for one in found)
    told = subprocess.run([options.states, options.table], input=lines, text=True, capture_output=True, check=True).stdout
    features = np.array([one["tube"] for one in found])
    features[:, 0] = np.log(features[:, 0])
    is_inside = np.zeros(len(found), bool)
    for i, state in enumerate(told.splitlines()):
        if state != "none":
            features[i], is_inside[i] = [float(x) for x in state.split()], True
    return features, is_inside


def changes(found, options):
    """Of each cell the numbers of the law, and the changes of its features."""
    cells = [Cell(one["number"]) for one in found]
    square = np.array([one["square"] for one in found])
    radius = np.sqrt(square[:, 0] / math.pi) / (WIDTH_UM / 2)
    square[:, 0] = np.log(square[:, 0])
    numbers = np.stack([radius, square[:, MODE_2], square[:, MODE_3], [c.fraction for c in cells],
                        [c.fraction * c.tension for c in cells], [1 - c.exponent for c in cells]], axis=1)
    features, is_inside = in_table(found, options)
    return numbers, square - features, is_inside


def terms(numbers):
    """All products of up to three of the numbers, from -1 to 1 in their ranges: square_terms of src/infer/square_law.cc."""
    places = (numbers - RANGES[:, 0]) / (RANGES[:, 1] - RANGES[:, 0]) * 2 - 1
    columns = [np.ones(len(places))]
    for degree in (1, 2, 3):
        columns += [places[:, list(which)].prod(axis=1)
                    for which in itertools.combinations_with_replacement(range(places.shape[1]), degree)]
    return np.stack(columns, axis=1)


class Law:
    """Of one feature, over c3: least squares, in which cells that are far off count less (Huber 1964), and coefficients that
    few cells determine are small."""

    def __init__(self, numbers, wanted, ridge=0.02):
        rows, wanted = terms(numbers), wanted / numbers[:, 2]
        small = ridge * np.eye(rows.shape[1])
        weights = numbers[:, 2]  # between an error that goes with c3 and one that does not
        for _ in range(10):
            self.coefficients = np.linalg.solve(rows.T * weights @ rows + small, rows.T * weights @ wanted)
            off = abs(wanted - rows @ self.coefficients) * np.sqrt(numbers[:, 2])
            weights = numbers[:, 2] * np.minimum(1, 3 * np.median(off) / 0.6745 / np.maximum(off, 1e-12))

    def at(self, numbers):
        return terms(numbers) @ self.coefficients * numbers[:, 2]


def left_out(numbers, changes, parts=10):
    """What the laws leave of cells that were left out of the fit, a tenth at a time."""
    part = np.arange(len(numbers)) % parts
    left = np.empty_like(changes)
    for p in range(parts):
        for feature in range(len(FEATURES)):
            law = Law(numbers[part != p], changes[part != p, feature])
            left[part == p, feature] = changes[part == p, feature] - law.at(numbers[part == p])
    return left


def numbers_of(values, digits=4):
    return ", ".join(f"{value:.{digits}g}" for value in values)


def report(found, options):
    numbers, change, is_inside = changes(found, options)
    print(f"// {len(found)} cells, {is_inside.sum()} of them in the table")
    left = left_out(numbers, change)
    rms = lambda values: np.sqrt(np.mean(values**2, axis=0))
    for name, wanted, lacks in zip(FEATURES, change[is_inside].T, left[is_inside].T):
        print(f"// {name}: change {rms(wanted):.2g}; left {rms(lacks):.2g}, median {np.median(abs(lacks)):.2g}, "
              f"{np.quantile(abs(lacks), 0.95):.2g} (95 %)")
    over_mode_3 = left[is_inside] / numbers[is_inside, 2:3]
    spread = np.quantile(abs(over_mode_3), 0.9, axis=0) / 1.645  # so that 90 % intervals hold
    print("// left, over c3:", numbers_of(spread, 2))
    print_common(numbers[is_inside], np.clip(over_mode_3 / spread, -3, 3))
    if options.law:
        write_law(options.law, numbers, change, spread, np.corrcoef(np.clip(over_mode_3 / spread, -3, 3).T))


def print_common(numbers, left):
    """Correlation of what is left of two soft cells, by their distance in spreads of a population."""
    soft = numbers[:, 2] > 0.05
    places, left = numbers[soft] / [0.04, 0.03, 0.012, 0.08, 0.05, 0.08], left[soft]
    squared = sum((x[:, None] - x) ** 2 for x in places.T)
    for least, most in ((0, 2), (2, 4), (4, 6)):
        i, k = np.where((squared > max(least**2, 1e-9)) & (squared < most**2))
        in_common = (left[i] * left[k]).mean(axis=0) / (left**2).mean(axis=0)
        print(f"// correlation of two cells {least} to {most} spreads apart ({len(i)} pairs): {numbers_of(in_common, 2)}")


def array_of(name, rows):
    parts = [f"{name}_of_{feature}" for feature in FEATURES]
    lines = [f"inline constexpr std::array<double, {len(row)}> {part}{{{numbers_of(row)}}};" for part, row in zip(parts, rows)]
    return [*lines, f"inline constexpr std::array {name}{{{', '.join(parts)}}};", ""]


def write_law(file, numbers, change, spread, correlation):
    laws = [Law(numbers, wanted).coefficients for wanted in change.T]
    file.write_text("\n".join([
        "// Made by studies/square_law.py from cells that it has solved, for square_law.cc alone.", "#pragma once",
        "#include <array>", "", "namespace rheocyte {", "",
        "/// A feature's change is c_3 times a sum of terms.", *array_of("square_changes", laws),
        "/// Standard deviation of what the sums leave, over c_3, and its correlations.",
        f"inline constexpr std::array<double, {len(spread)}> square_left{{{numbers_of(spread)}}};",
        *array_of("square_correlations", correlation), "}  // namespace rheocyte", ""]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path)
    parser.add_argument("--cells", type=int, default=2900)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--table", required=True, help="combined_*.cbor of examples/tables/combined-elongated.toml with "
                        "--set cell.cortex.law=neo-hookean-reference --set table.max_deformation=0.08 --set table.accuracy=2e-3")
    parser.add_argument("--states", default="build/combined_states")
    parser.add_argument("--law", type=Path, help="the header to write")
    options = parser.parse_args()
    solve_cells(options.file, options.cells, options.workers)
    found = [json.loads(line) for line in options.file.read_text().splitlines()]
    found = [one for one in found if "square" in one and Cell(one["number"]).tension <= GREATEST_TENSION]
    report(found, options)


if __name__ == "__main__":
    main()
