#!/usr/bin/env python3
"""Cells of a combined table between its branches against direct solutions.

    PYTHONPATH=build/python-tree bench/combined_cells.py [--table data/combined_HC-2D-NH-26.cbor] [--cells 24]

Random cells under an axial tension are interpolated in the table (build/combined_states) and solved with the same law of the
cortex and the same bending stiffness. Prints what the table's features differ by; the difference of ln c3 is nearly that of
ln S.
"""
import argparse
import math
import subprocess

import numpy as np

import rheocyte

LAW, BENDING_KBT = "neo-hookean", 3e4  # of examples/tables/combined-elongated.toml
GREATEST_DEFORMATION = 0.1
FEATURES = ["area_um2", "deformation", "moment_ratio"] + [f"mode_{k}" for k in range(2, 8)]


def random_cells(count):
    """Radius (um), stiffness S (kPa), fraction of the cortex, its tension over its modulus, tension of the liquid (Pa)."""
    random = np.random.default_rng(7)
    cells = []
    while len(cells) < count:
        stiffness = math.exp(random.uniform(math.log(0.2), math.log(2)))
        tension_Pa = 1e3 * stiffness * random.uniform(0, 1.6)
        cell = (random.uniform(4.6, 7.4), stiffness, random.uniform(0.05, 0.75), random.uniform(0.3, 0.9), tension_Pa)
        if tension_Pa < 400:
            cells.append(cell)
    return cells


def solved(radius, stiffness, fraction, ratio, tension_Pa):
    """Features, or None without a state."""
    cortex = fraction * stiffness * radius
    state = rheocyte.solve({
        "channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 6, "axial_tension_Pa": tension_Pa},
        "cell": {"radius_um": radius, "bulk": {"law": "neo-hookean", "young_modulus_kPa": (1 - fraction) * stiffness},
                 "cortex": {"law": LAW, "modulus_mN_per_m": cortex, "tension_mN_per_m": ratio * cortex, "bending_kBT": BENDING_KBT}},
        "numerics": {"accuracy": 1e-3}}).to_dict()
    if state["status"] != "converged":
        return None
    return np.array([math.log(state["area_um2"])] + [state[name] for name in FEATURES[1:]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", default="data/combined_HC-2D-NH-26.cbor")
    parser.add_argument("--states", default="build/combined_states")
    parser.add_argument("--cells", type=int, default=24)
    options = parser.parse_args()
    cells = random_cells(options.cells)
    lines = "\n".join(f"{r} {(1 - f) * s} {f * s * r} {g} {t}" for r, s, f, g, t in cells)
    told = subprocess.run([options.states, options.table], input=lines, text=True, capture_output=True, check=True).stdout
    differences = []
    for cell, line in zip(cells, told.splitlines()):
        if line == "none":
            continue
        table = np.array([float(x) for x in line.split()])
        direct = solved(*cell) if table[1] < GREATEST_DEFORMATION else None
        if direct is None:
            continue
        differences.append(np.append(table - direct, math.log(table[4] / direct[4])))
        print("r0 {:.2f} um, S {:.3f} kPa, cortex {:.2f}, tension {:.2f} E2D, T {:.0f} Pa: ".format(*cell)
              + f"d {direct[1]:.4f} ({differences[-1][1]:+.4f}), c2 {differences[-1][3]:+.4f}, ln c3 {differences[-1][-1]:+.4f}", flush=True)
    found = np.abs(differences)
    for name, column in zip(["ln area", *FEATURES[1:], "ln c3"], found.T):
        print(f"{name}: median {np.median(column):.2g}, 90 % below {np.quantile(column, 0.9):.2g}")


if __name__ == "__main__":
    main()
