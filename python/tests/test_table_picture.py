"""Pictures of a table: three figures in both formats from whatever rows there are; damage is one sentence."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from rheocyte.files import InputError
from rheocyte.table_picture import curve_of_ends, grid_of, line_levels, read_folder, regularised_outline

PACKAGE = Path(__file__).resolve().parents[1]
HEADER = "radius_um,{},deformation,area_um2,deformation_error,stiffness_error,regularised,end_of_branch\n"


def write_table(folder, stiffness="young_modulus_kPa", end=0.08, radii=12):
    """Invented cells: deformation = radius^3 / (5000 stiffness^2); the bare surface of small ones ends at `end`."""
    rows, ends = [], ["radius_um,area_um2,deformation,status,reason"]
    for radius in np.linspace(3.1, 9.5, radii):
        levels = np.geomspace(5e-5, 0.19, 40)
        last = end + 0.01 * (radius - 3)
        for d, is_end in sorted([(d, 0) for d in levels] + [(last, 1)]):
            area = np.pi * radius**2 * (1 + 0.8 * d)
            rows.append(f"{radius},{np.sqrt(radius**3 / 5000 / d)},{d},{area},1e-4,{5e-5 * (1 + d)},"
                        f"{int(d > last)},{is_end}")
        ends.append(f"{radius},{np.pi * radius**2 * (1 + 0.8 * last)},{last},surface-unstable,\"it, would wrinkle\"")
    (Path(folder) / "table_XX-2D-26.csv").write_text(HEADER.format(stiffness) + "\n".join(rows) + "\n")
    (Path(folder) / "end-of-branch.csv").write_text("\n".join(ends) + "\n")


def call(*arguments):
    """Runs python -m rheocyte.table_picture and returns the finished process."""
    return subprocess.run([sys.executable, "-W", "error::UserWarning", "-m", "rheocyte.table_picture",
                           *map(str, arguments)], text=True, check=False, capture_output=True,
                          env={**os.environ, "PYTHONPATH": str(PACKAGE)})


class TablePicture(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_table_becomes_three_pictures_in_both_formats(self):
        write_table(self.folder)
        process = call(self.folder)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        for name in ("lines", "coverage", "error"):
            self.assertTrue((self.folder / f"{name}.png").read_bytes().startswith(b"\x89PNG"))
            self.assertIn("</svg>", (self.folder / f"{name}.svg").read_text())
        self.assertEqual(len(list(self.folder.iterdir())), 8)  # no temporary file is left

    def test_a_table_without_ends_and_a_tiny_one_are_drawn(self):
        write_table(self.folder, "cortex_modulus_mN_per_m", end=1.0)
        (self.folder / "end-of-branch.csv").write_text("radius_um,area_um2,deformation,status,reason\n")
        self.assertEqual(call(self.folder).stderr, "")
        write_table(self.folder, radii=2)
        self.assertEqual(call(self.folder).stderr, "")

    def test_the_grid_holds_every_row_and_the_lines_fill_its_range(self):
        write_table(self.folder)
        table = read_folder(self.folder)
        grid = grid_of(table)
        self.assertEqual(grid.stiffness.shape, (12, 40))
        self.assertTrue(np.isfinite(grid.stiffness).all() and np.isfinite(grid.area).all())
        levels = line_levels(grid)
        self.assertEqual(len(levels), 11)
        self.assertTrue(np.nanmin(grid.stiffness) <= levels[0] < levels[-1] < np.nanmax(grid.stiffness))

    def test_the_regularised_region_begins_at_the_end_of_the_branches(self):
        write_table(self.folder)
        table = read_folder(self.folder)
        outline = regularised_outline(table)
        np.testing.assert_allclose(outline[:12], table.end)
        np.testing.assert_allclose(outline[12:, 1], 0.19)

    def test_the_curve_of_ends_has_a_gap_where_a_branch_ends_for_another_reason(self):
        write_table(self.folder)
        path = self.folder / "end-of-branch.csv"
        lines = path.read_text().splitlines()
        lines[5] = lines[5].replace("surface-unstable", "accuracy-not-reached")
        path.write_text("\n".join(lines) + "\n")
        table = read_folder(self.folder)
        self.assertEqual(table.other_end.shape, (1, 2))
        curve = curve_of_ends(table)
        self.assertEqual(np.flatnonzero(np.isnan(curve[:, 0])).tolist(), [4])
        self.assertEqual(len(curve), 12)

    def test_what_is_missing_or_damaged_is_named(self):
        for change, words in ((lambda: None, "contains 0 files table_"),
                              (lambda: write_table(self.folder, "modulus"), "young_modulus_kPa or cortex_modulus"),
                              (lambda: (self.folder / "table_XX-2D-26.csv").write_text("radius_um\n"), "has no column")):
            change()
            process = call(self.folder)
            self.assertEqual((process.returncode, process.stderr.count("\n")), (2, 1), process.stderr)
            self.assertIn(words, process.stderr)
        write_table(self.folder)
        (self.folder / "end-of-branch.csv").unlink()
        with self.assertRaisesRegex(InputError, "end-of-branch.csv cannot be read"):
            read_folder(self.folder)


if __name__ == "__main__":
    unittest.main()
