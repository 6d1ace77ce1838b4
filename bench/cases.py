#!/usr/bin/env python3
"""Whole solves through the command line: time, size, iterations and honesty of the error estimate.

    bench/cases.py [--runs N] [--program build/rheocyte]

Prints a table in Markdown. Times are the program's own `wall_time_s` (start-up of the process excluded), medians over
N runs; `true error` is against a run at a thirtieth of the accuracy. The cases are those of docs/benchmarks.md.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
CASE = """[channel]
radius_um = 10.94
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
density_kg_per_m3 = 0
[cell]
radius_um = {radius}
[cell.bulk]
law = "{law}"
young_modulus_kPa = {modulus}
[numerics]
accuracy = {accuracy}
"""
CASES = ((6.0, "linear", 4.58, 1e-3), (6.0, "linear", 4.58, 1e-4), (6.0, "linear", 2.29, 6e-4),
         (6.0, "linear", 2.29, 7e-5), (6.0, "linear", 2.29, 1e-6), (7.66, "neo-hookean", 3.437, 1e-4),
         (8.75, "neo-hookean", 2.6, 1e-4), (9.6, "linear", 8.0, 1e-4), (1.1, "linear", 1.0, 1e-4))


def solve(program, radius, law, modulus, accuracy):
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder, "case.toml")
        case.write_text(CASE.format(radius=radius, law=law, modulus=modulus, accuracy=accuracy))
        done = subprocess.run([program, "solve", case, "-o", Path(folder, "result"), "--json", "--quiet",
                               "--no-picture"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{law}, {radius} um, {modulus} kPa: {done.stderr.strip()}")
        return json.loads(done.stdout)


def main():
    os.sched_setaffinity(0, [max(os.sched_getaffinity(0))])  # one processor, and so one thread
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--runs", type=int, default=5)
    arguments.add_argument("--program", default=str(TOP / "build" / "rheocyte"))
    options = arguments.parse_args()
    print("| r0 (um), law, E (kPa) | accuracy | d | estimated | true error | time (s) | unknowns | degree | iterations "
          "| factorisations | assembly | factorisation |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for radius, law, modulus, accuracy in CASES:
        exact = solve(options.program, radius, law, modulus, max(accuracy / 30, 1e-7))["deformation"]
        runs = [solve(options.program, radius, law, modulus, accuracy) for _ in range(options.runs)]
        result, work = runs[-1], runs[-1]["statistics"]
        time = statistics.median(run["wall_time_s"] for run in runs)
        fraction = {key: statistics.median(run["statistics"][key] / run["wall_time_s"] for run in runs)
                 for key in ("assembly_s", "factorisation_s")}
        print(f"| {radius}, {law}, {modulus} | {accuracy:.0e} | {result['deformation']:.8f} "
              f"| {result['estimated_error']:.1e} | {abs(result['deformation'] / exact - 1):.1e} | {time:.3f} "
              f"| {result['unknowns']} | {work['degree']} | {result['newton_iterations']} | {work['factorisations']} "
              f"| {fraction['assembly_s']:.0%} | {fraction['factorisation_s']:.0%} |")


if __name__ == "__main__":
    main()
