#!/usr/bin/env python3
"""The numbers of two builds of rheocyte over cases of all kinds, side by side.

    bench/compare_programs.py OLD NEW [--seed N] [--keep FOLDER]

OLD and NEW are programs. 60 cases: bulk solids, shells, combined cells, power-law liquids, runs in time and through an
entry, tables, and moduli of recordings. Prints a line for each case: the greatest difference of a number to what is allowed,
which is 1e-9 of the number or the sum of the errors that both programs state, whichever is greater. Exit code 1 if any
number differs by more.
"""
import argparse
import csv
import itertools
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

FLOW = "[channel]\nwidth_um = 20.0\n[flow]\nrate_ul_per_s = 0.04\n"
NEWTONIAN = FLOW + "viscosity_mPas = 15.0\n"
# What describes the computation and not the cell.
OF_THE_RUN = {"wall_time_s", "unknowns", "newton_iterations", "residual", "estimated_error", "reached", "message", "case",
              "statistics", "program", "version", "relative_volume_change", "simulated_length_um", "steps"}


def cell(draw, law, modulus, cortex="", radius=(3.5, 8.6)):
    bulk = f'[cell.bulk]\nlaw = "{law}"\n' + (f"young_modulus_kPa = {modulus}\n" if law != "none" else "")
    return f"[cell]\nradius_um = {draw.uniform(*radius):.4f}\n{bulk}{cortex}"


def cortex(draw, law, modulus, bending=""):
    return (f'[cell.cortex]\nlaw = "{law}"\nmodulus_mN_per_m = {modulus}\n'
            f"tension_ratio = {draw.uniform(0.08, 0.3):.3f}\n{bending}")


def solids(draw):
    for k in range(25):
        law = ("linear", "neo-hookean", "mooney-rivlin")[k % 3]
        density = "density_kg_per_m3 = 0\n" if k % 2 else ""
        yield f"solid {k + 1}, {law}", NEWTONIAN + density + cell(draw, law, round(draw.uniform(1.5, 9), 3))


def shells(draw):
    for k in range(10):
        law = ("linear", "neo-hookean")[k % 2]
        yield f"shell {k + 1}, {law}", NEWTONIAN + cell(draw, "none", 0, cortex(draw, law, round(draw.uniform(15, 60), 2)))


def combined(draw):
    for k in range(9):
        law = ("linear", "neo-hookean")[k % 2]
        bending = "bending_kBT = 4e4\n" if k % 3 == 0 else ""
        both = cortex(draw, law, round(draw.uniform(2, 12), 3), bending)
        yield f"combined {k + 1}, {law}", NEWTONIAN + cell(draw, law, round(draw.uniform(1.5, 4), 3), both)


def power_law(draw):
    for k in range(6):
        liquid = f'law = "power-law"\nconsistency_Pa_sn = {draw.uniform(0.2, 0.5):.3f}\nexponent = {draw.uniform(0.5, 0.9):.3f}\n'
        yield f"power law {k + 1}", FLOW + liquid + "density_kg_per_m3 = 0\n" + cell(
            draw, "neo-hookean", round(draw.uniform(1, 4), 3), radius=(4, 7.5)) + "[numerics]\naccuracy = 1e-3\n"


def viscous(cell_keys):
    return cell_keys.replace("[cell.bulk]", "viscosity_mPas = 15.0\n[cell.bulk]")


def in_time(draw):
    for k in range(3):
        shell = cortex(draw, "linear", 9.0) if k == 2 else ""
        yield f"time {k + 1}", NEWTONIAN + viscous(cell(draw, "neo-hookean", round(draw.uniform(2, 5), 3), shell, (5, 7.5))) + (
            "[time]\nend_us = 60\noutput_every_us = 30\n")
    for k in range(2):
        funnel = NEWTONIAN.replace("width_um = 20.0\n", "[channel.profile]\nx_um = [60.0, 100.0]\nR_um = [21.88, 10.94]\n")
        yield f"entry {k + 1}", funnel.replace("[channel]\n", "", 1) + viscous(cell(
            draw, "neo-hookean", round(draw.uniform(3, 6), 3), radius=(5, 7.5))) + "[time]\nend_us = 400\noutput_every_us = 100\n"


def with_inertia(draw):
    for k in range(2):
        flow = "[channel]\nwidth_um = 20.0\n[flow]\nrate_ul_per_s = 0.16\nviscosity_mPas = 4.0\ndensity_kg_per_m3 = 1000\n"
        yield f"inertia {k + 1}", flow + cell(draw, "neo-hookean", round(draw.uniform(4, 9), 3), radius=(5, 8))


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL)


def solve(program, text, folder):
    folder.mkdir(parents=True)
    (folder / "case.toml").write_text(text)
    done = run(program, "solve", folder / "case.toml", "-o", folder / "result", "--no-picture", "--quiet")
    result = folder / "result" / "result.json"
    return json.loads(result.read_text()) if result.exists() else {"status": f"refused, exit code {done.returncode}"}


def error_of(result):
    return (result.get("estimated_error") or 0) + (result.get("estimated_time_error") or 0)


def compare_states(name, text, programs, folder):
    old, new = (solve(p, text, folder / name.replace(" ", "_").replace(",", "") / w) for p, w in zip(programs, ("old", "new")))
    if old["status"] != new["status"]:
        return name, float("inf"), f'status {old["status"]} and {new["status"]}'
    if old["status"] != "converged":
        return name, 0.0, old["status"]
    # The error of the deformation is that of lengths in parts of the cell's radius, and so the relative one of all others.
    stated = error_of(old) + error_of(new)
    worst, which = 0.0, ""
    for key in old.keys() & new.keys() - OF_THE_RUN:
        a, b = old[key], new[key]
        if not isinstance(a, float) or not isinstance(b, float):
            continue
        part = abs(a - b) / max(1e-9 * abs(a), stated * max(1.0, abs(a)), 1e-300)
        if part > worst:
            worst, which = part, f"{key}: {a:.9g} and {b:.9g}"
    return name, worst, which


def make_table(program, folder):
    folder.mkdir(parents=True)
    spec = folder / "table.toml"
    # Keys by the names that both programs read.
    spec.write_text(NEWTONIAN + '[cell.bulk]\nlaw = "linear"\n[table]\nidentifier = "compared"\nleast_area_um2 = 50.0\n'
                    "greatest_area_um2 = 150.0\nleast_deformation = 1e-3\ngreatest_deformation = 0.06\nradii = 8\n"
                    "rows_per_radius = 60\naccuracy = 1e-4\n")
    made = run(program, "table", spec, "-o", folder / "table", "--quiet")
    if made.returncode:
        sys.exit(f"{program}: {made.stderr}")
    return folder / "table"


def moduli_of(program, recording, table, folder):
    done = run(program, "extract", recording, "-o", folder, "--table", table)
    if done.returncode:
        sys.exit(f"{program}: {done.stderr}")
    lines = (folder / f"{recording.stem}_rheocyte.tsv").read_text().splitlines()
    rows = list(csv.DictReader((line for line in lines if not line.startswith("# ")), delimiter="\t"))
    name = next(key for key in rows[0] if "young_modulus" in key)
    return [float(row[name]) for row in rows]


def compare_moduli(programs, tables, recording, allowed, name, folder):
    """Moduli of the events of a recording; `allowed` is relative."""
    moduli = [moduli_of(p, recording, t, folder / w) for p, t, w in zip(programs, tables, ("old", "new"))]
    both = [(a, b) for a, b in zip(*moduli) if a == a and b == b]
    apart = sum((a == a) != (b == b) for a, b in zip(*moduli))
    return name, max(abs(a - b) / abs(a) for a, b in both) / allowed, f"{len(both)} events, {apart} at the border of one table"


def compare_tables_and_moduli(programs, folder):
    """A table of each, read at the same cells; both must state the modulus within what two errors of 1e-4 in d mean."""
    tables = [make_table(p, folder / w) for p, w in zip(programs, ("old", "new"))]
    spec = folder / "cells.toml"
    spec.write_text('[recording]\ncells = 300\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nmedium = "CellCarrier"\n'
                    "temperature_C = 23\n[cell]\nradius_um = {mean = 5.3, sd = 0.3}\nyoung_modulus_kPa = {mean = 1.5, sd = 0.2}\n"
                    f'[shapes]\ntable = "{tables[0]}"\n')
    recording = folder / "cells.rtdc"
    made = run(programs[0], "synth", spec, "-o", recording)
    if made.returncode:
        sys.exit(made.stderr)
    yield compare_moduli(programs, tables, recording, 1e-3, "own table", folder / "own")
    yield compare_moduli(programs, ["LE-2D-26"] * 2, recording, 1e-9, "extract, LE-2D-26", folder / "shipped")
    text = tables[0] / "lut_compared.txt"
    yield compare_moduli(programs, [text] * 2, recording, 1e-9, "extract, a text table", folder / "text")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    programs = [str(Path(options.old).resolve()), str(Path(options.new).resolve())]
    draw = random.Random(options.seed)
    cases = [case for kind in (solids, shells, combined, power_law, in_time, with_inertia) for case in kind(draw)]
    parts = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or Path(scratch)
        states = (compare_states(name, text, programs, folder) for name, text in cases)
        for name, part, text in itertools.chain(states, compare_tables_and_moduli(programs, folder / "tables")):
            print(f"{name:26} {part:10.3g} {text}", flush=True)
            parts.append(part)
    within = sum(part <= 1 for part in parts)
    print(f"{within} of {len(parts)} within the allowed difference")
    sys.exit(within < len(parts))


if __name__ == "__main__":
    main()
