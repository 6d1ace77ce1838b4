#!/usr/bin/env python3
"""Does the tension that elongates cells vary over their surface, or relax on their way? What sizes and places of cells say.

    studies/tension_over_surface.py [HL60.rtdc]

The cell of the model that has the shape of HL60 cells (docs/real-cells.md) is solved at several sizes under one even
tension. One that went as a power of the local shear rate would elongate it as its mean over the surface does, weighted as
the work of an even tension is, x n_x dA. Prints how c2 changes with the area for each; with the recording (of
bench/hl60_recording.py) what the cells have, and how their c2 changes downstream. Needs h5py for the recording.
"""
import math
import sys

import numpy as np

import rheocyte

WIDTH_UM, RATE_UL_S, VISCOSITY_MPAS, TENSION_PA = 20.0, 0.04, 6.0, 242.0
CELL = {"bulk": {"law": "neo-hookean", "young_modulus_kPa": 0.158},
        "cortex": {"law": "neo-hookean-reference", "modulus_mN_per_m": 1.9, "tension_mN_per_m": 0.544,
                   "bending_kBT": 3e4}}
RADII_UM = (5.2, 5.8, 6.3, 6.8, 7.2)
MEAN_AREA_UM2, AREAS_UM2 = 142, (90, 190)


def wall_stress_Pa():
    radius = 0.547 * WIDTH_UM * 1e-6
    return 4 * VISCOSITY_MPAS * 1e-3 * RATE_UL_S * 1e-9 / (math.pi * radius**3)


def solved(radius_um):
    return rheocyte.solve({"channel": {"width_um": WIDTH_UM}, "numerics": {"accuracy": 2e-3},
                           "flow": {"rate_ul_per_s": RATE_UL_S, "viscosity_mPas": VISCOSITY_MPAS,
                                    "axial_tension_Pa": TENSION_PA},
                           "cell": {"radius_um": radius_um} | CELL}, check=True)


def shear_at_surface(state):
    """Shear stress of the liquid at the points of the contour, over that at the wall: that of the nearest node."""
    fields, x, r = state.fields(), state.surface["x_um"], state.surface["r_um"]
    in_liquid = np.asarray(fields.data["region"]) == 0
    nodes, shear = np.asarray(fields.points)[in_liquid, :2], np.asarray(fields.data["shear_stress"])[in_liquid]
    distance = np.hypot(x[:, None] - nodes[:, 0], r[:, None] - nodes[:, 1])
    return shear[distance.argmin(axis=1)] / wall_stress_Pa()


def mean_by_work(state, values):
    """Over the surface, weighted with x n_x dA."""
    x, r = state.surface["x_um"], state.surface["r_um"]
    middle = lambda v: (v[1:] + v[:-1]) / 2
    axis = np.sum(middle(x) * middle(r) ** 2 * np.diff(x)) / np.sum(middle(r) ** 2 * np.diff(x))
    work = (middle(x) - axis) * middle(r) * np.diff(r)
    return np.sum(middle(values) * work) / np.sum(work)


def slope(over, values):
    return np.polyfit(over, values, 1)[0]


def model():
    states = [solved(radius) for radius in RADII_UM]
    sizes = np.log([state.to_dict()["area_um2"] for state in states])
    mode_2 = np.array([state.to_dict()["mode_2"] for state in states])
    print(f"even tension: d c2 / d ln A = {slope(sizes, mode_2):.3f}")
    for power in (1, 2):
        tension = [mean_by_work(state, shear_at_surface(state) ** power) for state in states]
        growth = slope(sizes, np.log(tension))
        print(f"tension as (shear rate)^{power}: mean {tension[2]:.3f} of that at the wall's, "
              f"grows as A^{growth:.2f}: d c2 / d ln A = {slope(sizes, mode_2) + growth * mode_2.mean():.3f}")


def mode_2_of(outline):
    """c2 and area of an outline's convex hull."""
    from scipy.spatial import ConvexHull
    hull = outline[ConvexHull(outline).vertices]
    after = np.roll(hull, -1, axis=0)
    cross = hull[:, 0] * after[:, 1] - after[:, 0] * hull[:, 1]
    centre = ((hull + after) * cross[:, None]).sum(axis=0) / (3 * cross.sum())
    points = np.concatenate([np.linspace(a, b, 40, endpoint=False) for a, b in zip(hull, after)]) - centre
    angle, radius = np.arctan2(points[:, 1], points[:, 0]), np.hypot(*points.T)
    even = np.linspace(-np.pi, np.pi, 720, endpoint=False)
    order = angle.argsort()
    r = np.interp(even, angle[order], radius[order], period=2 * np.pi)
    return 2 * np.mean(r * np.cos(2 * even)) / r.mean(), cross.sum() / 2


def recorded(file):
    import h5py
    with h5py.File(file) as recording:
        events, pixel = recording["events"], recording.attrs["imaging:pixel size"]
        outlines = [np.array(events["contour"][str(i)], float) * pixel for i in range(len(events["contour"]))]
        place = np.array(events["pos_x"])
    mode_2, area = np.array([mode_2_of(outline) for outline in outlines]).T
    taken = (area > AREAS_UM2[0]) & (area < AREAS_UM2[1])
    columns = np.stack([np.ones(taken.sum()), np.log(area[taken] / MEAN_AREA_UM2), place[taken] - place.mean()], axis=1)
    fitted = np.linalg.lstsq(columns, mode_2[taken], rcond=None)[0]
    left = mode_2[taken] - columns @ fitted
    error = np.sqrt(np.diag(np.linalg.inv(columns.T @ columns)) * left.var())
    print(f"{taken.sum()} cells: c2 {fitted[0]:.3f} at {MEAN_AREA_UM2} um2, d c2 / d ln A = {fitted[1]:.3f} +- {error[1]:.3f}, "
          f"d c2 / d pos_x = {fitted[2]:.1e} +- {error[2]:.1e} per um")


if __name__ == "__main__":
    model()
    if len(sys.argv) > 1:
        recorded(sys.argv[1])
