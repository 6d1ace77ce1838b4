#!/usr/bin/env python3
"""Cells in the square channel by rheocyte and by a FreeFEM program, one after the other: error, processor time, memory.

    bench/peer/compare.py [--program build/rheocyte] [--edges 5 8] [--runs N] [--blas FOLDER]

Prints a table in Markdown. Processor times (user and system) and memory are those of whole processes with one thread, the
least of N runs; the programs take turns. The peer's mesh (duct_mesh.py, up to 0.6 s) is not counted. Errors are against
rheocyte at accuracy 1e-5, whose own estimate is printed. Each row of the peer is compared with rheocyte's cheapest run whose
error is no larger. `--blas` is a folder with the libblas.so.3 that FreeFEM shall use, for where the system's is a slow one.
"""
import argparse
import json
import os
import shutil
import sys
import tempfile
from functools import partial
from pathlib import Path

import duct_mesh

TOP = Path(__file__).resolve().parent.parent.parent
CELLS = ((6.0, 4.0), (7.0, 5.0), (6.0, 2.5))  # radius in um, Young's modulus in kPa
ACCURACIES = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4)
HALF_WIDTH_UM, STRESS_KPA = 10.0, 0.150  # 15 mPa s x (0.04 ul/s in 20 um x 20 um = 0.1 m/s) / 10 um
TOLERANCE = 1e-4
# Rings in the cell, layers of liquid and their growth, layers to each end, by edges to 45 degrees of the surface.
MESHES = {4: (2, 8, 1.2, 3), 5: (2, 8, 1.2, 3), 6: (2, 9, 1.1, 4), 7: (2, 10, 1.12, 4), 8: (2, 12, 1.15, 5), 10: (3, 14, 1.15, 6)}
CASE = """[channel]
section = "square"
width_um = 20.0
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
density_kg_per_m3 = 0.0
[cell]
radius_um = {radius}
[cell.bulk]
law = "neo-hookean"
young_modulus_kPa = {modulus}
[numerics]
accuracy = {accuracy}
"""


def run(command, environment):
    """Standard output, processor time in s and memory in GB of a process."""
    with tempfile.TemporaryFile("w+") as output:
        actions = [(os.POSIX_SPAWN_DUP2, output.fileno(), 1)]
        process = os.posix_spawn(command[0], [str(word) for word in command], environment, file_actions=actions)
        _, _, used = os.wait4(process, 0)
        output.seek(0)
        return output.read(), used.ru_utime + used.ru_stime, used.ru_maxrss / 2**20


def last_object(text, command):
    """The result in a program's output: JSON on its last line that begins one, or from there to the end of the object."""
    start = text.find("{\n") if "{\n" in text else text.rfind("{")
    if start < 0:
        sys.exit(f"{command[0]} gave no result: {text.strip()[-500:]}")
    return json.JSONDecoder().raw_decode(text[start:])[0]


def rheocyte(program, environment, radius, modulus, accuracy):
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder, "case.toml")
        case.write_text(CASE.format(radius=radius, modulus=modulus, accuracy=accuracy))
        command = [program, "solve", case, "-o", Path(folder, "result"), "--json", "--quiet", "--no-picture"]
        text, seconds, memory = run(command, environment)
        return last_object(text, command), seconds, memory


def peer(program, environment, radius, modulus, edges):
    rings, layers, growth, channel = MESHES[edges]
    r0 = radius / HALF_WIDTH_UM
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder, "duct")
        duct_mesh.write(duct_mesh.duct_mesh(r0, edges, rings, layers, growth, channel, 2.0), mesh.with_suffix(".mesh"))
        command = [program, "-nw", "-v", "0", TOP / "bench" / "peer" / "square_duct.edp", mesh, r0, modulus / 3 / STRESS_KPA,
                   TOLERANCE]
        text, seconds, memory = run(command, environment)
        return last_object(text, command), seconds, memory


def in_turns(runs, *tasks):
    """The result of each task and its least processor time and memory."""
    rounds = [[task() for task in tasks] for _ in range(runs)]
    return [(several[0][0], min(run[1] for run in several), min(run[2] for run in several)) for several in zip(*rounds)]


def compare(options, freefem, environments, radius, modulus):
    of_rheocyte, of_peer = environments
    reference = rheocyte(options.program, of_rheocyte, radius, modulus, 1e-5)[0]
    exact = reference["deformation_side"]
    name = f"{radius:g} um, {modulus:g} kPa"
    tasks = [partial(rheocyte, options.program, of_rheocyte, radius, modulus, accuracy) for accuracy in ACCURACIES]
    tasks += [partial(peer, freefem, of_peer, radius, modulus, edges) for edges in options.edges]
    runs = in_turns(options.runs, *tasks)
    ours = []
    for accuracy, (result, seconds, memory) in zip(ACCURACIES, runs):
        error = abs(result["deformation_side"] / exact - 1)
        ours.append((seconds, error))
        print(f"| {name} | rheocyte, {accuracy:.0e}, degree {result['statistics']['degree']} | {result['unknowns']} "
              f"| {result['deformation_side']:.7f} | {error:.1e} | {seconds:.2f} | {memory:.2f} | |", flush=True)
    for edges, (result, seconds, memory) in zip(options.edges, runs[len(ACCURACIES):]):
        error = abs(result["deformation"] / exact - 1)
        as_good = [time for time, other in ours if other <= error]
        ratio = f"{seconds / min(as_good):.1f}" if as_good else ""
        end = f"{result['iterations']} iterations" + ("" if result["converged"] else ", not converged")
        print(f"| {name} | FreeFEM, n = {edges}, {end} | {result['unknowns']} "
              f"| {result['deformation']:.7f} | {error:.1e} | {seconds:.2f} | {memory:.2f} | {ratio} |", flush=True)
    print(f"| {name} | reference | {reference['unknowns']} | {exact:.7f} | {reference['estimated_error']:.0e} (estimated) | | | |",
          flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(TOP / "build" / "rheocyte"))
    parser.add_argument("--edges", type=int, nargs="+", choices=sorted(MESHES), default=[5, 8])
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--blas", help="folder with the libblas.so.3 for FreeFEM")
    options = parser.parse_args()
    freefem = shutil.which("FreeFem++")
    if not freefem:
        sys.exit("FreeFem++ is missing; Debian and Ubuntu have it in the packages freefem++ and libfreefem++.")
    if not Path(options.program).exists():
        sys.exit(f"{options.program} is missing; build rheocyte or name its program with --program.")
    threads = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    # Debian's package looks for its modules in the folder of another version.
    of_peer = {"FF_LOADPATH": "/usr/lib/freefem++;;", **threads}
    if options.blas:
        of_peer["LD_LIBRARY_PATH"] = options.blas
    print("| cell | program | unknowns | d | error | processor time (s) | memory (GB) | ratio at equal error |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    for radius, modulus in CELLS:
        compare(options, freefem, (threads, of_peer), radius, modulus)


if __name__ == "__main__":
    main()
