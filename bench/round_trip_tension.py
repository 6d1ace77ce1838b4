#!/usr/bin/env python3
"""How well the common axial tension of a recording comes back by `rheocyte moduli` from virtual cells with bulk and cortex.

    bench/round_trip_tension.py [--program build/rheocyte] [--spec SPEC.toml] [--recordings 20] [--cells 200] [--seed 1] [--folder DIR]

Each recording has medians at random: an axial tension of 80 to 400 Pa, E 0.25 to 0.9 kPa, E2D 1.2 to 3 mN/m, a tension of the
cortex of 0.2 to 0.45 E2D; r0 6.6 um +- 5 %, both moduli +- 20 %; 20 um, 0.04 ul/s, 6.3 mPa s, pixels of 0.34 um. Those of which
more than a tenth would be too soft for the table are left out. With --spec all are of one specification (`rheocyte synth`), with
seeds from --seed on. Prints the errors of the axial tension, of E + E2D/r0 and of its median over single cells, how many 90 %
intervals hold the truth, and the processor time.
"""
import argparse
import itertools
import json
import math
import random
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

SPEC = """[recording]
cells = {cells}
seed = {seed}
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 6.3
axial_tension_Pa = {{mean = {axial}}}
[cell]
kind = "combined"
radius_um = {{mean = 6.6, sd = 0.33}}
[cell.bulk]
young_modulus_kPa = {{mean = {young}, sd = {young_sd}}}
[cell.cortex]
modulus_mN_per_m = {{mean = {cortex}, sd = {cortex_sd}}}
tension_ratio = {{mean = {ratio}}}
"""


class Recording:
    """One that is drawn, and what the program says of it."""

    def __init__(self, spec, seed, arguments, folder):
        self.file, self.program = folder / "cells.rtdc", arguments.program
        self.file.unlink(missing_ok=True)
        call = [self.program, "synth", spec, "-o", self.file, "--quiet", "--set", f"recording.seed={seed}", "--set",
                f"recording.cells={arguments.cells}"]
        run = subprocess.run(call, capture_output=True, text=True, check=False)
        self.tension, self.truth = self.cells() if run.returncode == 0 else (math.nan, [])
        self.left_out = 1 - len(self.truth) / arguments.cells

    def cells(self):
        """Axial tension (Pa), and E + E2D / r0 (kPa) of each cell."""
        import h5py
        import hdf5plugin  # noqa: F401 (zstd)

        with h5py.File(self.file) as file:
            events = file["events"]
            return events["userdef0"][0], list(events["userdef2"][:] + events["userdef7"][:] / events["userdef1"][:])

    def found(self):
        """{name: (off in parts, whether the 90 % interval holds the truth)}; nothing without a tension."""
        folder = self.file.with_name("moduli")
        subprocess.run([self.program, "moduli", self.file, "-o", folder, "--quiet", "--jobs", "1"], check=True)
        told = json.loads((folder / "cells_moduli.json").read_text())
        lines = [line for line in (folder / "cells_moduli.tsv").read_text().splitlines() if not line.startswith("#")]
        column = lines[0].split("\t").index("stiffness_kPa")
        single = [float(line.split("\t")[column]) for line in lines[1:]]
        median = statistics.median(self.truth)
        if told["stiffness_median_kPa_low"] is None:
            return None

        def off(name, truth):
            return told[name] / truth - 1, told[name + "_low"] <= truth <= told[name + "_high"]

        return {"axial tension": off("axial_tension_Pa", self.tension), "E + E2D/r0": off("stiffness_median_kPa", median),
                "E + E2D/r0, median of single cells": (statistics.median(s for s in single if s == s) / median - 1, False)}


def specs(arguments, folder):
    """(specification, seed) of one recording after the other."""
    dice, spec = random.Random(arguments.seed), folder / "spec.toml"
    for seed in itertools.count(arguments.seed):
        if arguments.spec:
            yield arguments.spec, seed
            continue
        axial, young, cortex = dice.uniform(80, 400), dice.uniform(0.25, 0.9), dice.uniform(1.2, 3)
        seed = dice.randrange(10**6)
        spec.write_text(SPEC.format(cells=arguments.cells, seed=seed, axial=axial, young=young, young_sd=young / 5, cortex=cortex,
                                    cortex_sd=cortex / 5, ratio=dice.uniform(0.2, 0.45)))
        yield spec, seed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    parser.add_argument("--spec", type=Path)
    parser.add_argument("--recordings", type=int, default=20)
    parser.add_argument("--cells", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=Path)
    arguments = parser.parse_args()
    arguments.program = arguments.program.resolve()
    folder = arguments.folder or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    found = []
    for spec, seed in specs(arguments, folder):
        if len(found) == arguments.recordings:
            break
        recording = Recording(spec, seed, arguments, folder)
        if recording.left_out > 0.1:
            continue
        found.append(recording.found())
        print(f"{recording.tension:.0f} Pa, {statistics.median(recording.truth):.3f} kPa: "
              + (", ".join(f"{name} {100 * off:+.1f} %" for name, (off, _) in found[-1].items()) if found[-1] else "no tension is found"), flush=True)
    found = [answer for answer in found if answer]
    for name in found[0]:
        off = [100 * answer[name][0] for answer in found]
        print(f"{name}: {statistics.mean(off):+.1f} +- {statistics.stdev(off) / math.sqrt(len(off)):.1f} %, scatter {statistics.stdev(off):.1f} %, "
              f"in its 90 % interval {sum(answer[name][1] for answer in found)} of {len(found)}")
    print(f"processor time, with making the recordings: {resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime / len(found):.1f} s each")


if __name__ == "__main__":
    main()
