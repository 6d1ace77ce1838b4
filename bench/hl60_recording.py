#!/usr/bin/env python3
"""The recording of HL60 cells in docs/real-cells.md, made from a snapshot of its public repository.

    bench/hl60_recording.py REPOSITORY HL60.rtdc [--all]

REPOSITORY is a clone of dicarlo-lab/metadeformability (Urbanska et al., Nat Methods 2020; MIT licence), with a work tree or
without. The events are those of `20160129_04_300mOsm - M1` (square channel of 20 um, 0.04 ul/s, CellCarrier) with their raw
outlines and places; as temperature 23 degC is assumed. Without --all only single, smooth cells: area_ratio up to 1.05, 80 to
220 um2. Needs numpy and h5py.
"""
import argparse
import io
import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

EVENTS = "Data_Raw/Strain/RTDC/20160129_04_300mOsm - M1"
FEATURES = ("area_um", "area_ratio", "deform", "inert_ratio_cvx", "pos_x", "pos_y", "time", "frame")
PIXEL_UM = 0.34
MARGIN_PX = 5  # beside the outlines, so that none touches the border


def content(repository, file):
    """Of a file of the newest commit."""
    return subprocess.run(["git", "-C", repository, "show", f"HEAD:{file}"], check=True, capture_output=True).stdout


def read_events(text):
    """{feature: values}; the first line holds the names, the lines after it that begin with # their meaning."""
    names = text.partition(b"\n")[0].decode("latin1").lstrip("# ").strip().split("\t")
    numbers = np.genfromtxt(io.BytesIO(text), comments="#", encoding="latin1")
    return {name.strip(): numbers[:, i] for i, name in enumerate(names)}


def read_outlines(text):
    """{frame: points (x, y) in pixels}"""
    outlines = {}
    for part in re.split(r"Contour in frame +", text.decode("latin1"))[1:]:
        frame, _, points = part.partition("\n")
        outlines[int(frame)] = np.array(re.findall(r"\(\s*(\d+)\s*,\s*(\d+)", points), dtype=np.uint16).reshape(-1, 2)
    return outlines


def single_cells(events):
    """Whether each event is one smooth cell."""
    return (events["area_ratio"] <= 1.05) & (events["area_um"] >= 80) & (events["area_um"] <= 220)


def write(file, events, outlines, wanted):
    """The wanted events that have an outline; returns how many."""
    chosen = [i for i, frame in enumerate(events["frame"]) if wanted[i] and len(outlines.get(int(frame), ())) > 2]
    points = [outlines[int(events["frame"][i])] for i in chosen]
    width, height = (int(max(p[:, axis].max() for p in points)) + MARGIN_PX for axis in (0, 1))
    with h5py.File(file, "w") as recording:
        recording.attrs.update({
            "experiment:date": "2016-01-29", "experiment:time": "12:00:00", "experiment:sample": "HL60, 300 mOsm",
            "experiment:run index": 1, "experiment:event count": len(chosen), "imaging:pixel size": PIXEL_UM,
            "imaging:roi size x": width, "imaging:roi size y": height, "setup:channel width": 20.0,
            "setup:chip region": "channel", "setup:flow rate": 0.04, "setup:medium": "CellCarrier",
            "setup:temperature": 23.0})
        group = recording.create_group("events")
        for name in FEATURES:
            group[name] = events[name][chosen]
        for i, outline in enumerate(points):
            group[f"contour/{i}"] = outline
    return len(chosen)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repository", type=Path)
    parser.add_argument("recording", type=Path)
    parser.add_argument("--all", action="store_true", help="every event")
    given = parser.parse_args()
    events = read_events(content(given.repository, f"{EVENTS}.tsv"))
    outlines = read_outlines(content(given.repository, f"{EVENTS}_contours.txt"))
    wanted = np.ones(len(events["frame"]), bool) if given.all else single_cells(events)
    print(f"{write(given.recording, events, outlines, wanted)} events")


if __name__ == "__main__":
    sys.exit(main())
