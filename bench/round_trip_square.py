#!/usr/bin/env python3
"""How well `rheocyte moduli` and `rheocyte population --model cortex` find cells that are solved in the square channel itself, by
a table of the tube.

    bench/round_trip_square.py TABLE FOLDER [--recordings 8] [--cells 24] [--places 6] [--law neo-hookean]

TABLE is a combined table of elongated cells (examples/tables/combined-elongated.toml). Each recording has cells with bulk,
cortex and surface tension under one axial tension, their medians at random, in CellCarrier at 23 degC (a power-law
liquid; the table's is Newtonian), drawn as masks of 0.34 um pixels at random places. No cell is one of the table, and none
was solved by the method of its tube. Recordings that are in FOLDER are not solved again. Needs matplotlib and h5py.
"""
import argparse
import json
import re
import subprocess
from pathlib import Path

import h5py
import numpy as np
from matplotlib.path import Path as Outline

import rheocyte

WIDTH_UM, RATE_UL_S, TEMPERATURE_C, MEDIUM, PIXEL_UM = 20.0, 0.04, 23.0, "CellCarrier", 0.34
EXPONENT = 0.00223 * (273.15 + TEMPERATURE_C) - 0.0056  # of this medium (docs/theory-extract.md, eq:buyukurganci)
PICTURE = (60, 90)  # pixels
MODULI = ("young_modulus_kPa", "cortex_modulus_mN_per_m", "stiffness_kPa")


def liquid():
    viscosity = rheocyte.viscosity(MEDIUM, channel_width_um=WIDTH_UM, flow_rate_ul_s=RATE_UL_S,
                                   temperature_C=TEMPERATURE_C)
    shear_rate = 8 * RATE_UL_S / (1e-3 * WIDTH_UM) ** 3 * (0.6671 + 0.2121 / EXPONENT)
    return {"law": "power-law", "exponent": EXPONENT, "rate_ul_per_s": RATE_UL_S,
            "consistency_Pa_sn": 1e-3 * float(viscosity) * shear_rate ** (1 - EXPONENT)}


class Medians:
    """Of a recording: moduli (kPa, mN/m), tension of the cortex over its modulus, axial tension (Pa)."""

    def __init__(self, random):
        self.young, self.cortex = np.exp(random.uniform(np.log([0.25, 1.4]), np.log([0.9, 3])))
        self.ratio, self.axial = random.uniform(0.2, 0.45), random.uniform(80, 300)

    def cell(self, random, law):
        young, cortex = self.young * np.exp(0.2 * random.normal()), self.cortex * np.exp(0.2 * random.normal())
        return {"radius_um": 6.4 * np.exp(0.05 * random.normal()),
                "bulk": {"law": "neo-hookean", "young_modulus_kPa": young},
                "cortex": {"law": law, "modulus_mN_per_m": cortex, "bending_kBT": 2e3,
                           "tension_mN_per_m": self.ratio * cortex}}


def solved(cell, axial_Pa):
    """Its outline (um), or None where there is no such state."""
    try:
        state = rheocyte.solve({"channel": {"section": "square", "width_um": WIDTH_UM}, "cell": cell,
                                "flow": liquid() | {"axial_tension_Pa": axial_Pa}, "numerics": {"accuracy": 3e-3}})
    except rheocyte.UserError:
        return None
    half = np.asarray(state.contour)
    return np.vstack([half, half[::-1] * [1, -1]]) if state.converged else None


def mask(outline, random):
    rows, columns = np.indices(PICTURE)
    points = outline / PIXEL_UM
    points = points - points.mean(axis=0) + [PICTURE[1] / 2, PICTURE[0] / 2] + random.uniform(-0.5, 0.5, 2)
    return Outline(points).contains_points(np.stack([columns.ravel(), rows.ravel()], axis=1)).reshape(PICTURE)


def write(file, masks):
    features = rheocyte.features(masks, PIXEL_UM)
    with h5py.File(file, "w") as recording:
        recording.attrs.update({
            "experiment:event count": len(masks), "experiment:run index": 1, "experiment:sample": "solved in the square",
            "imaging:pixel size": PIXEL_UM, "imaging:roi size x": PICTURE[1], "imaging:roi size y": PICTURE[0],
            "setup:channel width": WIDTH_UM, "setup:chip region": "channel", "setup:flow rate": RATE_UL_S,
            "setup:medium": MEDIUM, "setup:temperature": TEMPERATURE_C})
        for name in ("area_um", "deform", "area_ratio", "inert_ratio_cvx", "pos_x", "pos_y"):
            recording[f"events/{name}"] = features[name].to_numpy(float)
        recording["events/mask"] = (255 * np.asarray(masks)).astype(np.uint8)


def recorded(number, options):
    """The file and the medians of its cells."""
    file, kept = (options.folder / f"square-{number}{end}" for end in (".rtdc", "-truth.json"))
    if kept.exists():
        return file, json.loads(kept.read_text())
    random = np.random.default_rng([3, number])
    medians, masks, moduli = Medians(random), [], []
    for _ in range(5 * options.cells):
        cell = medians.cell(random, options.law)
        outline = solved(cell, medians.axial)
        if outline is None:
            continue
        young, cortex = cell["bulk"]["young_modulus_kPa"], cell["cortex"]["modulus_mN_per_m"]
        moduli.append((young, cortex, young + cortex / cell["radius_um"]))
        masks += [mask(outline, random) for _ in range(options.places)]
        if len(moduli) == options.cells:
            break
    write(file, np.array(masks))
    truth = {"axial_tension": medians.axial} | dict(zip(MODULI, np.median(moduli, axis=0)))
    kept.write_text(json.dumps(truth))
    return file, truth


def round_trip(number, options):
    file, truth = recorded(number, options)
    subprocess.run([options.program, "moduli", file, "--table", options.table, "-o", options.folder], check=True,
                   capture_output=True)
    found = json.loads((options.folder / f"{file.stem}_moduli.json").read_text())
    found["population"] = as_population(file, options)
    return truth, found


def as_population(file, options):
    """Medians with their standard errors, those of table and section included, by name; without the ones that are not given."""
    folder = options.folder / f"{file.stem}-population"
    subprocess.run([options.program, "population", "--model", "cortex", "--condition", f"cells={file}", "--table", options.table,
                    "-o", folder, "--no-picture", "--quiet"], check=False, capture_output=True)
    found = json.loads((folder / "population.json").read_text())
    told = {}
    for each in found["quantities"]:
        row, name = found["recordings"][0], each["quantity"]
        if value := row[each["median"]]:
            relative = np.hypot(row[f"{name}_ln_median_error"], row[f"{name}_ln_median_common_error"])
            told[each["median"].replace("_median_", "_")] = f"{value:.4g} +- {relative * value:.2g}"
    return told


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--recordings", type=int, default=8)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--cells", type=int, default=24)
    parser.add_argument("--places", type=int, default=6)
    parser.add_argument("--law", default="neo-hookean", help="of the cortex of the solved cells")
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for number in range(options.first, options.first + options.recordings):
        truth, found = round_trip(number, options)
        print(f"{number}: {found['events']['resolved']} of {sum(found['events'].values())} events, axial tension "
              f"{truth['axial_tension']:.0f} Pa: {found['axial_tension_Pa']:.1f} ({found['axial_tension_Pa_low']:.1f} to "
              f"{found['axial_tension_Pa_high']:.1f})", end="")
        for name in MODULI:
            median = re.sub("_(kPa|mN_per_m)$", r"_median_\1", name)
            print(f", {name} {truth[name]:.4g}: {found[median]:.4g} +- {found[f'{median}_error']:.2g}", end="")
        print(";", "as a population:", ", ".join(f"{name} {told}" for name, told in found["population"].items()) or "nothing", flush=True)


if __name__ == "__main__":
    main()
