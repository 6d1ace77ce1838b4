"""E and E2D from images: of virtual cells one by one, and as a population."""

import csv
import json
from pathlib import Path

import numpy as np

from rheocyte import population_picture
from rheocyte.figures import style
from rheocyte.figures.cases import make_folder
from rheocyte.files import InputError, write_text

CELLS, SINGLE = 500, 40  # of the recording, and how many of them are drawn
NAMES = ["young_modulus_kPa", "young_modulus_kPa_error", "cortex_modulus_mN_per_m", "cortex_modulus_mN_per_m_error"]
TOLD = ("resolved", "not-told-apart")
YOUNG_KPA, CORTEX_MN_PER_M = 2.0, 9.6  # medians of the virtual cells
SPEC = f"""# Virtual cells of figure 9
[recording]
cells = {CELLS}
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
axial_tension_Pa = 250
[cell]
kind = "combined"
radius_um = {{mean = 6.5, sd = 0.4}}
[cell.bulk]
young_modulus_kPa = {{mean = {1.02 * YOUNG_KPA:g}, sd = {0.2 * YOUNG_KPA:g}, distribution = "lognormal"}}
[cell.cortex]
modulus_mN_per_m = {{mean = {1.02 * CORTEX_MN_PER_M:g}, sd = {0.2 * CORTEX_MN_PER_M:g}, distribution = "lognormal"}}
tension_ratio = 0.3
"""


def measured(laboratory):
    """(moduli of single cells with their standard errors, population.json) of one virtual recording."""
    folder = Path(laboratory.folder) / "bulk-and-cortex"
    make_folder(folder)
    write_text(folder / "cells.toml", SPEC)
    recording = folder / "cells.rtdc"
    call(laboratory, "synth", folder / "cells.toml", "-o", recording, "--force", "--quiet")
    call(laboratory, "moduli", recording, "-o", folder, "--quiet")
    call(laboratory, "population", "--model", "cortex", "--condition", f"cells={recording}", "-o", folder, "--no-picture", "--quiet")
    found = json.loads((folder / "population.json").read_text(encoding="utf-8"))
    lines = (folder / "cells_moduli.tsv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader((line for line in lines if not line.startswith("#")), delimiter="\t"))
    return [row for row in rows if row["status"] in TOLD], found["conditions"][0]


def call(laboratory, *arguments):
    """One command of the program; its last sentence if it fails."""
    ended = laboratory.call(*arguments)
    if ended.returncode != 0:
        raise InputError(ended.stderr.strip().splitlines()[-1] if ended.stderr.strip() else f"{arguments[0]} failed.")
    for line in ended.stderr.splitlines():
        laboratory.tell(line)


def draw(axes, rows, population):
    """Moduli of single cells with their errors, faint; the population's medians with their intervals, and the truth."""
    single = np.array([[float(row[name]) for name in NAMES] for row in rows[:SINGLE]])
    axes.errorbar(single[:, 0], single[:, 2], single[:, 3], single[:, 1], fmt="o", markersize=2, color="#9aa3ab", elinewidth=0.4,
                  label=f"single cells, by one image each ({len(single)} of them)", zorder=1)
    young, cortex = (population_picture.interval_of(population, name) for name in ("young_modulus_median_kPa", "cortex_modulus_median_mN_per_m"))
    ends = [[[value - low], [high - value]] for value, low, high in (young, cortex)]
    axes.errorbar([young[0]], [cortex[0]], ends[1], ends[0], fmt="D", markersize=4, color=style.LINEAR, elinewidth=1.4,
                  label=f"the population of {CELLS} cells, 95 %", zorder=3)
    axes.plot([YOUNG_KPA], [CORTEX_MN_PER_M], "+", markersize=8, color=style.NEO_HOOKEAN, label="true medians", zorder=4)
    axes.set(xlabel="$E$ (kPa)", ylabel="$E_{2D}$ (mN/m)", xlim=(0, 3 * YOUNG_KPA), ylim=(0, 3 * CORTEX_MN_PER_M))
    axes.legend(frameon=False, fontsize=6, loc="upper right")
