#!/usr/bin/env python3
"""How well `rheocyte time-course` finds cells that are followed through a chip in three dimensions, in another liquid and on
another mesh than those of its table.

    bench/round_trip_chip.py FOLDER [--cells 6] [--program build/rheocyte]

Each cell comes through the planar funnel of examples/transit-square.toml in CellCarrier at 23 degC (a power-law liquid; the
table's is Newtonian), at degree 4 (the table's is 3), and is drawn as masks of 0.34 um pixels at four places behind it.
Some minutes a cell. Needs matplotlib and h5py.
"""
import argparse
import csv
import subprocess
from pathlib import Path

import h5py
import numpy as np
from round_trip_square import MEDIUM, RATE_UL_S, TEMPERATURE_C, WIDTH_UM, liquid, mask, write

import rheocyte

FUNNEL_ENDS_UM, PLACES_UM, BETWEEN_CELLS_S = 70.0, (15, 60, 140, 290), 1.0


def cell(random, viscosity):
    """Radius (um), modulus (kPa), viscosity (Pa s), inside the table, whose liquid has 15 mPa s."""
    radius = random.uniform(5.3, 7.6)
    modulus = viscosity / 15 * (radius / 8) ** 1.5 * np.exp(random.uniform(np.log(4.5), np.log(15)))
    return radius, modulus, modulus * np.exp(random.uniform(np.log(0.15), np.log(2))) / 3


def seen(of_cell):
    """Of each place: where (um behind the funnel), when (s), and the closed outline (um)."""
    radius, modulus, viscosity = of_cell
    states = list(rheocyte.evolve({
        "channel": {"section": "square", "profile": {"x_um": [30.0, 70.0], "width_um": [100.0, 20.0]}},
        "flow": liquid() | {"density_kg_per_m3": 0},
        "cell": {"radius_um": radius, "viscosity_mPas": 1e3 * viscosity, "density_kg_per_m3": 0,
                 "bulk": {"law": "neo-hookean", "young_modulus_kPa": modulus}},
        "time": {"end_um": FUNNEL_ENDS_UM + PLACES_UM[-1], "output_every_um": 5.0, "accuracy": 3e-4, "degree": 4}}))
    at = {round(state.position_um - FUNNEL_ENDS_UM): state for state in states}
    for place in PLACES_UM:
        state = at.get(place, states[-1])  # behind the place at which it has settled its shape stays
        half = np.asarray(state.contour)
        rest_us = (FUNNEL_ENDS_UM + place - state.position_um) / state.cell_velocity_m_per_s
        yield place, 1e-6 * (state.t_us + rest_us), np.vstack([half, half[::-1] * [1, -1]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cells", type=int, default=6)
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(7)
    viscosity = float(rheocyte.viscosity(MEDIUM, channel_width_um=WIDTH_UM, flow_rate_ul_s=RATE_UL_S,
                                         temperature_C=TEMPERATURE_C))
    cells, masks, places, times = [], [], [], []
    for number in range(options.cells):
        cells.append(cell(random, viscosity))
        for place, time, outline in seen(cells[-1]):
            masks.append(mask(outline, random))
            places.append(place)
            times.append(number * BETWEEN_CELLS_S + time)
    recording, table = options.folder / "chip.rtdc", options.folder / "cells.tsv"
    write(recording, np.array(masks))
    with h5py.File(recording, "r+") as file:
        file["events/pos_x"][:], file["events/time"] = places, times
    subprocess.run([options.program, "time-course", recording, "--contraction-um", "0", "-o", table], check=True)
    with open(table) as file:
        rows = list(csv.DictReader((line for line in file if not line.startswith("#")), delimiter="\t"))
    for (radius, modulus, inner), row in zip(cells, rows):
        print(f"{radius:.2f} um, 3 viscosity / E {3 * inner / modulus:.2f} ms", end="")
        for name, truth in (("young_modulus_kPa", modulus), ("viscosity_Pas", inner)):
            stem, unit = name.rsplit("_", 1)
            low, high = (float(row[f"{stem}_{end}_{unit}"]) for end in ("low", "high"))
            print(f", {stem} {truth:.3g}: {float(row[name]):.3g} ({low:.3g} to {high:.3g})", end="")
        print(flush=True)


if __name__ == "__main__":
    main()
