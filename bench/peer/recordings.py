#!/usr/bin/env python3
"""Recordings by rheocyte, dclab and dcnum in one run: moduli from file to file and in memory, features from masks.

    bench/peer/recordings.py [--program build/rheocyte] [--bench build/bench_extract] [--events N] [--masks N] [--runs N]

Needs dclab and dcnum (`pip install dclab dcnum`) in the Python that runs it. Prints tables in Markdown. The programs take
turns, one thread each; of the processor times (user and system, with all children) and of the wall times the least counts.
What is compared:

* Moduli from file to file, whole processes with start and imports. The recording has area_um, deform and temp of each event,
  a made-up population. rheocyte writes its companion without the table of events: modulus, standard error, state and a basin.
  dclab writes emodulus and a basin, or emodulus and copies of the three features. With a published table both must agree.
* Moduli in memory: dclab's get_emodulus against the same function of rheocyte, by bench_extract. Both include the viscosity
  at each event's temperature and the correction for pixelation. get_emodulus reads and triangulates the table in every call,
  bench_extract once: both parts are also measured alone.
* Features from stored masks, from file to file. `rheocyte features` computes 25 features. dcnum has no command for this: its
  moments_based_features (18 features) and volume_from_contours stand between its reader and its writer, in one process.
  dclab exports the features that it can derive from masks: volume, tilt and inertia ratios, for every tenth mask of the
  recording only. What several programs compute must agree.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[threads] = "1"

import dclab  # noqa: E402
import dcnum  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
from dclab.features import emodulus  # noqa: E402

TOP = Path(__file__).resolve().parent.parent.parent
PIXEL_UM, WIDTH_UM, RATE_UL_S, MEDIUM, MODEL = 0.34, 20.0, 0.04, "CellCarrier", "buyukurganci-2022"
PUBLISHED = ("HE-3D-FEM-22", "LE-2D-FEM-19", "HE-2D-FEM-22")
MASKS_PER_READ, MILLION = 1000, 1_000_000
MODULI_BY_DCLAB = f"""
import sys
import dclab
source, target, table, features, basins = sys.argv[1:]
with dclab.new_dataset(source) as dataset:
    dataset.config["calculation"].update({{"emodulus lut": table, "emodulus medium": "{MEDIUM}",
                                          "emodulus viscosity model": "{MODEL}"}})
    dataset.export.hdf5(target, features=features.split(), filtered=False, basins=basins == "basins", override=True)
"""
FEATURES_BY_DCLAB = """
import sys
import dclab
source, target = sys.argv[1:]
with dclab.new_dataset(source) as dataset:
    dataset.export.hdf5(target, features=["inert_ratio_cvx", "inert_ratio_prnc", "inert_ratio_raw", "tilt", "volume"],
                        filtered=False, basins=True, override=True)
"""
FEATURES_BY_DCNUM = """
import sys
from dcnum.feat import feat_contour
from dcnum.read import HDF5Data
from dcnum.write import HDF5Writer
source, target, masks_per_read = sys.argv[1:]
with HDF5Data(source, image_chunk_size=int(masks_per_read)) as recording, HDF5Writer(target, mode="w") as writer:
    masks = recording.mask
    for index in masks.iter_chunks():
        features = feat_contour.moments_based_features(masks.get_chunk(index), recording.pixel_size, ret_contour=True)
        features.update(feat_contour.volume_from_contours(features.pop("contour"), features["pos_x"], features["pos_y"],
                                                          recording.pixel_size))
        features.pop("valid")
        for name, column in features.items():
            writer.store_feature_chunk(name, column)
"""


def python(code, *words):
    return [sys.executable, "-W", "ignore", "-c", code, *map(str, words)]


def times(command):
    """Processor and wall time (s) of a process with its children."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, wall


def in_turns(runs, commands):
    """The least processor and wall time of each command."""
    rounds = [[times(command) for command in commands] for _ in range(runs)]
    return [tuple(map(min, zip(*of_one))) for of_one in zip(*rounds)]


def columns_of(file, *names):
    with h5py.File(file) as recording:
        return [recording["events"][name][:].astype(float) for name in names]


def difference(ours, theirs):
    """The greatest difference of two columns, relative to the value or, where that is greater, to the median; they lack the
    same events.
    """
    lacking = np.isnan(ours) | np.isnan(theirs)
    if (np.isnan(ours) != np.isnan(theirs)).any():
        sys.exit(f"{(np.isnan(ours) != np.isnan(theirs)).sum()} events have a value from one program only.")
    ours, theirs = ours[~lacking], theirs[~lacking]
    greatest = (abs(ours - theirs) / np.maximum(abs(theirs), np.median(abs(theirs)))).max()
    if greatest > 1e-5:
        sys.exit(f"The programs differ by {greatest:.1g}.")
    return greatest


def population(count):
    """Area, deformation and temperature of cells."""
    random = np.random.default_rng(2)
    return random.normal(80, 12, count), random.lognormal(np.log(0.035), 0.4, count), random.normal(23, 0.2, count)


def write_events(path, count):
    with dclab.RTDCWriter(path) as writer:
        writer.store_metadata({
            "experiment": {"date": "2026-01-01", "event count": count, "run index": 1, "sample": "made up", "time": "12:00:00"},
            "imaging": {"pixel size": PIXEL_UM},
            "setup": {"channel width": WIDTH_UM, "chip region": "channel", "flow rate": RATE_UL_S, "medium": MEDIUM}})
        for name, column in zip(("area_um", "deform", "temp"), population(count)):
            writer.store_feature(name, column.astype(np.float32))


def write_masks(program, path, few, count):
    """A virtual recording of which only masks and places are left, and one with every tenth of its events. Returns how many
    they have, and of how many masks dcnum shall read at once: whole chunks of the file.
    """
    whole, spec = path.with_suffix(".whole.rtdc"), path.with_suffix(".toml")
    spec.write_text(f"""recording = {{cells = {count}, seed = 3}}
channel.width_um = {WIDTH_UM}
flow = {{rate_ul_per_s = {RATE_UL_S}, medium = "{MEDIUM}"}}
cell.radius_um = {{mean = 6.2, sd = 0.5}}
cell.bulk.young_modulus_kPa = {{mean = 2.5, sd = 0.5, distribution = "lognormal"}}
""")
    subprocess.run([program, "synth", spec, "-o", whole, "--quiet"], check=True)
    with h5py.File(whole) as source, h5py.File(path, "w") as all_masks, h5py.File(few, "w") as some:
        for target in (all_masks, some):
            target.attrs.update(source.attrs)
            target.create_group("events")
        for name in ("mask", "pos_x", "pos_y"):
            column = source["events"][name]
            source.copy(column, all_masks["events"], name)
            kept = len(column) // 10
            chunks = (min(kept, column.chunks[0]), *column.chunks[1:])
            some["events"].create_dataset(name, data=column[:10 * kept:10], chunks=chunks, compression=32015,
                                          compression_opts=(5,), fletcher32=True)
        some.attrs["experiment:event count"] = kept
        per_chunk = source["events/mask"].chunks[0]
        return len(source["events/mask"]), kept, max(1, MASKS_PER_READ // per_chunk) * per_chunk


def show(what, ours, theirs, count):
    """A row of a table; ours and theirs are (processor time, wall time)."""
    million = [f"{count / used[0] / 1e6:.3g}" for used in (ours, theirs)]
    print(f"| {what} | {ours[0]:.3f}, {ours[1]:.3f} | {theirs[0]:.3f}, {theirs[1]:.3f} | {million[0]}, {million[1]} "
          f"| {theirs[0] / ours[0]:.1f} |", flush=True)


def head(*names):
    print("\n| " + " | ".join(names) + " |\n" + "|---" * len(names) + "|", flush=True)


def compare_starts(options):
    commands = [[options.program, "--version"], python("pass"), python("import dclab"),
                python("from dcnum.feat.feat_contour import moments\nimport dcnum.read, dcnum.write\nmoments.cv2.moments")]
    head("start", "processor time (s)", "wall time (s)")
    starts = in_turns(options.runs, commands)
    for what, used in zip(("rheocyte --version", "Python", "Python, import dclab", "Python, imports of dcnum"), starts):
        print(f"| {what} | {used[0]:.3f} | {used[1]:.3f} |", flush=True)
    return starts[2]


def compare_moduli_of_files(options, folder, imports):
    recording, count = folder / "events.rtdc", options.events
    write_events(recording, count)
    extract = [options.program, "extract", recording, "--quiet", "-o"]

    def text(table):
        return Path(emodulus.__file__).parent / f"lut_{table}.txt"

    def by_dclab(table, features="emodulus", basins="basins"):
        return python(MODULI_BY_DCLAB, recording, folder / f"{table}-{basins}.rtdc", table, features, basins)

    commands = {"own": [*extract, folder / "own", "--no-tsv"], "own, table of events": [*extract, folder / "rows"],
                "copies": by_dclab("HE-3D-FEM-22", "area_um deform emodulus temp", "copies")}
    for table in PUBLISHED:
        commands[f"rheocyte, {table}"] = [*extract, folder / table, "--no-tsv", "--table", text(table)]
        commands[f"dclab, {table}"] = by_dclab(table)
    used = dict(zip(commands, in_turns(options.runs, list(commands.values()))))
    head(f"moduli of {count} events, file to file", "rheocyte: processor, wall (s)", "dclab: processor, wall (s)",
         "million events/s of processor time", "ratio of processor times")
    peer = used["dclab, HE-3D-FEM-22"]
    show("own table of the square channel; HE-3D-FEM-22", used["own"], peer, count)
    show("the same, dclab copies the three features", used["own"], used["copies"], count)
    show("the same, dclab without its import", used["own"], [a - b for a, b in zip(peer, imports)], count)
    show("the same, rheocyte also writes its table of events", used["own, table of events"], peer, count)
    for table in PUBLISHED:
        show(f"{table} in both", used[f"rheocyte, {table}"], used[f"dclab, {table}"], count)
    for table in PUBLISHED:
        ours, theirs = (columns_of(file, "emodulus")[0]
                        for file in (folder / table / "events_rheocyte.rtdc", folder / f"{table}-basins.rtdc"))
        print(f"\n{table}: {np.isfinite(ours).sum()} moduli, greatest relative difference {difference(ours, theirs):.0e}")
    own = columns_of(folder / "own" / "events_rheocyte.rtdc", "emodulus")[0]
    print(f"\nOwn table: {np.isfinite(own).sum()} moduli", flush=True)


def events_in_hull(table, count):
    """Everywhere in the table with equal probability."""
    random = np.random.default_rng(1)
    area, deformation = 340 * random.random(8 * count), 0.2 * random.random(8 * count)
    inside = np.isfinite(emodulus.get_emodulus(area_um=area, deform=deformation, medium=5.0, channel_width=WIDTH_UM, flow_rate=0.06,
                                               px_um=0, temperature=None, lut_data=table, visc_model=None))
    return area[inside][:count], deformation[inside][:count], random.uniform(22, 25, min(count, inside.sum()))


def time_of_get_emodulus(table, events):
    """Processor time (s)."""
    area, deformation, temperature = events
    start = time.process_time()
    emodulus.get_emodulus(area_um=area, deform=deformation, medium=MEDIUM, channel_width=WIDTH_UM, flow_rate=0.06, px_um=PIXEL_UM,
                          temperature=temperature, lut_data=table, visc_model=MODEL)
    return time.process_time() - start


def time_of_bench_extract(options, table, name):
    """Processor time (s), for a million events where they count."""
    command = [options.bench, Path(emodulus.__file__).parent / f"lut_{table}.txt", TOP / "data" / "grid_HE-3D-26.cbor",
               TOP / "data" / "elongated_HE-3D-el-26.cbor", f"--benchmark_filter=^{name}$", "--benchmark_format=json"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return json.loads(output)["benchmarks"][0]["cpu_time"] / 1e3


def compare_moduli_in_memory(options):
    head("moduli in memory", "rheocyte: million/s of processor time", "dclab", "ratio", "rheocyte: table, triangulation (s)",
         "dclab: a call with one event (s)", "ratio without these")
    several = range(options.runs)
    for table in PUBLISHED:
        kinds = (("moduli_of_a_population", "a population", population(MILLION)),
                 ("moduli_uniform_in_hull", "all over the table", events_in_hull(table, MILLION)))
        for name, what, events in kinds:
            one = [column[:1] for column in events]
            rounds = [(time_of_bench_extract(options, table, name), time_of_get_emodulus(table, events),
                       time_of_bench_extract(options, table, "table_and_triangulation"), time_of_get_emodulus(table, one))
                      for _ in several]
            ours, theirs, our_start, their_start = map(min, zip(*rounds))
            print(f"| {table}, {what} | {1 / ours:.3g} | {1 / theirs:.3g} | {theirs / ours:.1f} | {our_start:.3f} "
                  f"| {their_start:.3f} | {(theirs - their_start) / ours:.1f} |", flush=True)
    own = min(time_of_bench_extract(options, PUBLISHED[0], "own_moduli_of_a_population") for _ in several)
    print(f"| HE-3D-26 with standard errors and states, a population | {1 / own:.3g} | | | | | |", flush=True)


def compare_features(options, folder):
    recording, few = folder / "masks.rtdc", folder / "few.rtdc"
    count, kept, masks_per_read = write_masks(options.program, recording, few, options.masks)
    features = [options.program, "features", "--quiet", "-o", folder / "features"]
    dcnum_used = in_turns(options.runs, [[*features, recording],
                                         python(FEATURES_BY_DCNUM, recording, folder / "dcnum.rtdc", masks_per_read)])
    dclab_used = in_turns(options.runs, [[*features, few], python(FEATURES_BY_DCLAB, few, folder / "dclab.rtdc")])
    with h5py.File(recording) as masks:
        height, width = masks["events/mask"].shape[1:]
    head(f"features from masks of {width} x {height}, file to file", "rheocyte: processor, wall (s)", "peer: processor, wall (s)",
         "million events/s of processor time", "ratio of processor times")
    show(f"{count} masks, dcnum: moments, volume", *dcnum_used, count)
    show(f"{kept} masks, dclab: volume, tilt, inertia ratios", *dclab_used, kept)
    shared = {"dcnum": ("area_um", "deform", "inert_ratio_cvx", "inert_ratio_prnc", "tilt", "volume"),
              "dclab": ("inert_ratio_cvx", "inert_ratio_prnc", "inert_ratio_raw", "tilt", "volume")}
    for (peer, names), source in zip(shared.items(), (recording, few)):
        ours = columns_of(folder / "features" / f"{source.stem}_features_rheocyte.rtdc", *names)
        theirs = columns_of(folder / f"{peer}.rtdc", *names)
        print(f"\n{peer}, greatest relative differences: "
              + ", ".join(f"{name} {difference(*pair):.0e}" for name, *pair in zip(names, ours, theirs)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=TOP / "build" / "rheocyte")
    parser.add_argument("--bench", type=Path, default=TOP / "build" / "bench_extract")
    parser.add_argument("--events", type=int, default=1_000_000)
    parser.add_argument("--masks", type=int, default=100_000)
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    options.program, options.bench = options.program.absolute(), options.bench.absolute()
    version = subprocess.run([options.program, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    print(f"{version}, dclab {dclab.__version__}, dcnum {dcnum.__version__}, Python {sys.version.split()[0]}; "
          f"the least of {options.runs} runs")
    with tempfile.TemporaryDirectory() as folder:
        compare_moduli_of_files(options, Path(folder), compare_starts(options))
        compare_moduli_in_memory(options)
        compare_features(options, Path(folder))


if __name__ == "__main__":
    main()
