"""Tables behind the lines of a figure: computed by `rheocyte table`, kept in the folder `tables`, read by branches."""

import os
import subprocess
from dataclasses import dataclass

import numpy as np

from rheocyte.figures.cases import USER_ERROR, Solution, last_line, make_folder, stop, toml
from rheocyte.files import InputError, number, read_table, reason, write_text

STIFFNESSES = ["young_modulus_kPa", "cortex_modulus_mN_per_m"]
MEASURES = ["deformation", "area_um2", "moment_ratio"]
HAIR = 1e-9  # relative; the end of a branch belongs to it


@dataclass
class Branch:
    """States of one radius at rest, from the stiffest to the softest."""

    radius_um: float
    modulus: np.ndarray
    measures: dict  # name -> values
    ended: bool  # the last state is the end of the smooth branch

    def reaches(self, modulus):
        return self.modulus[-1] * (1 - HAIR) <= modulus <= self.modulus[0] * (1 + HAIR)

    def at(self, modulus):
        """Measures at moduli, nan where the branch has none. The rows are dense; d is a power of the modulus nearly."""
        place, known = np.log(modulus), np.log(self.modulus[::-1])
        outside = {"left": np.nan, "right": np.nan}
        values = {name: np.interp(place, known, values[::-1], **outside) for name, values in self.measures.items()}
        logarithm = np.log(self.measures["deformation"][::-1])
        return values | {"deformation": np.exp(np.interp(place, known, logarithm, **outside))}


def branches(laboratory, name, spec, moduli):
    """The branches of a table, computed if it is not there; none after a failure, which the laboratory keeps."""
    folder = laboratory.folder.with_name("tables") / name
    make_folder(folder.parent)
    file = folder.parent / f"{name}.toml"
    write_text(file, toml(spec))
    levels = ",".join(f"{modulus:g}" for modulus in moduli)
    code, said, complaint = run_table(laboratory, name, [str(file), "-o", str(folder), "--levels", levels,
                                                         "--no-picture", "-j", str(laboratory.processors)])
    if code == USER_ERROR:
        raise InputError(complaint or f"{laboratory.program} refuses the table {name}.")
    if code != 0:
        trouble = complaint or f"the program ended with code {code}"
        laboratory.failures.append(Solution(f"table {name}", folder, {"status": "failed", "message": trouble}))
        return []
    if said:
        laboratory.tell(f"table {name}: {said.splitlines()[0]}")
    return read_branches(folder / f"table_{name}.csv")


def run_table(laboratory, name, arguments):
    """Exit code, standard output and last complaint of `rheocyte table`; its progress is printed."""
    command, complaint = [laboratory.program, "table", *arguments], ""
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, start_new_session=True, env={"DEAL_II_NUM_THREADS": "1", **os.environ})
    except OSError as error:
        raise InputError(f"{laboratory.program} cannot be started: {reason(error)}.") from error
    with process:
        try:
            for line in process.stderr:
                if line.startswith("rheocyte: "):
                    complaint = last_line(line)
                elif line.strip():
                    laboratory.tell(f"table {name}: {line.strip()}")
            said = process.stdout.read()
            process.wait()
        finally:
            stop([process])
    return process.returncode, said, complaint


def read_branches(path):
    """Branches of a file table_*.csv, from the smallest radius to the greatest."""
    rows = read_table(path, ["radius_um", *MEASURES, "end_of_branch"])
    stiffness = next((name for name in STIFFNESSES if rows and name in rows[0]), None)
    if stiffness is None:
        raise InputError(f"{path} contains no rows with a stiffness; it needs a column {' or '.join(STIFFNESSES)}.")
    by_radius = {}
    for row in rows:
        by_radius.setdefault(number(row, "radius_um", path), []).append(row)
    return [branch(radius, stiffness, by_radius[radius], path) for radius in sorted(by_radius)]


def branch(radius_um, stiffness, rows, path):
    """The branch of the rows of one radius."""
    rows = sorted(rows, key=lambda row: -number(row, stiffness, path))
    column = {name: np.array([number(row, name, path) for row in rows]) for name in [stiffness, *MEASURES]}
    return Branch(radius_um, column.pop(stiffness), column, number(rows[-1], "end_of_branch", path) > 0)
