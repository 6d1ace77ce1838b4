#!/usr/bin/env python3
"""How well the common axial tension of a recording comes back by `rheocyte moduli` from virtual cells with bulk and cortex.

    bench/round_trip_tension.py [--program build/rheocyte] [--recordings 20] [--cells 200] [--seed 1] [--folder DIR]

Each recording has medians at random: an axial tension of 80 to 400 Pa, E 0.25 to 0.9 kPa, E2D 1.2 to 3 mN/m, a tension of the
cortex of 0.2 to 0.45 E2D; r0 6.6 um +- 5 %, both moduli +- 20 %; 20 um, 0.04 ul/s, 6.3 mPa s, pixels of 0.34 um. Those of which
more than a tenth would be too soft for the table are left out. Prints the errors of the axial tension, of the median of E +
E2D/r0, and how many 90 % intervals of the tension hold it.
"""
import argparse
import math
import random
import re
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

    def __init__(self, dice, arguments, folder):
        self.axial, young, cortex = dice.uniform(80, 400), dice.uniform(0.25, 0.9), dice.uniform(1.2, 3)
        self.file = folder / "cells.rtdc"
        spec = folder / "spec.toml"
        spec.write_text(SPEC.format(cells=arguments.cells, seed=dice.randrange(10**6), axial=self.axial, young=young, young_sd=young / 5,
                                    cortex=cortex, cortex_sd=cortex / 5, ratio=dice.uniform(0.2, 0.45)))
        self.file.unlink(missing_ok=True)
        self.program = arguments.program
        run = subprocess.run([self.program, "synth", spec, "-o", self.file, "--quiet"], capture_output=True, text=True, check=False)
        self.truth = self.stiffness_of_cells() if run.returncode == 0 else []
        self.left_out = 1 - len(self.truth) / arguments.cells

    def stiffness_of_cells(self):
        """E + E2D / r0 (kPa) of each cell."""
        import h5py
        import hdf5plugin  # noqa: F401 (zstd)

        with h5py.File(self.file) as file:
            events = file["events"]
            return list(events["userdef2"][:] + events["userdef7"][:] / events["userdef1"][:])

    def found(self):
        """Axial tension and its 90 % interval (Pa), median of E + E2D/r0 (kPa); nothing without a tension."""
        folder = self.file.with_name("moduli")
        subprocess.run([self.program, "moduli", self.file, "-o", folder, "--quiet"], check=True)
        (table,) = folder.glob("*_moduli.tsv")
        text = table.read_text()
        table.unlink()
        told = re.search(r"axial tension: (\S+) Pa \(90 % interval (\S+) to (\S+)\)", text)
        if not told:
            return None
        rows = [line.split("\t") for line in text.splitlines() if not line.startswith("#")]
        column = rows[0].index("stiffness_kPa")
        stiffness = [float(row[column]) for row in rows[1:] if row[column] != "nan"]
        return *map(float, told.groups()), statistics.median(stiffness)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    parser.add_argument("--recordings", type=int, default=20)
    parser.add_argument("--cells", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=Path)
    arguments = parser.parse_args()
    arguments.program = arguments.program.resolve()
    folder = arguments.folder or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    dice = random.Random(arguments.seed)
    tensions, stiffnesses, held, of = [], [], 0, 0
    while of < arguments.recordings:
        recording = Recording(dice, arguments, folder)
        if recording.left_out > 0.1:
            continue
        of += 1
        answer = recording.found()
        if answer is None:
            print(f"{recording.axial:.0f} Pa: no tension is found", flush=True)
            continue
        tension, lower, upper, stiffness = answer
        truth = statistics.median(recording.truth)
        tensions.append(100 * (tension / recording.axial - 1))
        stiffnesses.append(100 * (stiffness / truth - 1))
        held += lower <= recording.axial <= upper
        print(f"{recording.axial:.0f} Pa: {tension:.0f} ({lower:.0f} to {upper:.0f}), E + E2D/r0 {truth:.3f} kPa: {stiffness:.3f}", flush=True)
    for name, off in (("axial tension", tensions), ("E + E2D/r0", stiffnesses)):
        print(f"{name}: {statistics.mean(off):+.1f} +- {statistics.stdev(off) / math.sqrt(len(off)):.1f} %, scatter {statistics.stdev(off):.1f} %")
    print(f"axial tensions in their 90 % intervals: {held} of {len(tensions)}")


if __name__ == "__main__":
    main()
