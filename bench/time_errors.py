#!/usr/bin/env python3
"""How honest and how sharp the stated errors of runs in time are: random cells of tools/random_cases on their way in tubes
and contractions, each against the same run with steps a hundred times as accurate on a finer mesh.

    bench/time_errors.py [--program build/rheocyte] [--runs 40] [--seed 1] [--first 0] [--outputs 6] [--until T] [--rows FILE]

Every second run has the default accuracies. Judged are the numbers of the last state and of the way in result.json, and those
of all outputs. A number is off by its distance from the tight run, less what the tight run states of itself. Prints a row for each
number that is off by more than it states, and a summary; --rows keeps a line of JSON for each number. With --until 0.07 --outputs
100 it looks at the start-up, until that multiple of R/U.
"""
import argparse
import collections
import csv
import importlib.machinery
import importlib.util
import json
import math
import random
import statistics
import subprocess
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
ROUNDING = 3e-9  # and the tolerance of Newton's method, of a number
LIMIT_S = 600
FINER_STEPS, FINER_MESH, FINER_DEGREE = 100, 30, 3
LEAST_ACCURACY, LEAST_MESH_ACCURACY, GREATEST_DEGREE = 1e-9, 1e-6, 10


def random_cases():
    """The module that draws cases."""
    loader = importlib.machinery.SourceFileLoader("random_cases", str(TOP / "tools" / "random_cases"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("random_cases", loader))
    loader.exec_module(module)
    module.KINDS = {"in time": 1, "contraction": 1}
    return module


def solve(program, keys, folder):
    """result.json, outputs.csv and their errors; None where it did not converge."""
    path = Path(folder, "case.toml")
    path.write_text("".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items()))
    out = Path(folder, "result")
    try:
        done = subprocess.run([program, "solve", path, "-o", out, "--no-picture", "--quiet", "--no-output-fields"],
                              capture_output=True, text=True, timeout=LIMIT_S, check=False)
    except subprocess.TimeoutExpired:
        return None, "too slow"
    if done.returncode == 2:
        return None, "refused"
    result = json.loads((out / "result.json").read_text())
    if done.returncode != 0 and result["status"] != "accuracy-not-reached":
        return None, result["status"]
    result["outputs"], result["outputs_errors"] = (table(out / name) for name in ("outputs.csv", "outputs_errors.csv"))
    return result, result["status"]


def table(path):
    if not path.exists():
        return []
    with path.open() as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def tight(keys, result):
    """The case of the run to compare with, to the same end."""
    finer = dict(keys)
    finer["time.accuracy"] = max(keys.get("time.accuracy", 1e-5) / FINER_STEPS, LEAST_ACCURACY)
    if "time.degree" in keys:
        finer["time.degree"] = min(keys["time.degree"] + FINER_DEGREE, GREATEST_DEGREE)
    else:
        finer["time.mesh_accuracy"] = max(keys.get("time.mesh_accuracy", 1e-3) / FINER_MESH, LEAST_MESH_ACCURACY)
    if result["time"]["ended_by"] != "place":
        finer.pop("time.end_um", None)
        finer["time.end_us"] = result["time"]["t_us"]
    return finer


def compared(run, other):
    """(where, name, value, stated, off) of all numbers that have an error and are in both."""
    same_end = (math.isclose(run["time"]["t_us"], other["time"]["t_us"], rel_tol=1e-9)
                or run["time"]["ended_by"] == other["time"]["ended_by"] == "place")
    pairs = [("end", run, run["errors"], other, other["errors"])]
    if same_end:
        pairs.append(("way", run["time"], run["time"]["errors"], other["time"], other["time"]["errors"]))
    for row, errors in zip(run["outputs"], run["outputs_errors"]):
        for others, of_others in zip(other["outputs"], other["outputs_errors"]):
            if math.isclose(row["t_us"], others["t_us"], rel_tol=1e-9) and row["t_us"] > 0:
                pairs.append(("output", row, errors, others, of_others))
    for where, numbers, errors, others, of_others in pairs:
        for name, stated in errors.items():
            value, exact, left = numbers.get(name), others.get(name), of_others.get(name)
            if None in (value, exact, stated) or not all(map(math.isfinite, (value, exact, stated))):
                continue
            rounding = ROUNDING * max(abs(value), 1 if name.startswith(("mode", "deformation")) else 0)
            off = abs(value - exact) - min(left or 0, abs(value - exact) / 2) - rounding
            yield where, name, value, stated, max(off, 0.0), abs(value - exact), left


def draw(module, number, chosen, folder):
    for trial in range(100):
        case = module.RandomCase(random.Random(f"{chosen.seed}-{number}-{trial}"))
        keys = case.keys
        if number % 2:
            for key in ("time.accuracy", "time.mesh_accuracy", "time.degree"):
                keys.pop(key, None)
        if chosen.until:
            keys.pop("time.end_um", None)
            keys["time.end_us"] = chosen.until * case.time
        keys["time.output_every_us"] = keys.get("time.end_us", case.way / case.radius * case.time) / chosen.outputs
        path = Path(folder, "drawn.toml")
        path.write_text(case.toml())
        if subprocess.run([chosen.program, "solve", path, "--check"], capture_output=True, check=False).returncode == 0:
            return keys
    raise SystemExit(f"run {number}: no valid case in a hundred")


def summary(rows):
    lines = []
    by_name = collections.defaultdict(list)
    for row in rows:
        by_name[row["name"]].append(row)
    for name, those in sorted(by_name.items()):
        sharp = [row["stated"] / row["distance"] for row in those if row["distance"] > 0 and row["stated"] > 0]
        lines.append(f"{name:34} {len(those):5} {sum(r['off'] > r['stated'] for r in those):4} beyond "
                     f"{sum(r['off'] > 2 * r['stated'] for r in those):4} twice  stated over true, median "
                     f"{statistics.median(sharp) if sharp else math.nan:.2g}")
    for where in ("end", "way", "output"):
        those = [row for row in rows if row["where"] == where]
        lines.append(f"{where}: {len(those)} numbers, {sum(r['off'] > r['stated'] for r in those)} beyond the stated error, "
                     f"{sum(r['off'] > 2 * r['stated'] for r in those)} beyond twice")
    return "\n".join(lines)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--program", default=str(TOP / "build" / "rheocyte"))
    options.add_argument("--runs", type=int, default=40)
    options.add_argument("--first", type=int, default=0)
    options.add_argument("--seed", default="1")
    options.add_argument("--outputs", type=int, default=6)
    options.add_argument("--until", type=float)
    options.add_argument("--rows", type=Path)
    chosen = options.parse_args()
    module, rows, number, done = random_cases(), [], chosen.first, 0
    while done < chosen.runs:
        with tempfile.TemporaryDirectory() as folder:
            keys = draw(module, number, chosen, folder)
            run, why = solve(chosen.program, keys, folder)
            if run is not None and run["estimated_error"] is not None:
                other, why_other = solve(chosen.program, tight(keys, run), folder)
                why += f", tight: {why_other}"
                if other is not None:
                    done += 1
                    here = [dict(zip(("where", "name", "value", "stated", "off", "distance", "left"), row), run=number)
                            for row in compared(run, other)]
                    rows += here
                    why += (f"; {len(here)} numbers, {sum(r['off'] > r['stated'] for r in here)} beyond; {run['time']['ended_by']}, "
                            f"{run['wall_time_s']:.1f} s")
                    for row in here:
                        if row["off"] > row["stated"]:
                            print("   ", *(row[key] if isinstance(row[key], str) else f"{row[key]:.4g}"
                                           for key in ("where", "name", "value", "stated", "off", "distance") ))
                    if chosen.rows:
                        with chosen.rows.open("a") as file:
                            file.writelines(json.dumps(row) + "\n" for row in here)
            print(f"run {number}: {why}", flush=True)
        number += 1
    print(summary(rows))


if __name__ == "__main__":
    main()
