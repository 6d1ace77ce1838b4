#!/usr/bin/env python3
"""A soft elastic cell with a cortex, carried along the axis of a tube by a power-law liquid: the stationary state.

    tube_cortex.py CASE.toml [--program build/rheocyte] [--sizes 2 1] [--start 8] [-v]

An independent program for cases of rheocyte (section "tube", neo-Hookean bulk, membranes "neo-hookean" and
"neo-hookean-reference"), with a comparison if rheocyte is given. Needs numpy, scipy and FreeFem++, which makes the triangles
(triangles.edp). Lengths are in radii R of the tube, speeds in the mean speed V, stresses in S = K (V/R)^n. All integrals are per
radian, with dA r for a volume.

Liquid, in the frame of the cell, round the present shape:  w = (u, v), D its symmetric gradient, Re = rho V^2/S,
    Int [(-p I + 2 eta D) : grad f + Re (w . grad w) . f] = 0,   Int q div w = 0,   eta = (2 D:D + 0.01^2)^((n-1)/2),
    w = 0 on the cell, -c at the wall, profile - c at the inlet; v = 0 at the outlet.
Bulk, Lagrangian, from the sphere X to x:  F = dx/dX with the hoop stretch r/r0,
    Int [mu F - p cof F] : df/dX = forces on the surface,   Int q (det F - 1) = 0.
Cortex, a meridian (x, r)(t) with t the angle on the sphere, t = 0 in front: s = |(x', r')|, stretches l1 = s/s0, l2 = r/r0,
    E = Int [f(l1, l2) + gamma + cb/8 k^2] r s dt,   k = (x' r'' - r' x'')/s^3 - x'/(s r),
    T1 = f + l1 df/dl1 and T2 = f + l2 df/dl2 as in `tensions`.
Axial tension: the traction T n_x e_x on the surface, whose work is T Int f_x r r' dt.

Bulk and liquid: P2/P1 (Taylor-Hood) on isoparametric triangles with common nodes on the surface. Cortex: the cubic spline through
these nodes, even (x) and odd (r) about the poles, so that bending needs no penalty. The force of the liquid on a node is its
momentum residual there. Unknown are the bulk's places and pressure, the liquid's w, p and places (Laplace's equation for the
displacement from the last mesh), and c; a vertex near the centre is held, as a shift changes nothing. Newton's method for all of
them at once; derivatives of the elements by the complex step. The way leads from a stiff sphere to the requested moduli, with a new
mesh of the liquid round each guess, a polynomial through the last states. Each further size has a new mesh of the cell, fine
where the meridian of the state before is bent, and the way goes on from there if it had not come to its end: soft cells with a
sharp rim need it (HL60 cells at 0.12 ul/s, d = 0.11: --start 20 --sizes 2 1.6 1.6 1 1).
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull
from tube_cortex_model import Model
from tube_cortex_parts import Case

LEAST_STEP = 0.004  # of the compliance; where it is not enough, a new mesh of the cell may be


# ---- What is compared ----
def measures(points):
    """Deformation and modes of a closed anticlockwise polygon."""
    a, b = points, np.roll(points, -1, axis=0)
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    area, perimeter = cross.sum() / 2, np.hypot(*(b - a).T).sum()
    centre = ((a + b) * cross[:, None]).sum(axis=0) / (6 * area)
    x, y = (fine(points) - centre).T
    theta = np.unwrap(np.arctan2(y, x))
    step, radius = np.diff(theta, append=theta[0] + 2 * math.pi), np.hypot(x, y)
    middle, between = theta + step / 2, (radius + np.roll(radius, -1)) / 2
    mean = (between * step).sum()
    modes = {f"c{k}": 2 * (between * np.cos(k * middle) * step).sum() / mean for k in range(2, 8)}
    return {"d": 1 - 2 * math.sqrt(math.pi * area) / perimeter} | modes


def fine(points):
    """Long sides cut into short ones."""
    sides = np.roll(points, -1, axis=0) - points
    lengths = np.hypot(*sides.T)
    parts = np.maximum(1, np.ceil(lengths / (lengths.sum() / 4000))).astype(int)
    return np.vstack([p + s * np.arange(n)[:, None] / n for p, s, n in zip(points, sides, parts)])


def results(model):
    half = model.meridian(np.linspace(0, math.pi, 6001))
    outline = np.vstack([half, half[-2:0:-1] * [1, -1]])
    hull = outline[ConvexHull(outline).vertices]
    found = measures(hull) | {k + "_raw": v for k, v in measures(outline).items()}
    rest = 4 / 3 * math.pi * (model.case.radius * model.case.R) ** 3
    return found | {"velocity": model.speed * model.case.V, "volume_error": model.volume() / rest - 1}


# ---- From the stiff sphere to the requested cell ----
def begin(model, start):
    """The sphere, under the pressure of its cortex, and the flow past it."""
    mu, cortex = model.case.stiffer(start)
    model.pressure = np.full(model.solid.nv, mu + 2 * cortex["tension"] / model.case.radius)


def follow(model, compliance, step, tell):
    """From a state in steps of the compliance 1/factor as far as possible; the mesh of the liquid is renewed at each state, and
    once more at the requested one. The compliance that was reached."""
    states = [(compliance, model.snapshot())] if compliance else []
    while compliance < 1:
        requested = min(1.0, compliance + step)
        before = model.snapshot()
        try:
            if len(states) > 1:
                model.extrapolate(states[-3:], requested)
            model.surround()
            model.newton(1 / requested)
        except ArithmeticError as problem:
            tell(f"  compliance {requested:.4f}: {problem}")
            model.set_snapshot(before)
            step = (requested - compliance) / 2
            if step < LEAST_STEP:
                return compliance
            continue
        tell(f"  compliance {requested:.4f}: " + brief(model))
        compliance, step = requested, min(1.5 * step, 0.2)
        states.append((compliance, model.snapshot()))
    model.surround()
    model.newton(1.0)
    tell("  new mesh: " + brief(model))
    return compliance


def brief(model):
    found = results(model)
    return ", ".join(f"{k} {found[k]:.5f}" for k in ("d", "d_raw", "c2", "c3", "velocity"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case")
    parser.add_argument("--sizes", type=float, nargs="+", default=[2.0, 1.0], help="sizes of elements, the first for the way")
    parser.add_argument("--start", type=float, default=8.0, help="stiffness of the first state over the requested one")
    parser.add_argument("--program", help="rheocyte, to compare with")
    parser.add_argument("--output", help="folder for the meridians")
    parser.add_argument("-v", action="store_true")
    options = parser.parse_args()
    started = time.process_time()

    def tell(text):
        if options.v:
            print(f"{time.process_time() - started:7.1f} s {text}", file=sys.stderr, flush=True)

    case, model, compliance = Case(options.case), None, 0.0
    with tempfile.TemporaryDirectory() as folder:
        for size in options.sizes:
            before, model = model, Model(case, size, folder, tell, model.turning() if model else None)
            if before is None:
                begin(model, options.start)
            else:
                model.copy_from(before)
                model.surround()
                model.newton(1 / compliance)
            if compliance < 1:
                compliance = follow(model, compliance, 4 * LEAST_STEP if before else 1 / options.start, tell)
            report(model, compliance, time.process_time() - started, options.output)
    if compliance < 1:
        sys.exit("The requested cell was not reached.")
    if options.program:
        compare(results(model), of_rheocyte(options.program, options.case))


NAMES = {"d": "deformation", "d_raw": "deformation_raw", "c2": "mode_2", "c3": "mode_3", "c2_raw": "mode_2_raw",
         "c3_raw": "mode_3_raw", "velocity": "cell_velocity_m_per_s"}


def of_rheocyte(program, case):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "solve", case, "-o", Path(folder, "result"), "--quiet", "--no-picture"], check=True,
                       stdout=subprocess.DEVNULL)
        return json.loads(Path(folder, "result", "result.json").read_text())


def compare(found, other):
    """A table in Markdown of this program's numbers, rheocyte's, and the differences."""
    rows = ["| | " + " | ".join(NAMES) + " |", "|---" * (1 + len(NAMES)) + "|"]
    ours, theirs = [found[name] for name in NAMES], [other[name] for name in NAMES.values()]
    for name, numbers in (("this program", ours), ("rheocyte", theirs), ("difference", [a - b for a, b in zip(ours, theirs)])):
        rows.append(f"| {name} | " + " | ".join(f"{number:.5f}" for number in numbers) + " |")
    print("\n".join(rows), flush=True)


def report(model, compliance, seconds, folder):
    found = {"size": model.size, "unknowns": int(model.unknowns), "seconds": round(seconds, 1), "compliance": compliance}
    print(json.dumps(found | results(model)), flush=True)
    if folder:
        Path(folder).mkdir(parents=True, exist_ok=True)
        np.savetxt(Path(folder, f"meridian_{model.size:g}.csv"), model.meridian(model.t) * model.case.R * 1e6, delimiter=",")


if __name__ == "__main__":
    main()
