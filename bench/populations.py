#!/usr/bin/env python3
"""How well `rheocyte population` finds populations that are known: virtual recordings, through pixels.

    bench/populations.py SCENARIO [--program build/rheocyte] [--recordings 40] [--cells 500] [--folder DIR]

usual       cells of d about 0.02          stiff       half of them look rounder than a sphere
gates       a gate on the area keeps half  elongated   under axial tensions that give c2 of about 0.1 and 0.2
outline-noise   as usual, outlines off by 0.1 um; with --outline-noise-um and without it; outline-noise-elongated
null        three pairs, 3 % between recordings: how often p < 0.05 (--recordings: of pairs of conditions)
speed       seconds and memory for 1e4 and 1e6 events, without pictures
peer        R's lme4 on the moduli of single events of the same recordings (bench/population_peer.R): three pairs, 3 % between
            recordings; size, power at 10 % and at equal size, bias, time (--recordings: of experiments with and without a
            difference; --rscript names the program)

Prints the bias of the mean of ln E and of its spread with their Monte Carlo errors, and how many 90 % intervals cover. Under
an axial tension the softest cells are drawn out further than the table goes and are not there, or are left out by what is
measured of them: the truth is then that of the cells that are fitted, of all recordings together (h5py and hdf5plugin).
"""
import argparse
import json
import math
import os
import random
import subprocess
import tempfile
import time
from pathlib import Path

SPEC = """[recording]
cells = {cells}
seed = {seed}
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
{tension}
[cell]
radius_um = {{mean = {radius}, sd = {radius_sd}, distribution = "lognormal"}}
[cell.bulk]
young_modulus_kPa = {{mean = {modulus}, sd = {modulus_sd}, distribution = "lognormal"}}
{shapes}
[noise]
contour_um = {outline_noise}
"""
ELONGATED = '[shapes]\ntable = "HE-3D-el-26"'
SPREAD = 0.2  # of E, relative
BETWEEN = 0.03  # standard deviation of ln E between recordings
NORMAL_90 = 1.6449


class Cells:
    """A population: mean radius and Young's modulus (of the lognormal law, its mean), and the liquid's tension."""

    def __init__(self, modulus, radius=6.0, tension=None, gate=(), outline_noise=0.0):
        self.modulus, self.radius, self.tension, self.gate = modulus, radius, tension, list(gate)
        self.outline_noise = outline_noise

    def spec(self, cells, seed, factor=1.0):
        modulus = self.modulus * factor
        tension = "" if self.tension is None else f"axial_tension_Pa = {{mean = {self.tension}, sd = {0.2 * self.tension}}}"
        return SPEC.format(cells=cells, seed=seed, tension=tension, radius=self.radius, radius_sd=0.07 * self.radius,
                           modulus=modulus, modulus_sd=SPREAD * modulus, shapes="" if self.tension is None else ELONGATED,
                           outline_noise=self.outline_noise)

    def truth(self):
        """Mean and standard deviation of ln E."""
        variance = math.log1p(SPREAD**2)
        return math.log(self.modulus) - variance / 2, math.sqrt(variance)


SCENARIOS = {
    "usual": Cells(4), "stiff": Cells(14, radius=5),
    "gates": Cells(6, gate=["--min", "area_um=109"]),
    "elongated": Cells(4.2, tension=500), "elongated-more": Cells(5.0, tension=1300),
    "outline-noise": Cells(4, outline_noise=0.1), "outline-noise-elongated": Cells(4.2, tension=500, outline_noise=0.1),
}


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def recording(self, cells, count, seed, factor=1.0):
        spec, file = self.folder / "cells.toml", self.folder / f"{seed}.rtdc"
        spec.write_text(cells.spec(count, seed, factor), encoding="utf-8")
        subprocess.run([self.program, "synth", spec, "-o", file, "--quiet", "--force"], check=True)
        return file

    def population(self, conditions, *options):
        named = [part for name, files in conditions.items() for part in ("--condition", f"{name}={','.join(map(str, files))}")]
        subprocess.run([self.program, "population", *named, "-o", self.folder / "result", "--quiet", "--no-picture", *options], check=True)
        return json.loads((self.folder / "result" / "population.json").read_text(encoding="utf-8"))


def mean_and_error(values):
    mean = sum(values) / len(values)
    variance = sum((value - mean) ** 2 for value in values) / max(len(values) - 1, 1)
    return mean, math.sqrt(variance / len(values))


def told(name, values, unit="%"):
    mean, error = mean_and_error(values)
    return f"{name} {100 * mean:+.2f} +- {100 * error:.2f} {unit}"


def covered(parameters, truth):
    """Whether the 90 % interval holds the truth; on ln s for spreads."""
    return abs(parameters["value"] - truth) < NORMAL_90 * parameters["value_error"]


def true_moduli(recording, events):
    """ln E of the cells of a virtual recording at these events, counted from 1."""
    import hdf5plugin  # noqa: F401, by which h5py reads them
    import h5py

    with h5py.File(recording) as file:
        place = next(name for name, meaning in file.attrs.items() if meaning == "true Young's modulus (kPa)")
        moduli = file["events"][place.removeprefix("user:rheocyte ")][:]
    return [math.log(moduli[event - 1]) for event in events]


def truth_of_fitted(bench, files):
    """Mean and standard deviation of ln E of the cells that were fitted, of all recordings together."""
    values = []
    for session, file in enumerate(files, 1):
        table = (bench.folder / "result" / f"events_all_{session}.tsv").read_text(encoding="utf-8").splitlines()
        values += true_moduli(file, [int(line.split("\t")[0]) for line in table[1:]])
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))


def coming_back(bench, cells, arguments):
    files = [bench.recording(cells, arguments.cells, seed) for seed in range(arguments.recordings)]
    if cells.outline_noise:
        tell_coming_back(bench, cells, files, f"{arguments.scenario}, --outline-noise-um {cells.outline_noise}",
                         "--outline-noise-um", str(cells.outline_noise))
    tell_coming_back(bench, cells, files, arguments.scenario)


def tell_coming_back(bench, cells, files, name, *options):
    record = bench.population({"all": files}, *cells.gate, *options)
    mean, spread = cells.truth() if cells.tension is None else truth_of_fitted(bench, files)
    found = [each["parameters"] for each in record["recordings"] if each["parameters"]]
    print(f"{name}: {len(found)} of {len(files)} recordings have a number; events fitted "
          f"{sum(each['events'] for each in record['recordings']) / len(files):.0f}")
    print(" ", told("ln E", [p[1]["value"] - mean for p in found]), "|",
          told("spread of ln E", [math.exp(p[3]["value"]) / spread - 1 for p in found]))
    known = [p for p in found if not p[3]["at_bound"]]
    print(f"  90 % intervals cover {100 * sum(covered(p[1], mean) for p in found) / len(found):.0f} % (ln E), "
          f"{100 * sum(covered(p[3], math.log(spread)) for p in known) / len(known):.0f} % (spread); standard error "
          f"{100 * sum(p[1]['value_error'] for p in found) / len(found):.2f} %")
    misfits = {}
    for each in record["recordings"]:
        for check in each["checks"]:
            misfits[check["measure"]] = misfits.get(check["measure"], 0) + (not check["fits"])
    print("  recordings that do not fit, by measure:", misfits)


def three_pairs(bench, arguments, experiment, difference=0.0):
    """Files of control and drug; the recordings scatter by 3 %, those of the drug are stiffer by the difference of ln E."""
    dice = random.Random(experiment)
    return [[bench.recording(SCENARIOS["usual"], arguments.cells, 1000 * experiment + 10 * session + condition,
                             math.exp(dice.gauss(condition * difference, BETWEEN))) for session in range(3)]
            for condition in range(2)]


def null(bench, arguments):
    rejected = 0
    for experiment in range(arguments.recordings):
        files = three_pairs(bench, arguments, experiment)
        record = bench.population({"control": files[0], "drug": files[1]}, "--paired")
        rejected += record["comparisons"][0]["p"] < 0.05
        for file in (*files[0], *files[1]):
            file.unlink()
    fraction = rejected / arguments.recordings
    print(f"null: p < 0.05 in {rejected} of {arguments.recordings} experiments, {100 * fraction:.1f} +- "
          f"{100 * math.sqrt(0.05 * 0.95 / arguments.recordings):.1f} %")


def speed(bench, arguments):
    for events in (10_000, 1_000_000):
        files = [bench.recording(SCENARIOS["elongated"], events // 2, seed) for seed in (1, 2)]
        start = time.monotonic()
        bench.population({"a": files[:1], "b": files[1:]})
        memory = resource_of_children()
        print(f"speed: {events} events in two conditions: {time.monotonic() - start:.1f} s with reading, at most {memory:.0f} MB")


def moduli_of_events(bench, file):
    """ln E of each event that `rheocyte extract` gives one by its asymmetry."""
    subprocess.run([bench.program, "extract", file, "-o", bench.folder / "extracted", "--quiet"], check=True)
    lines = [line for line in (bench.folder / "extracted" / f"{file.stem}_rheocyte.tsv").read_text().splitlines()
             if not line.startswith("# ")]
    heads = lines[0].removeprefix("#").strip().split("\t")
    place = heads.index("young_modulus_asymmetry_kPa")
    values = [float(line.split("\t")[place]) for line in lines[1:]]
    return [math.log(value) for value in values if math.isfinite(value) and value > 0]


def rejected_at_equal_size(nulls, others):
    """Fraction of p among the others below the p that 5 % of the nulls are below: power after the size is set to 5 %, which
    takes some hundred nulls; of fewer than 20 it is set to that of the least one."""
    limit = sorted(nulls)[max(int(0.05 * len(nulls)) - 1, 0)]
    return sum(p <= limit for p in others) / len(others)


def peer(bench, arguments):
    difference, ours, seconds = math.log(1.1), {}, 0.0
    table = bench.folder / "moduli.tsv"
    with open(table, "w", encoding="utf-8") as file:
        file.write("experiment\tcondition\tsession\tln_modulus\n")
        for experiment in range(2 * arguments.recordings):
            has_difference = experiment >= arguments.recordings
            files = three_pairs(bench, arguments, experiment, difference if has_difference else 0.0)
            start = time.monotonic()
            ours[experiment] = bench.population({"control": files[0], "drug": files[1]}, "--paired")
            seconds += time.monotonic() - start
            for condition, of in zip(("control", "drug"), files):
                for session, recording in enumerate(of):
                    for value in moduli_of_events(bench, recording):
                        file.write(f"{experiment}\t{condition}\t{session}\t{value:.6g}\n")
                    recording.unlink()
    told = subprocess.run([arguments.rscript, Path(__file__).with_name("population_peer.R"), table], check=True,
                          capture_output=True, text=True).stdout.splitlines()
    told = told[next(k for k, line in enumerate(told) if line.startswith("experiment\t")):]  # R may greet first
    rows = [dict(zip(told[0].split("\t"), map(float, line.split("\t")))) for line in told[1:]]
    theirs = {int(row["experiment"]): row for row in rows}
    found = {"rheocyte": ([each["comparisons"][0]["p"] for each in ours.values()],
                          [each["comparisons"][0]["ln_ratio"] for each in ours.values()], seconds)}
    for name, column in (("lme4, likelihood ratio", "p_ratio"), ("lme4, t", "p_t")):
        found[name] = ([theirs[k][column] for k in ours], [theirs[k]["difference"] for k in ours],
                       sum(row["seconds"] for row in rows))
    for name, (p, differences, took) in found.items():
        nulls, others = p[:arguments.recordings], p[arguments.recordings:]
        off = [value - difference for value in differences[arguments.recordings:]]
        print(f"{name}: p < 0.05 without a difference {100 * sum(x < 0.05 for x in nulls) / len(nulls):.0f} %, with it "
              f"{100 * sum(x < 0.05 for x in others) / len(others):.0f} %, at equal size "
              f"{100 * rejected_at_equal_size(nulls, others):.0f} %;", told_bias(off), f"; {took / len(p):.2f} s each")


def told_bias(off):
    mean, error = mean_and_error(off)
    return f"bias of ln ratio {100 * mean:+.2f} +- {100 * error:.2f} %"


def resource_of_children():
    import resource

    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenario", choices=[*SCENARIOS, "null", "speed", "peer"])
    parser.add_argument("--program", default="build/rheocyte")
    parser.add_argument("--recordings", type=int, default=40)
    parser.add_argument("--cells", type=int, default=500)
    parser.add_argument("--rscript", default="Rscript")
    parser.add_argument("--folder", help="for the recordings, which are removed in the end; default: that of temporary files")
    arguments = parser.parse_args()
    if arguments.folder:
        os.makedirs(arguments.folder, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
        bench = Bench(os.path.abspath(arguments.program), Path(folder))
        if arguments.scenario in SCENARIOS:
            coming_back(bench, SCENARIOS[arguments.scenario], arguments)
        else:
            {"null": null, "speed": speed, "peer": peer}[arguments.scenario](bench, arguments)


if __name__ == "__main__":
    main()
