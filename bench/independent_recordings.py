#!/usr/bin/env python3
"""Whether the recommended modulus of `rheocyte extract` is right within its stated error, for recordings that share no line with
its renderer, its features and its tables.

    bench/independent_recordings.py FOLDER [--program build/rheocyte] [--masks coverage centre] [--tilts 1] [--recordings 40]

Each recording has round cells, stiff, middle or soft, or cells drawn out by an axial tension (from --first 40 on: cells that
are long at rest), in a channel of 15 to 40 um, in methyl cellulose or a Newtonian liquid. Their outlines are solved in the
square channel for nine cells (`rheocyte solve`) and interpolated in radius and modulus. Masks contain the pixels whose centre
lies inside, those covered by more than half, or those of which more than 32 of 8 x 8 samples lie inside: where the edge halves
a pixel, these leave it out. The camera is tilted by so many degrees. Prints the errors of the recommended modulus, of that from
deformation and of that by the outlines for each recording, and how many are right within one and two stated errors. These
contain how the cells scatter about the median of their population; of the cells' own median more are right. Outlines and
recordings that are in FOLDER are kept. Needs numpy, scipy, h5py and dclab.
"""
import argparse
import csv
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from dclab.features.emodulus.viscosity import get_viscosity
from scipy.interpolate import CubicSpline
from scipy.spatial import ConvexHull

PIXEL_UM = 0.34
EVENTS = 300
RADIUS_SPREAD, MODULUS_SPREAD, MOST_SPREADS = 0.04, 0.06, 2.5  # of the logarithms
NODES = 2 * np.array([-1.0, 0.0, 1.0])  # spreads of the solved cells from the median
ANGLES = 16384  # of an outline
MASKS = ("coverage", "samples", "centre")
SUBPIXELS = 8  # along each side of a pixel
DEFORMATIONS = {"stiff": (0.0025, 0.005), "middle": (0.007, 0.015), "soft": (0.02, 0.032), "elongated": (0.006, 0.015),
                "resting": (0.006, 0.015)}
RESTING = 40  # from this recording on
RATES = {15: 0.02, 20: 0.04, 30: 0.16, 40: 0.32}  # ul/s by width (um)
EXPONENTS = {"CellCarrier": -0.0056, "CellCarrierB": -0.0744}  # at 0 K (Buyukurganci et al. 2022)
PER_KELVIN = 0.00223


@dataclass(frozen=True)
class Setup:
    """A recording that is to be made. Without a medium the liquid is Newtonian."""

    number: int
    kind: str
    width_um: int
    medium: str
    temperature_C: float
    viscosity_mPas: float  # at the wall
    radius_um: float
    deformation: float  # of the median cell without the tension
    axial_ratio: float  # axial tension over Young's modulus
    rest_aspect: float = 1

    @property
    def name(self):
        return f"{self.number:02d}-{self.kind}-{self.width_um}um-{self.medium or 'newtonian'}"

    @property
    def rate_ul_s(self):
        return RATES[self.width_um]

    def liquid(self):
        if not self.medium:
            return {"flow.law": "newtonian", "flow.viscosity_mPas": self.viscosity_mPas}
        exponent = PER_KELVIN * (273.15 + self.temperature_C) + EXPONENTS[self.medium]
        shear_rate = 8 * self.rate_ul_s / (1e-3 * self.width_um) ** 3 * (0.6671 + 0.2121 / exponent)
        return {"flow.law": "power-law", "flow.exponent": exponent,
                "flow.consistency_Pa_sn": 1e-3 * self.viscosity_mPas * shear_rate ** (1 - exponent)}


def setup(number):
    random = np.random.default_rng([69, number])
    kind = list(DEFORMATIONS)[number % 4] if number < RESTING else "resting"
    width = (15, 20, 30, 40)[(number // 4 if number < RESTING else number) % 4]
    medium = ("CellCarrier", "", "CellCarrierB")[number // 16 if number < RESTING else number // 4 % 3]
    temperature = random.uniform(22, 25)
    viscosity = random.uniform(5, 15)
    if medium:
        viscosity = float(get_viscosity(medium=medium, channel_width=width, flow_rate=RATES[width], temperature=temperature,
                                        model="buyukurganci-2022"))
    return Setup(number, kind, width, medium, temperature, viscosity, width * random.uniform(0.26, 0.36),
                 np.exp(random.uniform(*np.log(DEFORMATIONS[kind]))), random.uniform(0.04, 0.2) if kind == "elongated" else 0,
                 random.uniform(1.06, 1.3) if kind == "resting" else 1)


def solve(program, kept, case, radius_um, modulus_kPa, axial_Pa=0):
    """Deformation and outline, as radii at even angles from the nose round the cell (um), about the barycentre."""
    keys = case | {"cell.radius_um": radius_um, "cell.bulk.young_modulus_kPa": modulus_kPa, "flow.axial_tension_Pa": axial_Pa}
    sets = [text for key, value in keys.items() for text in ("--set", f"{key}={json.dumps(value)}")]
    subprocess.run([program, "solve", kept / "case.toml", *sets, "-o", kept / "state", "--threads", "1", "--quiet", "--no-picture"],
                   check=True, capture_output=True)
    x, r = np.loadtxt(kept / "state/contour.csv", delimiter=",", skiprows=1, usecols=(0, 1)).T
    angle, radius = np.arctan2(r, x), np.hypot(x, r)
    half = CubicSpline(angle, radius, bc_type="clamped")(np.linspace(0, np.pi, ANGLES // 2 + 1))
    return json.loads((kept / "state/result.json").read_text())["deformation"], np.concatenate([half, half[-2:0:-1]])


def outlines(program, folder, setup):
    """Median modulus (kPa) and the outlines of the nine cells [radius, modulus, angle] (um)."""
    file = folder / f"{setup.name}.npz"
    if file.exists():
        stored = np.load(file)
        return float(stored["modulus"]), stored["outlines"]
    (folder / "case.toml").write_text(
        f'[channel]\nsection = "square"\nwidth_um = {setup.width_um}\n[flow]\nrate_ul_per_s = {setup.rate_ul_s}\n'
        "viscosity_mPas = 1\ndensity_kg_per_m3 = 0\n[cell]\nradius_um = 1\n[cell.bulk]\nyoung_modulus_kPa = 1\n"
        "[numerics]\naccuracy = 1e-3\n")
    case = setup.liquid()
    modulus = 4.6 * setup.viscosity_mPas * setup.rate_ul_s / (1e-3 * setup.width_um) ** 3 * 1e-3 * 0.4
    for _ in range(4):
        deformation, _ = solve(program, folder, case, setup.radius_um, modulus)
        modulus *= (deformation / setup.deformation) ** 0.5
    axial_Pa = 1e3 * setup.axial_ratio * modulus
    if setup.rest_aspect != 1:
        case["cell.rest_aspect"] = setup.rest_aspect
    found = [[solve(program, folder, case, setup.radius_um * np.exp(RADIUS_SPREAD * i), modulus * np.exp(MODULUS_SPREAD * j),
                    axial_Pa)[1] for j in NODES] for i in NODES]
    np.savez(file, modulus=modulus, outlines=found)
    return modulus, np.array(found)


def quadratic(place):
    """Weights of the three nodes."""
    return np.array([np.prod([(place - other) / (node - other) for other in NODES if other != node]) for node in NODES])


def mask(outline, tilt, place, shape, masks):
    """Of a cell whose barycentre is at a place (row, column) of the picture; outline in pixels."""
    def inside(row, column):
        angle = ((np.arctan2(row, column) - tilt) * ANGLES / (2 * np.pi) + 0.5).astype(int) % ANGLES
        return outline[angle] - np.hypot(row, column)

    row, column = np.indices(shape) - np.reshape(place, (2, 1, 1))
    depth = inside(row, column)
    result = depth > 0
    if masks != "centre":
        fine = (np.arange(SUBPIXELS) + 0.5) / SUBPIXELS - 0.5
        edge = np.abs(depth) < 0.75  # the half diagonal and a little
        parts = inside(row[edge][:, None, None] + fine[:, None], column[edge][:, None, None] + fine)
        part = np.clip(0.5 + SUBPIXELS * parts, 0, 1) if masks == "coverage" else parts > 0
        result[edge] = part.mean(axis=(1, 2)) > 0.5
    return result


def hull(picture):
    """Convex hull of the centres of the pixels, anticlockwise (x, y)."""
    rows = np.flatnonzero(picture.any(axis=1))
    first, last = picture[rows].argmax(axis=1), picture.shape[1] - 1 - picture[rows, ::-1].argmax(axis=1)
    points = np.concatenate([np.stack([first, rows], axis=1), np.stack([last, rows], axis=1)]).astype(float)
    return points[ConvexHull(points).vertices]


def polygon_features(points):
    """Area, perimeter, centroid and second moments over the area (x, y) about it of a polygon."""
    x, y = points.T
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    cross = x * y1 - x1 * y
    area = cross.sum() / 2
    centre = np.array([((x + x1) * cross).sum(), ((y + y1) * cross).sum()]) / (6 * area)
    moments = np.array([((x * x + x * x1 + x1 * x1) * cross).sum(), ((y * y + y * y1 + y1 * y1) * cross).sum()]) / (12 * area)
    return area, np.hypot(x1 - x, y1 - y).sum(), centre, moments - centre**2


def features(picture):
    area, perimeter, (x, y), (along, across) = polygon_features(hull(picture))
    return {"area_um": area * PIXEL_UM**2, "deform": 1 - 2 * np.sqrt(np.pi * area) / perimeter,
            "inert_ratio_cvx": np.sqrt(along / across), "pos_x": x * PIXEL_UM, "pos_y": y * PIXEL_UM}


def cells(setup, modulus, solved):
    """Moduli (kPa), outlines (pixels) and places between the pixels."""
    random = np.random.default_rng([70, setup.number])
    spreads = np.clip(random.normal(size=(2, EVENTS)), -MOST_SPREADS, MOST_SPREADS)
    drawn = np.array([np.einsum("i,j,ijk", quadratic(i), quadratic(j), solved) for i, j in spreads.T]) / PIXEL_UM
    return modulus * np.exp(MODULUS_SPREAD * spreads[1]), drawn, random.uniform(-0.5, 0.5, (EVENTS, 2))


def record(program, folder, setup, masks, tilt):
    """The file, the median modulus of its cells, and that of the population they were drawn from (kPa)."""
    modulus, solved = outlines(program, folder, setup)
    moduli, drawn, places = cells(setup, modulus, solved)
    file = folder / f"{setup.name}-{masks}-{tilt:g}deg.rtdc"
    if not file.exists():
        size = 2 * int(drawn.max() + 6)
        shape = (size, size + 16)
        pictures = np.array([mask(outline, np.radians(tilt), np.array(shape) / 2 + place, shape, masks)
                             for outline, place in zip(drawn, places)])
        write(file, setup, pictures)
    return file, float(np.median(moduli)), modulus


def write(file, setup, pictures, keep_masks=True):
    seen = [features(picture) for picture in pictures]
    with h5py.File(file, "w") as recording:
        recording.attrs.update({
            "experiment:event count": len(pictures), "experiment:run index": 1, "experiment:sample": setup.name,
            "experiment:date": "2026-01-01", "experiment:time": "12:00:00", "imaging:pixel size": PIXEL_UM,
            "imaging:roi size x": pictures.shape[2], "imaging:roi size y": pictures.shape[1], "setup:channel width": setup.width_um,
            "setup:chip region": "channel", "setup:flow rate": setup.rate_ul_s, "setup:flow rate sample": setup.rate_ul_s / 4,
            "setup:flow rate sheath": 0.75 * setup.rate_ul_s, "setup:medium": setup.medium or "other",
            "setup:temperature": setup.temperature_C, "setup:identifier": "independent", "setup:module composition": "Cell_Flow_2"})
        for name in seen[0]:
            recording[f"events/{name}"] = np.array([event[name] for event in seen])
        if not keep_masks:
            return
        recording.create_dataset("events/mask", data=(255 * pictures).astype(np.uint8), chunks=(1, *pictures.shape[1:]),
                                 compression="gzip", fletcher32=True)
        recording["events/mask"].attrs.update({"CLASS": np.bytes_("IMAGE"), "IMAGE_VERSION": np.bytes_("1.2")})


def extract(program, file, setup):
    """The recording's line of the summary."""
    folder = file.with_suffix("")
    viscosity = [] if setup.medium else ["--viscosity-mPas", str(setup.viscosity_mPas)]
    subprocess.run([program, "extract", file, "-o", folder, "--no-tsv", "--quiet", *viscosity], check=True, capture_output=True)
    with open(folder / "rheocyte_summary.tsv") as table:
        return list(csv.DictReader(table, delimiter="\t"))[-1]


def number(line, name):
    return float(line[name] or "nan")


def judged(line, truth, of_population):
    """Relative errors (%), by what, the stated errors (%), and the events without a modulus from deformation at either end (%)."""
    found = {name: 100 * (number(line, column) / truth - 1) for name, column in
             {"recommended": "recommended_young_modulus_median_kPa", "deformation": "young_modulus_median_kPa",
              "outlines": "young_modulus_elongated_median_kPa"}.items()}
    stated = [100 * number(line, f"recommended_young_modulus_median_kPa_{error}") / truth for error in ("error", "common_error")]
    at_end = [100 * sum(number(line, name) for name in names) / number(line, "events")
              for names in (("too_stiff", "unresolved"), ("too_soft", "unstable"))]
    found["of population"] = 100 * (number(line, "recommended_young_modulus_median_kPa") / of_population - 1)
    return found | {"by": line["recommended_modulus"], "scatter": stated[0], "common": stated[1], "stiff": at_end[0], "soft": at_end[1]}


def print_line(setup, truth, j):
    print(f"| {setup.name} | {truth:.3f} | {setup.deformation:.4f} | {j['by']} | {j['recommended']:+.2f} | {j['scatter']:.2f} | "
          f"{j['common']:.2f} | {j['deformation']:+.2f} | {j['outlines']:+.2f} | {j['stiff']:.0f}, {j['soft']:.0f} |", flush=True)


def print_coverage(name, lines):
    with_number = [j for j in lines if np.isfinite(j["recommended"])]
    if not with_number:
        return
    deviation, of_population = (np.array([abs(j[error]) / np.hypot(j["scatter"], j["common"]) for j in with_number])
                                for error in ("recommended", "of population"))
    mean = {number: np.nanmean([j[number] for j in lines]) for number in ("recommended", "deformation", "outlines")}
    print(f"{name}: {len(with_number)} of {len(lines)} with a recommended modulus, {np.mean(deviation < 1):.0%} within its error, "
          f"{np.mean(deviation < 2):.0%} within twice (of the population's median {np.mean(of_population < 1):.0%} and "
          f"{np.mean(of_population < 2):.0%}); mean error {mean['recommended']:+.2f} %, from deformation "
          f"{mean['deformation']:+.2f} %, by the outlines {mean['outlines']:+.2f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--program", type=Path, default=Path("build/rheocyte"))
    parser.add_argument("--masks", nargs="+", choices=MASKS, default=["coverage"])
    parser.add_argument("--tilts", nargs="+", type=float, default=[1.0])
    parser.add_argument("--recordings", type=int, default=40)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for masks in options.masks:
        for tilt in options.tilts:
            print(f"\nmasks by {masks}, tilt {tilt:g} degrees\n\n| recording | E (kPa) | d | recommended by | error (%) | by scatter | "
                  "common | from deformation | by outlines | beyond the stiff, soft end (%) |\n|" + 10 * "---|")
            lines = {}
            for k in range(options.first, options.first + options.recordings):
                file, truth, of_population = record(options.program, options.folder, s := setup(k), masks, tilt)
                lines[s] = judged(extract(options.program, file, s), truth, of_population)
                print_line(s, truth, lines[s])
            print()
            for kind in (*DEFORMATIONS, ""):
                print_coverage(kind or "all", [j for s, j in lines.items() if kind in s.kind])


if __name__ == "__main__":
    main()
