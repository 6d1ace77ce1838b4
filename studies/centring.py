#!/usr/bin/env python3
"""Where cells are that came into the funnel of a chip beside its axis, and what a camera sees of them there.

    studies/centring.py [--program build/rheocyte] [--workers 2] [--degree 3] [--folder FOLDER] [--moduli-kPa 1 2 4]

Cells of 6 um and 1, 2 and 4 kPa, evenly distributed over the middle 64 um of the mouth of a planar funnel (100 to 20 um at
45 degrees, 20 um high; 0.04 ul/s, 6 mPa s; nearer to the wall the mesh cannot follow them), are followed to 250 um behind
it: their places off the axis, and c2, c3 and s2 of the outline in the plane of the funnel. Prints a line a cell, and of
each modulus the rms place along the channel and the slope of s2 over the place. A minute a cell.
"""
import argparse
import csv
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

EXAMPLE = Path(__file__).parent.parent / "examples" / "transit-off-axis.toml"
MODULI_KPA, STARTS_UM = (1.0, 2.0, 4.0), (2.0, 8.0, 16.0, 24.0, 32.0)
FUNNEL_ENDS_UM, PLACES_UM = 70.0, (10, 50, 100, 150, 200, 250)  # behind it


def modes(outline):
    """c2, c3 and s2 of a closed convex outline about its centroid, x downstream."""
    x, y = outline.T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    area = cross.sum() / 2
    centre = np.array([((x + np.roll(x, -1)) * cross).sum(), ((y + np.roll(y, -1)) * cross).sum()]) / (6 * area)
    across = outline - centre
    angle, radius = np.arctan2(across[:, 1], across[:, 0]), np.hypot(*across.T)
    order = np.argsort(angle)
    even = np.linspace(-np.pi, np.pi, 720, endpoint=False)
    r = np.interp(even, angle[order], radius[order], period=2 * np.pi)
    wave = lambda k: 2 * (r * np.exp(1j * k * even)).mean() / r.mean()
    return wave(2).real, wave(3).real, wave(2).imag


def rows(file):
    return list(csv.DictReader(file.open()))


def followed(modulus_kPa, start_um, folder, options):
    """By place behind the funnel: offset (um), c2, c3, s2; nothing if the cell cannot be followed there."""
    result = folder / f"{modulus_kPa:g}-{start_um:g}"
    done = subprocess.run([options.program, "solve", EXAMPLE, "-o", result, "--no-picture", "--no-output-fields",
                           "--set", f"cell.offset_um=[{start_um}, 0]", "--set", f"cell.bulk.young_modulus_kPa={modulus_kPa}",
                           "--set", f"time.degree={options.degree}",
                           "--set", f"time.end_um={FUNNEL_ENDS_UM + PLACES_UM[-1]}"], capture_output=True, text=True)
    if not (result / "outputs.csv").exists():
        print(f"{modulus_kPa} kPa from {start_um} um: {(done.stdout + done.stderr).strip().splitlines()[-1]}", flush=True)
        return {}
    outlines = {}
    for row in rows(result / "contours_offset.csv"):
        outlines.setdefault(float(row["t_us"]), []).append([float(row["x_um"]), float(row["y_um"])])
    outputs = rows(result / "outputs.csv")
    found, reached = {}, float(outputs[-1]["position_um"]) - FUNNEL_ENDS_UM
    for place in PLACES_UM:
        row = min(outputs, key=lambda row: abs(float(row["position_um"]) - FUNNEL_ENDS_UM - place))
        if abs(float(row["position_um"]) - FUNNEL_ENDS_UM - place) < 1:
            outline = min(outlines, key=lambda time: abs(time - float(row["t_us"])))
            found[place] = (float(row["offset_um"]), *modes(np.array(outlines[outline])))
    print(f"{modulus_kPa} kPa from {start_um} um: " + "; ".join(
        f"{place} um: y {y:.3f}, c2 {c2:.4f}, c3 {c3:.4f}, s2 {s2:.4f}" for place, (y, c2, c3, s2) in found.items())
        + f"; followed to {reached:.0f} um", flush=True)
    return found


def report(modulus_kPa, cells):
    for place in PLACES_UM:
        seen = np.array([cell[place] for cell in cells if place in cell])
        if len(seen) < len(STARTS_UM):
            continue
        y, c2, c3, s2 = seen.T
        even = np.linspace(0, STARTS_UM[-1], 200)  # from the axis to near the wall
        at = lambda values: np.interp(even, (0, *STARTS_UM), (values[0], *values))
        rms = np.sqrt((np.interp(even, (0, *STARTS_UM), (0, *y))**2).mean())
        print(f"{modulus_kPa} kPa, {place} um: rms of y {rms:.3f} um, slope of s2 {(y @ s2) / (y @ y):.4f} per um, "
              f"mean c2 {at(c2).mean():.4f}, c3 {at(c3).mean():.4f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--degree", type=int, default=3)
    parser.add_argument("--folder", type=Path)
    parser.add_argument("--moduli-kPa", type=float, nargs="+", default=MODULI_KPA)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(options.workers) as pool:
        folder = options.folder or Path(scratch)
        jobs = {modulus: [pool.submit(followed, modulus, start, folder, options) for start in STARTS_UM] for modulus in options.moduli_kPa}
        for modulus, cells in jobs.items():
            report(modulus, [cell.result() for cell in cells])


if __name__ == "__main__":
    main()
