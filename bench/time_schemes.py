#!/usr/bin/env python3
"""The same way of the paper's cell in implicit steps and in the splitting of Mokbel et al. 2017, and the stationary solver.

    bench/time_schemes.py [--program build/rheocyte] [--steps 20] [--full]

Prints one line of JSON for each run and the ratios of their times. Runs follow one after another on one processor; of
short ones the fastest of three counts. The splitting on the paper's grid (0.2 um, degree 2) takes half an hour: only --steps of its 2500 steps are made, between two
runs that differ by so many steps, and their time is scaled; --full makes all of them.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CASE = {"channel.radius_um": 10.94, "flow.rate_ul_per_s": 0.04, "flow.viscosity_mPas": 15.0, "cell.radius_um": 7.66,
        "cell.bulk.law": "linear", "cell.bulk.young_modulus_kPa": 3.437}
END_US, STEP_US = 500.0, 0.2
IN_TIME = {"cell.viscosity_mPas": 15.0, "time.output_every_us": END_US}


SHORT_S, REPEATS = 5.0, 3


def solve(program, name, case):
    """Wall time in s of the solver on a case, and its deformation over time."""
    seconds, history = solve_once(program, name, case)
    for _ in range(REPEATS - 1 if seconds < SHORT_S else 0):
        seconds = min(seconds, solve_once(program, name, case)[0])
    return seconds, history


def solve_once(program, name, case):
    """The same for one run."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        arguments = [f"--set={key}={value}" for key, value in (CASE | case).items()]
        file = Path(folder) / "case.toml"
        file.write_text("# all keys are settings\n[channel]\nradius_um = 10.94\n")
        start = time.monotonic()
        ended = subprocess.run([program, "solve", str(file), "-o", str(out), "--quiet", "--no-picture", *arguments],
                               check=False, capture_output=True, text=True)
        seconds = time.monotonic() - start
        if ended.returncode != 0:
            sys.exit(f"{name}: {ended.stderr.strip()}")
        result = json.loads((out / "result.json").read_text())
        history = []
        if (out / "history.csv").exists():
            rows = (out / "history.csv").read_text().splitlines()[1:]
            history = [tuple(map(float, row.split(",")[:2])) for row in rows]
    print(json.dumps({"run": name, "seconds": round(seconds, 3), "solver_seconds": round(result["wall_time_s"], 3),
                      "unknowns": result["unknowns"], "elements": result["statistics"]["elements"],
                      "degree": result["statistics"]["degree"], "steps": max(0, len(history) - 1),
                      "deformation": result["deformation"]}), flush=True)
    return result["wall_time_s"], history


def monolithic(accuracy):
    """Keys of implicit steps on the common mesh."""
    return IN_TIME | {"time.scheme": "monolithic", "time.accuracy": accuracy, "time.degree": 4, "time.end_us": END_US}


def partitioned(end_us, **more):
    """Keys of the splitting."""
    return IN_TIME | {"time.scheme": "partitioned", "time.step_us": STEP_US, "time.end_us": end_us,
                      "time.output_every_us": end_us} | {f"time.{key}": value for key, value in more.items()}


def interpolated(history, time_us, points=6):
    """Deformation at a time by the polynomial through the steps next to it: as smooth as the implicit steps are."""
    above = next((k for k, (t, _) in enumerate(history) if t >= time_us), len(history) - 1)
    first = min(max(above - points // 2, 0), len(history) - points)
    near = history[first:first + points]
    total = 0.0
    for i, (t, d) in enumerate(near):
        for j, (other, _) in enumerate(near):
            d *= 1 if i == j else (time_us - other) / (t - other)
        total += d
    return total


def difference(history, reference):
    """Greatest difference of d at the steps of one history from another one, relative to the end."""
    return max(abs(d - interpolated(reference, t)) for t, d in history) / reference[-1][1]


def paper_grid(program, steps, full):
    """Time in s of 500 us of the splitting on the paper's grid."""
    fine = {"grid_um": 0.2, "degree": 2}
    if full:
        return solve(program, "partitioned, paper's grid, all steps", partitioned(END_US, **fine))[0]
    few, many = (solve(program, f"partitioned, paper's grid, {n} steps", partitioned(n * STEP_US, **fine))[0]
                 for n in (2, 2 + steps))
    return (many - few) / steps * END_US / STEP_US


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/rheocyte")
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--full", action="store_true")
    arguments = parser.parse_args()
    program = arguments.program
    still, _ = solve(program, "stationary", {})
    _, reference = solve(program, "monolithic, 1e-6", monolithic(1e-6))
    implicit, coarse = solve(program, "monolithic, 1e-3", monolithic(1e-3))
    split, splitting = solve(program, "partitioned, same mesh", partitioned(END_US, degree=4))
    paper = paper_grid(program, arguments.steps, arguments.full)
    print(json.dumps({"partitioned_over_monolithic": round(split / implicit, 1),
                      "partitioned_over_stationary": round(split / still, 1),
                      "partitioned_on_papers_grid_s": round(paper, 1),
                      "papers_grid_over_monolithic": round(paper / implicit, 1),
                      "papers_grid_over_stationary": round(paper / still, 1),
                      "error_of_monolithic": round(difference(coarse, reference), 5),
                      "error_of_partitioned": round(difference(splitting, reference), 5)}))


if __name__ == "__main__":
    main()
