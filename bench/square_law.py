#!/usr/bin/env python3
"""What the square channel does to the shape of a cell of the tube: the law in src/infer/square_law.cc.

    bench/square_law.py FILE [--cells 400] [--workers 2]

Random neo-Hookean cells with bulk, cortex and a tension of the liquid are solved in the square channel, with liquids of
exponents from 0.5 to 1, and in the tube with the Newtonian liquid of the same viscosity at the wall, for which combined
tables are computed. FILE keeps what is solved, one line a cell; a second run goes on from there. A law is fitted to the
differences; prints its coefficients as they stand in the source, and what it leaves of cells that were left out.
"""
import argparse
import itertools
import json
import math
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
LEAST_MODE_3, GREATEST_MODE_3 = 0.006, 0.12
PATIENCE_S = 6  # of processor time; cells at the end of their branch take minutes


class Cell:
    """At random: radius over half the width, share of the cortex, its tension over its modulus, the liquid's over S, the
    liquid's exponent, and S over the stress at the wall."""

    def __init__(self, number):
        random = np.random.default_rng([12, number])
        self.radius = random.uniform(0.38, 0.84)
        self.share = random.choice([0, 1, random.uniform(0, 1)], p=[0.1, 0.1, 0.8])
        self.axial = random.choice([0, random.uniform(-0.06, 1)], p=[0.2, 0.8])
        # A cortex without tension, drawn out, wrinkles in the middle: combined tables begin at 0.11.
        self.tension = random.uniform(0.1 if self.axial else 0, 0.85)
        self.exponent = random.choice([1, random.uniform(0.5, 1)], p=[0.5, 0.5])
        self.stiffness = math.exp(random.uniform(math.log(1.2), math.log(20)))

    def case(self, section):
        stress = self.stiffness * WALL_STRESS_PA
        cortex_mN_per_m = self.share * stress * self.radius * WIDTH_UM / 2 * 1e-3
        flow = {"rate_ul_per_s": RATE_UL_S, "axial_tension_Pa": self.axial * stress}
        if section == "tube" or self.exponent == 1:
            flow["viscosity_mPas"] = VISCOSITY_MPAS
        else:
            shear_rate = 8 * RATE_UL_S / (1e-3 * WIDTH_UM) ** 3 * (0.6671 + 0.2121 / self.exponent)
            flow |= {"law": "power-law", "exponent": self.exponent,
                     "consistency_Pa_sn": 1e-3 * VISCOSITY_MPAS * shear_rate ** (1 - self.exponent)}
        cell = {"radius_um": self.radius * WIDTH_UM / 2, "bulk": {"law": "none"}}
        if self.share < 1:
            cell["bulk"] = {"law": "neo-hookean", "young_modulus_kPa": (1 - self.share) * stress * 1e-3}
        if self.share > 0:
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


def terms(numbers):
    """All products of up to two of the numbers: what square_terms of src/infer/square_law.cc gives."""
    columns = [np.ones(len(numbers))]
    for degree in (1, 2):
        columns += [numbers[:, list(which)].prod(axis=1)
                    for which in itertools.combinations_with_replacement(range(numbers.shape[1]), degree)]
    return np.stack(columns, axis=1)


def changes(found):
    """Of each cell the numbers of the law, and the changes of its features."""
    cells = [Cell(one["number"]) for one in found]
    tube, square = (np.array([one[section] for one in found]) for section in ("tube", "square"))
    change = square - tube
    change[:, 0] = np.log(square[:, 0] / tube[:, 0])
    radius = np.sqrt(square[:, 0] / math.pi) / (WIDTH_UM / 2)
    numbers = np.stack([radius, square[:, MODE_2], square[:, MODE_3], [c.share for c in cells],
                        [c.share * c.tension for c in cells], [1 - c.exponent for c in cells]], axis=1)
    return numbers, change


def report(found):
    """The law, over c3, and what it leaves of each cell when fitted to the others."""
    numbers, change = changes(found)
    mode_3 = numbers[:, 2]
    rows = terms(numbers) * mode_3[:, None]
    leverage = np.einsum("ij,ji->i", rows, np.linalg.pinv(rows))
    for name, wanted in zip(FEATURES, change.T):
        law = np.linalg.lstsq(rows, wanted, rcond=None)[0]
        left = (wanted - rows @ law) / (1 - leverage)
        rms = lambda values: np.sqrt(np.mean(values**2))
        print(f"// {name}: change {rms(wanted):.2g}; left {rms(left):.2g}, {np.quantile(abs(left), 0.95):.2g} (95 %)")
        print(f"{{{rms(left / mode_3):.2g}, {{" + ", ".join(f"{c:.4g}" for c in law) + "}},")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path)
    parser.add_argument("--cells", type=int, default=400)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    solve_cells(options.file, options.cells, options.workers)
    found = [json.loads(line) for line in options.file.read_text().splitlines()]
    found = [one for one in found if "square" in one]
    print(f"// {len(found)} of {options.cells} cells")
    report(found)


if __name__ == "__main__":
    main()
