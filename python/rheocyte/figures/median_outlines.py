"""Median outlines of recordings against those of the cells that `rheocyte moduli` fits to them, for figure real-cells."""

import json
import subprocess
from pathlib import Path

import numpy as np

from rheocyte.figures import style
from rheocyte.files import InputError

ANGLES = np.linspace(0, 2 * np.pi, 361)
PER_ROW = 4


def median_cells(laboratory):
    """{name of the result: median cell of its _moduli.json}, of the recordings that have outlines."""
    folder = Path(laboratory.folder) / "real-cells"
    for former in folder.glob("*_moduli.json"):
        former.unlink()
    call = [laboratory.program, "moduli", "--quiet", "--table", laboratory.table, "-o", folder, *laboratory.recordings,
            *laboratory.options]
    ended = subprocess.run(list(map(str, call)), capture_output=True, text=True, check=False)
    said = ended.stderr.strip().splitlines()
    for line in said:
        laboratory.tell(line)
    read = {written.stem.removesuffix("_moduli"): json.loads(written.read_text(encoding="utf-8"))["median_cell"]
            for written in sorted(folder.glob("*_moduli.json"))}
    cells = {name: cell for name, cell in read.items() if cell}
    if not cells:
        raise InputError(said[-1].removeprefix("rheocyte: ") if said else "none of the recordings has outlines.")
    return cells


def outline(cell, kind):
    """Points (x, y) in um of the outline with the `measured` or the `fitted` area and modes, downstream to the right."""
    values = {feature["name"]: feature[kind] for feature in cell["features"]}
    shape = 1 + sum(value * np.cos(int(name[1:]) * ANGLES) for name, value in values.items() if name[1:].isdecimal())
    # The area is half the integral of r^2.
    radius = shape * np.sqrt(values["area_um2"] / (np.pi * np.mean(shape[:-1] ** 2)))
    return radius * np.cos(ANGLES), radius * np.sin(ANGLES)


def rows_of(count):
    """Rows of panels that so many outlines take."""
    return -(-count // PER_ROW)


def draw(figure, cells):
    """Measured outlines, filled, and fitted ones as lines, to one scale."""
    panels = list(figure.subplots(rows_of(len(cells)), PER_ROW, squeeze=False, sharex=True, sharey=True).flat)
    for axes in panels:
        axes.set_axis_off()
        axes.set_aspect("equal")
    for letter, axes, (name, cell) in zip("cdefghijklmnopqrstuvwxyz", panels, cells.items()):
        axes.fill(*outline(cell, "measured"), color="#d5d9dd", linewidth=0)
        known = cell["status"] != "no-data"
        text = "no cell of the table has this outline"
        if known:
            axes.plot(*outline(cell, "fitted"), color=style.LINEAR, linewidth=1)
            text = (f"E {cell['young_modulus_kPa']:.2g} kPa, E2D {cell['cortex_modulus_mN_per_m']:.2g} mN/m\n"
                    f"T {cell['axial_tension_Pa']:.0f} ± {cell['axial_tension_Pa_error']:.0f} Pa\n"
                    f"χ² {cell['chi_squared']:.2g} at {cell['degrees_of_freedom']}"
                    + {"poor-fit": ": a poor fit", "outside-table": ", beyond the table"}.get(cell["status"], "")
                    + ("\nat the end of the table" if cell["at_end_of_table"] else ""))
        axes.set_title(f"{letter}   {name[:24]}\n{cell['cells']} cells", fontsize=6, loc="left")
        axes.text(0.5, -0.02, text, fontsize=5.5, ha="center", va="top", transform=axes.transAxes)
