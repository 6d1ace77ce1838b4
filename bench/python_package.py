#!/usr/bin/env python3
"""The Python package, the program and dclab in one run: import, moduli in memory, from file to file, features of masks, sessions.

    PYTHONPATH=build/python-tree bench/python_package.py [--program build/rheocyte] [--events N] [--masks N]

Prints a table in Markdown. Processor times of one thread, medians of five; dclab's and rheocyte's turns alternate, so that
a machine whose speed drifts is fair to both. Needs dclab; the events are made up here.
"""
import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[threads] = "1"

import dclab  # noqa: E402
import numpy as np  # noqa: E402
import rheocyte  # noqa: E402
from dclab.features import emodulus  # noqa: E402

TABLE, PIXEL = "LE-2D-FEM-19", 0.34
EXPORT_WITH_DCLAB = f"""
import sys
import dclab
if "source" not in globals():
    source, target = sys.argv[1:]
with dclab.new_dataset(source) as dataset:
    dataset.config["calculation"].update({{"emodulus lut": "{TABLE}", "emodulus medium": "CellCarrier",
                                          "emodulus viscosity model": "buyukurganci-2022"}})
    dataset.export.hdf5(target, features=["area_um", "deform", "temp", "emodulus"], override=True)
"""
CHANNEL = {"channel_width_um": 20, "flow_rate_ul_s": 0.04}


def processor_time():
    """Of this process and of those that it has waited for."""
    return sum(used.ru_utime + used.ru_stime for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def seconds(task):
    start = processor_time()
    task()
    return processor_time() - start


def alternate(*tasks):
    """Median processor time of each."""
    runs = [[seconds(task) for task in tasks] for _ in range(5)]
    return [statistics.median(times) for times in zip(*runs)]


def events(count):
    """Area, deformation and temperature of a population of cells."""
    random = np.random.default_rng(7)
    area = random.normal(80, 12, count).clip(40, 200)
    return area, random.normal(0.05, 0.01, count).clip(0.005, 0.12), random.normal(23, 0.3, count)


def show(what, ours, theirs=None, unit="s"):
    print(f"| {what} | {ours:.3g} {unit} |" + (f" {theirs:.3g} {unit} | {theirs / ours:.1f} |" if theirs else " | |"), flush=True)


def time_import():
    code = "import numpy, time; a = time.process_time(); import rheocyte; rheocyte.Case; print(time.process_time() - a)"
    runs = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
            for _ in range(5)]
    show("`import rheocyte` beyond numpy", statistics.median(runs))


def time_moduli(area, deformation, temperature):
    own, published = rheocyte.Table("LE-2D-26"), rheocyte.Table(TABLE)
    liquid = {"medium": "CellCarrier", "temperature_C": temperature, "pixel_size_um": PIXEL}
    millions = len(area) / 1e6
    for what, settings in (("", {"viscosity_mPas": 5.7, "pixel_size_um": 0}), (" and pixels", {"viscosity_mPas": 5.7, "pixel_size_um": PIXEL})):
        time_of = alternate(lambda: own.modulus(area, deformation, **CHANNEL, **settings))[0]
        show(f"LE-2D-26: moduli, standard errors and states{what}", millions / time_of, unit="million/s")

    def theirs():
        return emodulus.get_emodulus(area_um=area, deform=deformation, medium="CellCarrier", channel_width=20, flow_rate=0.04,
                                     px_um=PIXEL, temperature=temperature, lut_data=TABLE, visc_model="buyukurganci-2022")

    def ours():
        return published.modulus(area, deformation, **CHANNEL, **liquid)

    show(f"{TABLE}: moduli at each event's temperature", *alternate(ours, theirs))
    assert np.allclose(ours().young_modulus_kPa, theirs(), rtol=1e-6, equal_nan=True)


def write_recording(path, area, deformation, temperature):
    with dclab.RTDCWriter(path) as writer:
        writer.store_metadata({
            "experiment": {"date": "2024-01-01", "event count": len(area), "run index": 1, "sample": "made up", "time": "12:00:00"},
            "imaging": {"pixel size": PIXEL},
            "setup": {"channel width": 20, "chip region": "channel", "flow rate": 0.04, "medium": "CellCarrier"}})
        for name, column in (("area_um", area), ("deform", deformation), ("temp", temperature)):
            writer.store_feature(name, column)


def time_files(program, folder, area, deformation, temperature):
    recording = folder / "recording.rtdc"
    published = Path(emodulus.__file__).parent / f"lut_{TABLE}.txt"
    write_recording(recording, area, deformation, temperature)

    def ours():
        subprocess.run([program, "extract", recording, "-o", folder / "ours", "--table", published, "--no-tsv", "--quiet"],
                       check=True, stdout=subprocess.DEVNULL)

    def script_with_dclab():
        subprocess.run([sys.executable, "-W", "ignore", "-c", EXPORT_WITH_DCLAB, recording, folder / "theirs.rtdc"], check=True)

    def dclab_imported_before():
        exec(EXPORT_WITH_DCLAB, {"source": recording, "target": folder / "theirs.rtdc"})

    show("`rheocyte extract` against a script with dclab, from file to file", *alternate(ours, script_with_dclab))
    show("the same against dclab when it is imported already", *alternate(ours, dclab_imported_before))


def time_features(folder, count):
    spec = {"recording": {"cells": count, "seed": 3}, "channel": {"width_um": 20},
            "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
            "cell": {"radius_um": {"mean": 6.5, "sd": 0.5}, "bulk": {"young_modulus_kPa": {"mean": 4, "sd": 0.5}}}}
    recording = folder / "masks.rtdc"
    rheocyte.synth(spec, recording)
    with dclab.new_dataset(recording) as dataset:
        masks, x, y = dataset["mask"][:], dataset["pos_x"][:], dataset["pos_y"][:]
    from dclab.features import contour, inert_ratio, volume

    def theirs():
        outlines = contour.get_contour(masks)
        inert_ratio.get_inert_ratio_cvx(outlines)
        inert_ratio.get_inert_ratio_prnc(outlines)
        inert_ratio.get_inert_ratio_raw(outlines)
        inert_ratio.get_tilt(outlines)
        volume.get_volume(outlines, x, y, PIXEL)

    def ours():
        rheocyte.features(masks, PIXEL)

    show(f"features from {len(masks)} masks in memory (rheocyte 27, dclab contour, volume, tilt and 3 inertia ratios)",
         *alternate(ours, theirs))


def time_session():
    session = rheocyte.Session()
    case = rheocyte.Case("examples/paper-cell.toml")
    session.solve(case)
    added = []
    for i in range(100):  # the solver computes in a thread of its own: what this one takes is Python's
        start = time.thread_time()
        session.solve(case, young_modulus_kPa=3.437 * (1 + 0.001 * i))
        added.append(1e3 * (time.thread_time() - start))
    show("what Python adds to `Session.solve` with a keyword, a call (median of 100)", statistics.median(added), unit="ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--events", type=int, default=1_000_000)
    parser.add_argument("--masks", type=int, default=8000)
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    arguments = parser.parse_args()
    os.chdir(Path(__file__).resolve().parent.parent)
    print(f"rheocyte {rheocyte.__version__}, dclab {dclab.__version__}\n\n| what | rheocyte | dclab | factor |\n|---|---|---|---|")
    time_import()
    columns = events(arguments.events)
    time_moduli(*columns)
    time_session()
    with tempfile.TemporaryDirectory() as folder:
        time_files(arguments.program.absolute(), Path(folder), *columns)
        time_features(Path(folder), arguments.masks)


if __name__ == "__main__":
    main()
