#!/usr/bin/env python3
"""Virtual experiments with cells that have a cortex: how well ratios of conditions come back, by outlines and without them.

    bench/cortex_experiments.py [--program build/rheocyte] [--experiments 60] [--cells 300]

Each experiment has two conditions of three recordings, 3 % between recordings; in every second one the cells of the second
condition are softer by a factor of 0.6 to 1, bulk and cortex alike. `rheocyte population` reads them with `--model cortex`
(outlines) and `--model effective` (area, deformation and inertia ratio). Prints for each quantity the bias of ln of the ratio
with its Monte Carlo error, how many 95 % intervals contain the true ratio, and how many experiments without a difference have
p < 0.05. The cells are those of the table, drawn with pixels: what is tested is the inference.
"""
import argparse
import math
import random
import tempfile
from pathlib import Path

from populations import Bench, mean_and_error

YOUNG_KPA, CORTEX_MN_PER_M, SPREAD, BETWEEN = 0.45, 3.0, 0.18, 0.03
SPEC = """[recording]
cells = {cells}
seed = {seed}
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 6
axial_tension_Pa = {{mean = 180}}
[cell]
kind = "combined"
radius_um = {{mean = 6.1, sd = 0.35}}
[cell.bulk]
young_modulus_kPa = {{mean = {young}, sd = {young_sd}, distribution = "lognormal"}}
[cell.cortex]
modulus_mN_per_m = {{mean = {cortex}, sd = {cortex_sd}, distribution = "lognormal"}}
tension_ratio = {{mean = 0.4, sd = 0.05}}
"""
MODELS = {"cortex": ("stiffness", "effective_modulus", "axial_tension"), "effective": ("effective_modulus", "axial_tension")}


class Cells:
    """What Bench.recording needs of a population."""

    @staticmethod
    def spec(cells, seed, factor):
        young, cortex = factor * YOUNG_KPA, factor * CORTEX_MN_PER_M
        return SPEC.format(cells=cells, seed=seed, young=young, young_sd=SPREAD * young, cortex=cortex,
                           cortex_sd=SPREAD * cortex)


def compared(bench, number, cells):
    """The true ratio, and {(model, quantity): the comparison}."""
    dice = random.Random(number)
    ratio = dice.uniform(0.6, 1) if number % 2 == 0 else 1.0
    files = [[bench.recording(Cells, cells, 10 * number + 3 * condition + session,
                              math.exp(dice.gauss(condition * math.log(ratio), BETWEEN))) for session in range(3)]
             for condition in range(2)]
    found = {}
    for model, quantities in MODELS.items():
        record = bench.population({"control": files[0], "drug": files[1]}, "--model", model, "--section", "tube")
        found |= {(model, each["quantity"]): each for each in record["comparisons"] if each["quantity"] in quantities}
    for file in (*files[0], *files[1]):
        file.unlink()
    return ratio, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/rheocyte")
    parser.add_argument("--experiments", type=int, default=60)
    parser.add_argument("--cells", type=int, default=300)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(arguments.program).resolve(), Path(folder))
        experiments = [compared(bench, number, arguments.cells) for number in range(arguments.experiments)]
    for model, quantities in MODELS.items():
        for quantity in quantities:
            truth_and_found = [(1.0 if quantity == "axial_tension" else ratio, found[model, quantity])
                               for ratio, found in experiments if (model, quantity) in found]
            mean, error = mean_and_error([math.log(each["ratio"] / truth) for truth, each in truth_and_found])
            inside = sum(each["ratio_low"] <= truth <= each["ratio_high"] for truth, each in truth_and_found)
            nulls = [each["p"] < 0.05 for truth, each in truth_and_found if truth == 1]
            print(f"{model}, {quantity}: bias {100 * mean:+.1f} +- {100 * error:.1f} %, {inside} of {len(truth_and_found)} "
                  f"intervals, p < 0.05 without a difference {sum(nulls)} of {len(nulls)}")


if __name__ == "__main__":
    main()
