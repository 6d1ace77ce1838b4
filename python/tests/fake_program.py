"""Answers like the program, at once and with invented numbers. The environment says what goes wrong:

FAKE_LOG is a file that gets a line for each solved case, FAKE_FAILS a word in the names of cases that do not converge,
FAKE_SLEEPS the seconds that each case takes, FAKE_VERSION the version.
"""

import json
import math
import os
import re
import sys
import time
from pathlib import Path

VERSION = os.environ.get("FAKE_VERSION", "1")


def numbers(text):
    """All keys of a case with a number as value, without their sections."""
    return {key: float(value) for key, value in re.findall(r"^(\w+) = ([-+.\deE]+)$", text, re.M)}


def write_contour(path, radius):
    """An ellipse that is 10 % longer than the sphere."""
    points = [(1.1 * radius * math.cos(k * math.pi / 90), radius * math.sin(k * math.pi / 90)) for k in range(91)]
    Path(path).write_text("x_um,r_um\n" + "".join(f"{x},{abs(r)}\n" for x, r in points))


def shape(case):
    """An area that is not quite proportional to the square of the radius, and a deformation that bending lowers."""
    return {"deformation": 0.05 - 1e-8 * case.get("bending_kBT", 0), "deformation_raw": 0.06,
            "area_um2": 3.3 * case["radius_um"] ** 2.1, "area_raw_um2": 100.0,
            "reynolds": 1.2e-4 * case.get("density_kg_per_m3", 0)}


def solve(arguments):
    """rheocyte solve CASE --check --json | -o DIR --quiet --no-picture"""
    file = Path(arguments[0])
    text = file.read_text()
    identity = {"program": "rheocyte", "version": VERSION, "case_hash": str(sum(map(ord, text))) + text[-20:]}
    if "--check" in arguments:
        print(json.dumps(identity))
        return 0
    time.sleep(float(os.environ.get("FAKE_SLEEPS", "0")))
    with open(os.environ["FAKE_LOG"], "a") as log:
        log.write(file.stem + "\n")
    folder = Path(arguments[arguments.index("-o") + 1])
    folder.mkdir(exist_ok=True)
    # The channel's radius stands first in the file, the cell's last.
    case = numbers(text)
    failed = os.environ.get("FAKE_FAILS", "\0") in file.stem
    status = {"status": "surface-unstable", "message": "the surface wrinkles"} if failed else {"status": "converged"}
    write_contour(folder / "contour.csv", case["radius_um"])
    # Whole or not at all, like the program's own.
    (folder / "part").write_text(json.dumps(identity | status | shape(case)))
    (folder / "part").rename(folder / "result.json")
    return 3 if failed else 0


def analytic(arguments):
    """rheocyte analytic cell ... --json -o FILE"""
    radius = float(arguments[arguments.index("--radius-um") + 1])
    if "-o" in arguments:
        write_contour(arguments[arguments.index("-o") + 1], 0.98 * radius)
    area = math.pi * radius**2
    print(json.dumps({"deformation": 0.04, "deformation_raw": 0.04, "area_um2": area, "area_raw_um2": area,
                      "moment_ratio": 0.9}))
    return 0


def table_rows():
    """Rows of a table: twelve radii, d = 0.02 r^2 / E^2, and the last row is the end of the branch."""
    for radius in (3.5 + 0.5 * k for k in range(12)):
        for step in range(60):
            modulus, end = 100 * 0.9**step, step == 59
            deformation = 0.02 * radius**2 / modulus**2
            yield (f"{radius},{modulus},{deformation},{math.pi * radius**2 * (1 + deformation)},"
                   f"{1 - 2 * deformation},{int(end)}\n")


def table(arguments):
    """rheocyte table SPEC -o DIR --levels ... --no-picture -j N"""
    file = Path(arguments[0])
    folder = Path(arguments[arguments.index("-o") + 1])
    if os.environ.get("FAKE_REFUSES", "\0") in file.stem:
        print("rheocyte: contains a table that was begun as another", file=sys.stderr)
        return 2
    print("12 of 12 radii, 3 s elapsed", file=sys.stderr)
    with open(os.environ["FAKE_LOG"], "a") as log:
        log.write(file.stem + "\n")
    if os.environ.get("FAKE_FAILS", "\0") in file.stem:
        print("rheocyte: a worker has ended", file=sys.stderr)
        return 1
    folder.mkdir(exist_ok=True)
    stiffness = "cortex_modulus_mN_per_m" if "shell" in file.stem else "young_modulus_kPa"
    header = f"radius_um,{stiffness},deformation,area_um2,moment_ratio,end_of_branch\n"
    (folder / f"table_{file.stem}.csv").write_text(header + "".join(table_rows()))
    print("720 states on 12 branches, 100 solves, 5 s of one processor\n  folder")
    return 0


if __name__ == "__main__":
    sys.exit({"solve": solve, "analytic": analytic, "table": table}[sys.argv[1]](sys.argv[2:]))
