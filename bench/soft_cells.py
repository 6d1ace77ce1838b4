#!/usr/bin/env python3
"""Cells as soft as real ones: at which moduli they reach given deformations.

HL60 cells in CellCarrier in a channel of 20 um: 0.096 kPa, 1.139 mN/m, a tension of 0.615 E2D, 6.5 um, an axial tension
of 192 Pa at 0.04 ul/s that goes with the stress at the wall. All moduli are multiplied by s, which is sought for the
deformations of real cells (medians less what pixels add): 0.063 at 0.04 ul/s, 0.092 at 0.08, 0.119 at 0.12.

    python3 bench/soft_cells.py build/rheocyte [--section square] [--law skalak] [--bending 1e4] [--accuracy 1e-2]
"""

import argparse
import json
import pathlib
import resource
import subprocess
import tempfile

CASE = """
[channel]
width_um = 20.0
section = "{section}"
[flow]
rate_ul_per_s = {rate}
law = "power-law"
consistency_Pa_sn = 0.2079
exponent = 0.6548
axial_tension_Pa = {tension}
[cell]
radius_um = 6.5
[cell.bulk]
law = "neo-hookean"
young_modulus_kPa = {young}
[cell.cortex]
law = "{law}"
modulus_mN_per_m = {modulus}
tension_ratio = 0.615
bending_kBT = {bending}
[numerics]
accuracy = {accuracy}
"""
TARGETS = {0.04: 0.063, 0.08: 0.092, 0.12: 0.119}


def solved(program, options, rate, s, folder):
    case = folder / "case.toml"
    case.write_text(CASE.format(section=options.section, rate=rate, tension=192 * (rate / 0.04) ** 0.6548,
                                young=0.096 * s, law=options.law, modulus=1.139 * s, bending=options.bending,
                                accuracy=options.accuracy))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "solve", case, "-o", folder / "result"], capture_output=True, check=False)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return json.loads((folder / "result" / "result.json").read_text()), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--section", default="tube")
    parser.add_argument("--law", default="neo-hookean")
    parser.add_argument("--bending", type=float, default=1e4)
    parser.add_argument("--accuracy", type=float, default=1e-2)
    options = parser.parse_args()
    print("rate s d error status seconds " + " ".join(f"c{k}" for k in range(2, 8)), flush=True)
    for rate, target in TARGETS.items():
        s, stiff, soft = 1.0, None, None  # moduli between which the deformation is passed
        for _ in range(8):
            with tempfile.TemporaryDirectory() as folder:
                state, seconds = solved(options.program, options, rate, s, pathlib.Path(folder))
            d = state["deformation"]
            modes = " ".join(f"{state[f'mode_{k}']:.4f}" for k in range(2, 8))
            print(f"{rate} {s:.4f} {d:.5f} {state.get('estimated_error', float('nan'))} {state['status']} {seconds:.1f} {modes}",
                  flush=True)
            if state["status"] == "converged" and abs(d / target - 1) < 0.01:
                break
            if state["status"] != "converged" or d > target:
                soft = s
            else:
                stiff = s
            if stiff and soft:
                s = (stiff * soft) ** 0.5
            else:
                s *= (d / target) ** 0.8 if state["status"] == "converged" else 1.2


if __name__ == "__main__":
    main()
