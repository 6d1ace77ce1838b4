#!/usr/bin/env python3
"""Cells as soft as real ones: at which moduli they reach given deformations.

HL60 cells in CellCarrier in a channel of 20 um: 0.096 kPa, 1.139 mN/m, a tension of 0.615 E2D, 6.5 um, an axial tension
of 192 Pa at 0.04 ul/s that goes with the stress at the wall. All moduli are multiplied by s, which is sought for the
deformations of real cells (medians less what pixels add): 0.063 at 0.04 ul/s, 0.092 at 0.08, 0.119 at 0.12.

    python3 bench/soft_cells.py build/rheocyte [--section square] [--law skalak] [--bending 1e4] [--accuracy 1e-2]

With --random 300: cells of any size, law, bending, tension and medium, at deformations from 0.08 to 0.2, or at the ends of
their branches. --limit 120: solves of more seconds of processor time are stopped and listed as "too-long". --keep FOLDER
keeps the case of every solve.
"""

import argparse
import collections
import json
import math
import pathlib
import random
import resource
import signal
import subprocess
import tempfile

CASE = """
[channel]
width_um = {width}
section = "{section}"
[flow]
rate_ul_per_s = {rate}
{medium}
axial_tension_Pa = {tension}
[cell]
radius_um = {radius}
[cell.bulk]
law = "neo-hookean"
young_modulus_kPa = {young}
[cell.cortex]
law = "{law}"
modulus_mN_per_m = {modulus}
tension_ratio = {ratio}
bending_kBT = {bending}
[numerics]
accuracy = {accuracy}
"""
TARGETS = {0.04: 0.063, 0.08: 0.092, 0.12: 0.119}
MEDIA = {"newtonian": 'viscosity_mPas = 6.0', "0.49 %": 'law = "power-law"\nconsistency_Pa_sn = 0.2079\nexponent = 0.6548',
         "0.59 %": 'law = "power-law"\nconsistency_Pa_sn = 0.5153\nexponent = 0.5860',
         "0.83 %": 'law = "power-law"\nconsistency_Pa_sn = 1.4936\nexponent = 0.5149'}
LAWS = ["neo-hookean", "neo-hookean-reference", "skalak", "linear", "thin-shell"]


def hl60(options, rate, s):
    """Settings of the HL60 cell with its moduli multiplied by s."""
    return {"section": options.section, "width": 20.0, "rate": rate, "medium": MEDIA["0.49 %"], "accuracy": options.accuracy,
            "tension": 192 * (rate / 0.04) ** 0.6548, "radius": 6.5, "young": 0.096 * s, "law": options.law,
            "modulus": 1.139 * s, "ratio": 0.615, "bending": options.bending}


def wall_stress(settings):
    """About, in Pa, of a tube with the pressure drop of the square."""
    radius, rate = 0.547e-6 * settings["width"], settings["rate"] * 1e-9
    shear = 4 * rate / (3.14159 * radius**3)
    numbers = {k.split(" = ")[0]: k.split(" = ")[1] for k in settings["medium"].split("\n")}
    if "viscosity_mPas" in numbers:
        return 1e-3 * float(numbers["viscosity_mPas"]) * shear
    return float(numbers["consistency_Pa_sn"]) * shear ** float(numbers["exponent"])


def random_cell(draw, options):
    """A cell of any law in any medium; its stiffness is that of the stress at the wall."""
    width = draw.choice([20.0, 30.0])
    settings = {"section": options.section, "width": width, "medium": draw.choice(list(MEDIA.values())),
                "rate": draw.uniform(0.04, 0.16) if width == 20 else draw.uniform(0.16, 0.32),
                "radius": draw.uniform(0.35, 0.9) * 0.547 * width, "law": draw.choice(LAWS), "accuracy": options.accuracy,
                "ratio": draw.uniform(0.0, 1.2), "bending": draw.choice([0, 10 ** draw.uniform(3, 4.5)])}
    stress, fraction = wall_stress(settings), draw.choice([0, draw.uniform(0.1, 0.9), 0.35])
    settings["tension"] = draw.uniform(0, 2.5) * stress * 0.6
    settings["young"] = 1e-3 * stress * max(fraction, 0.02)
    settings["modulus"] = 1e-3 * stress * (1 - fraction) * settings["radius"]
    return settings


def softer(settings, s):
    return settings | {"young": settings["young"] * s, "modulus": settings["modulus"] * s}


def solved(options, settings, name=""):
    """The numbers of the state and the seconds of processor time; no numbers but the status if it took too long."""
    limit = math.ceil(options.limit)
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(options.keep or folder) / f"case{name}.toml"
        case.write_text(CASE.format(**settings))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        run = subprocess.run([options.program, "solve", case, "-o", pathlib.Path(folder) / "result"], capture_output=True,
                             text=True, check=False,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if run.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return {"status": "too-long"}, seconds
        result = pathlib.Path(folder) / "result" / "result.json"
        if not result.exists():
            raise RuntimeError(run.stderr)
        return json.loads(result.read_text()), seconds


def row(state, seconds):
    if state["status"] == "too-long":
        return f"- - too-long {seconds:.1f}"
    modes = " ".join(f"{state[f'mode_{k}']:.4f}" for k in range(2, 8))
    error = state["estimated_error"]
    return (f"{state['deformation']:.5f} {'-' if error is None else f'{error:.1e}'} {state['status']} {seconds:.1f} "
            f"{state['stability_margin']:.3f} {modes}")


def find_hl60(options):
    """The factors of the moduli at which the cell reaches the deformations of real cells."""
    print("rate s d error status seconds margin " + " ".join(f"c{k}" for k in range(2, 8)), flush=True)
    s = 1.0
    for rate, target in TARGETS.items():
        found = []  # (ln s, ln d) of states
        lost = None  # the stiffest cell without a state
        for _ in range(8):
            state, seconds = solved(options, hl60(options, rate, s))
            print(f"{rate} {s:.4f} {row(state, seconds)}", flush=True)
            d = state.get("deformation")
            if state["status"] == "converged":
                if abs(d / target - 1) < 0.01:
                    break
                found.append((math.log(s), math.log(d)))
            else:
                lost = s
            if not found:
                s *= 1.15
                continue
            found.sort(key=lambda point: abs(point[1] - math.log(target)))
            slope = (found[1][1] - found[0][1]) / (found[1][0] - found[0][0]) if len(found) > 1 else -1.0
            s = math.exp(found[0][0] + (math.log(target) - found[0][1]) / slope)
            if lost and s <= lost:
                s = math.sqrt(lost * math.exp(min(found)[0]))


def find_random(options):
    """Random cells at deformations from 0.08 to 0.2, or at the end of their branches."""
    draw, ends = random.Random(options.seed), collections.Counter()
    print("cell law bending radius/R s d error status seconds margin " + " ".join(f"c{k}" for k in range(2, 8)), flush=True)
    for i in range(options.random):
        settings, aim, s = random_cell(draw, options), draw.uniform(0.08, 0.2), 1.0
        for attempt in range(6):
            state, seconds = solved(options, softer(settings, s), f"_{i}_{attempt}")
            size = settings["radius"] / (0.547 * settings["width"])
            print(f"{i} {settings['law']} {settings['bending']:.0f} {size:.2f} {s:.4f} {row(state, seconds)}", flush=True)
            if state["status"] != "converged" or abs(state["deformation"] / aim - 1) < 0.1:
                break
            s *= min(max((state["deformation"] / aim) ** 0.8, 0.3), 2)
        ends[state["status"]] += 1
    print(", ".join(f"{status}: {count}" for status, count in ends.most_common()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--section", default="tube")
    parser.add_argument("--law", default="neo-hookean")
    parser.add_argument("--bending", type=float, default=1e4)
    parser.add_argument("--accuracy", type=float, default=1e-2)
    parser.add_argument("--random", type=int, default=0, help="so many random cells instead")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=600, help="seconds of processor time of one solve")
    parser.add_argument("--keep", default="", help="folder that keeps the cases")
    options = parser.parse_args()
    find_random(options) if options.random > 0 else find_hl60(options)


if __name__ == "__main__":
    main()
