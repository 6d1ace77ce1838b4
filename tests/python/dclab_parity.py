#!/usr/bin/env python3
"""Young's moduli of recordings by rheocyte and by dclab, in one process: by each table, measured in ten ways.

    PYTHONPATH=build/python-tree python3 tests/python/dclab_parity.py PATH...

PATH is a recording (.rtdc), a folder with some below it, or an archive: a zip with a recording, as dclab keeps those of its
tests, or the source distribution of dclab itself (pip download --no-deps --no-binary dclab dclab). Measurements of the
older format tdms are converted by dclab (pip install "dclab[tdms]"). Prints a table in Markdown; exit 1 if a
modulus is missing on one side only, or differs by more than 1e-6.
"""
import functools
import sys
import tarfile
import tempfile
import warnings
import zipfile
from collections import defaultdict
from pathlib import Path

import dclab
import numpy as np
import rheocyte
from dclab.features import emodulus

PROMISED = 1e-6  # relative
PUBLISHED = ("LE-2D-FEM-19", "HE-2D-FEM-22", "HE-3D-FEM-22")
MEASURED = ({"width": 20, "rate": 0.04, "mPas": 15}, {"width": 20, "rate": 0.12, "mPas": 5.7},
            {"width": 30, "rate": 0.16, "mPas": 3.5}, {"width": 15, "rate": 0.032, "mPas": 10},
            {"width": 40, "rate": 1.2, "mPas": 1.1}, {"width": 20, "rate": 0.06, "medium": "CellCarrier", "degC": 23},
            {"width": 30, "rate": 0.24, "medium": "CellCarrierB", "degC": 24.5},
            {"width": 20, "rate": 0.06, "medium": "CellCarrier", "degC": 22, "model": "herold-2017"},
            {"width": 15, "rate": 0.016, "medium": "CellCarrierB", "degC": 21, "model": "herold-2017"},
            {"width": 20, "rate": 0.04, "medium": "water", "degC": 25})


@functools.cache
def tables():
    """Published ones by their names, rheocyte's own by their text files."""
    return {**{name: name for name in PUBLISHED},
            **{name: str(rheocyte.Table(name).texts().table) for name in rheocyte.table_names()}}


def pixel_size(path):
    with dclab.new_dataset(path) as dataset:
        return dataset.config["imaging"].get("pixel size", 0.34)


def has_events(path):
    """Whether dclab finds something to determine a modulus from."""
    try:
        with dclab.new_dataset(path) as dataset:
            return len(dataset) > 0 and "area_um" in dataset and "deform" in dataset
    except (ValueError, OSError, KeyError):
        return False


def events(path):
    """Area and deformation, as dclab reads them."""
    with dclab.new_dataset(path) as dataset:
        return np.array(dataset["area_um"]), np.array(dataset["deform"])


def their_moduli(area, deform, pixel, table, width, rate, mPas=None, medium=None, degC=None, model="buyukurganci-2022"):
    model = None if mPas else "kestin-1978" if medium == "water" else model
    return emodulus.get_emodulus(area_um=area, deform=deform, medium=mPas or medium, channel_width=width, flow_rate=rate,
                                 px_um=pixel, temperature=degC, lut_data=table, visc_model=model)


def our_moduli(path, table, width, rate, mPas=None, medium=None, degC=None, model=None):
    """By rheocyte.extract, from the file."""
    return rheocyte.extract(path, table=table, channel_width_um=width, flow_rate_ul_s=rate, viscosity_mPas=mPas,
                            medium=medium, temperature=degC, viscosity_model=model, no_asymmetry=True,
                            pixel_size_um=pixel_size(path))["young_modulus_kPa"].to_numpy()


def our_moduli_in_memory(area, deform, pixel, table, width, rate, mPas=None, medium=None, degC=None,
                         model="buyukurganci-2022"):
    """By a rheocyte.Table."""
    return table.modulus(area, deform, channel_width_um=width, flow_rate_ul_s=rate, viscosity_mPas=mPas, medium=medium,
                         temperature_C=degC, viscosity_model=model, pixel_size_um=pixel).young_modulus_kPa


def difference(ours, theirs):
    """Events with a modulus on one side only, and the greatest relative difference of the others."""
    has = np.isfinite(ours) & np.isfinite(theirs)
    greatest = np.abs(ours[has] / theirs[has] - 1).max() if has.any() else 0.0
    return int((np.isnan(ours) != np.isnan(theirs)).sum()), float(greatest)


def converted(path, folder):
    """Area and deformation of a measurement in the older format as a recording; nothing if dclab cannot read it."""
    target = folder / f"{path.parent.name}.rtdc"
    try:
        with dclab.new_dataset(path) as dataset, dclab.RTDCWriter(target) as writer:
            writer.store_metadata({section: dict(dataset.config[section]) for section in ("imaging", "setup")})
            for name in ("area_um", "deform"):
                writer.store_feature(name, np.array(dataset[name])[:len(dataset)])
    except (ImportError, ValueError, OSError, KeyError) as error:
        print(f"{path.parent.name}/{path.name}: dclab does not read it ({str(error)[:80]})", file=sys.stderr)
        return []
    return [target]


def recordings(path, folder):
    """Below a folder or in an archive, which is unpacked into `folder`."""
    if path.is_dir():
        inside = sorted(p for p in path.rglob("*") if p.suffix in (".rtdc", ".tdms", ".zip"))
        return [found for p in inside if not p.stem.endswith("_traces") for found in recordings(p, folder)]
    if path.suffix == ".rtdc":
        return [path]
    target = Path(tempfile.mkdtemp(dir=folder))
    if path.suffix == ".tdms":
        return converted(path, target)
    if path.suffix == ".zip":
        target /= path.stem
        zipfile.ZipFile(path).extractall(target)
    else:
        with tarfile.open(path) as archive:
            archive.extractall(target, filter="data")
    return recordings(target, folder)


def main():
    if len(sys.argv) < 2:
        sys.exit(f"error: {__doc__.splitlines()[2].strip()}")
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as folder:
        found = [p for argument in sys.argv[1:] for p in recordings(Path(argument), Path(folder)) if has_events(p)]
        by_pixel = defaultdict(list)  # dclab asks each event on its own, but triangulates its table in each call
        for path in found:
            by_pixel[pixel_size(path)].append(events(path))
    counts, greatest = defaultdict(lambda: np.zeros(3, dtype=int)), defaultdict(float)
    for name, place in tables().items():
        table = rheocyte.Table(place)
        for measured in MEASURED:
            for pixel, parts in by_pixel.items():
                area, deform = (np.concatenate(columns) for columns in zip(*parts))
                ours = our_moduli_in_memory(area, deform, pixel, table, **measured)
                missing, far = difference(ours, their_moduli(area, deform, pixel, place, **measured))
                counts[name] += len(ours), np.isfinite(ours).sum(), missing
                greatest[name] = max(greatest[name], far)
    print(f"dclab {dclab.__version__}, {len(found)} recordings, {len(MEASURED)} ways to measure\n\n"
          "| table | events asked | with a modulus | NaN on one side only | greatest relative difference |\n"
          "|---|---|---|---|---|")
    for name, (asked, has, missing) in counts.items():
        print(f"| {name} | {asked} | {has} | {missing} | {greatest[name]:.1e} |")
    sys.exit(any(row[2] for row in counts.values()) or max(greatest.values(), default=0) > PROMISED)


if __name__ == "__main__":
    main()
