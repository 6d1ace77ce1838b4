"""Sentences that commands print on small recordings: made by calls of the program, without their numbers."""
import re
import subprocess
import tempfile
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent / "examples/recordings"
SPECS = Path(__file__).resolve().parent.parent / "tests/app"
# A number that belongs to no name such as c3, E2D or HL60.
HASH = re.compile(r"(hash) [0-9a-f]{16}\b")
NUMBER = re.compile(r"(?<![\w.])(?<!\w-)[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w)")
CELLS = """[recording]
cells = 120
[channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
axial_tension_Pa = {mean = 500, sd = 100}
[cell]
radius_um = {mean = 6.3, sd = 0.4}
[cell.bulk]
young_modulus_kPa = {mean = 4, sd = 0.6, distribution = "lognormal"}
[shapes]
table = "HE-3D-el-26"
"""
# How each recording is made: its spec and settings.
STIFFER = "cell.bulk.young_modulus_kPa.mean=5.2"
RECORDINGS = {
    "solid.rtdc": ("virtual-cells.toml", "recording.cells=120"),
    "few.rtdc": ("virtual-cells.toml", "recording.cells=5"),
    "cortex.rtdc": ("combined-cells.toml", "recording.cells=150"),
    "control-1.rtdc": ("cells.toml",),
    "control-2.rtdc": ("cells.toml", "recording.seed=2"),
    "drug-1.rtdc": ("cells.toml", "recording.seed=3", STIFFER),
    "drug-2.rtdc": ("cells.toml", "recording.seed=4", STIFFER),
    "soft.rtdc": ("cells.toml", "cell.bulk.young_modulus_kPa.mean=1.2"),
    "places.rtdc": ("cells-at-places.toml", "recording.cells=60"),
}
CONDITIONS = "--condition control=control-1.rtdc,control-2.rtdc --condition drug=drug-1.rtdc,drug-2.rtdc"
# {name of the file: calls whose sentences it contains}
CALLS = {
    "extract": ("extract solid.rtdc -o results", "extract cortex.rtdc -o results", "extract few.rtdc -o results",
                "extract soft.rtdc -o results", "extract solid.rtdc --min area_um=60 --section tube -o results",
                "extract solid.rtdc --viscosity-mPas 0.015 -o results", "extract solid.rtdc --temperature 5 -o results",
                "extract solid.rtdc --medium honey -o results", "extract solid.rtdc --min deform=0.9 -o results",
                "extract absent.rtdc -o results", "extract solid.rtdc --min area -o results"),
    "moduli": ("moduli cortex.rtdc -o results", "moduli solid.rtdc -o results", "moduli few.rtdc -o results",
               "moduli cortex.rtdc --axial-tension-Pa 250 --outline-noise-um 0.02 -o results"),
    "population": (f"population {CONDITIONS} --no-picture -o unpaired",
                   f"population {CONDITIONS} --paired --dose drug=0.05 --no-picture -o paired",
                   "population --condition one=control-1.rtdc --condition two=drug-1.rtdc --no-picture -o single",
                   "population --condition stiff=solid.rtdc --no-picture -o stiff",
                   "population --condition soft=soft.rtdc --no-picture -o soft",
                   "population --model cortex --condition cells=cortex.rtdc --no-picture -o cortex",
                   "population --model effective --condition cells=cortex.rtdc --no-picture -o effective",
                   "population --condition cells=few.rtdc --no-picture -o few", "population",
                   f"population {CONDITIONS} --by asymmetry --model effective -o both"),
    "plan": ("plan --radius-um 6.3 --young-modulus-kPa 4 -o plan.tsv",
             "plan --radius-um 6.3 --young-modulus-kPa 4 --difference 0",
             "plan --radius-um 1 --young-modulus-kPa 4", "plan --radius-um 6.3 --young-modulus-kPa 500",
             "plan --radius-um 6.3 --young-modulus-kPa 4 --medium honey", "plan --radius-um 6.3"),
    "time-course": ("time-course places.rtdc --contraction-um 0 -o course.tsv",
                    "time-course solid.rtdc --contraction-um 0 -o course.tsv",
                    "time-course places.rtdc --contraction-um 5000 -o course.tsv"),
}


def without_numbers(text):
    """Each number and hash as #, and one blank in place of several, whose number depends on the digits."""
    return re.sub(r"(?<=\S) +", " ", NUMBER.sub("#", HASH.sub(r"\1 #", text)))


def _printed(program, call, folder):
    ended = subprocess.run([program, *call], cwd=folder, capture_output=True, text=True, check=False)
    text = without_numbers(ended.stdout + ended.stderr).replace(str(folder), "FOLDER")
    return "".join(line.rstrip() + "\n" for line in text.splitlines())


def _make_recordings(program, folder):
    (folder / "cells.toml").write_text(CELLS, encoding="utf-8")
    for name, (spec, *settings) in RECORDINGS.items():
        place = next(place / spec for place in (folder, EXAMPLES, SPECS) if (place / spec).exists())
        changes = [part for setting in settings for part in ("--set", setting)]
        subprocess.run([program, "synth", place, "-o", name, "--quiet", *changes], cwd=folder, check=True)


def all_sentences(program):
    """{name: calls and what each prints}."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        _make_recordings(program, folder)
        return {name: "\n".join(f"$ rheocyte {call}\n{_printed(program, call.split(), folder)}" for call in calls)
                for name, calls in CALLS.items()}
