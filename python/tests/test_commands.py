"""The two commands as a user calls them: figures appear whole, errors are one sentence and exit code 2."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from rheocyte.colours import CELL, LIQUID, to_lab
from rheocyte.contour import bridges, closed, convex_hull
from rheocyte.result_text import deformation_with_error
from tests.synthetic import write_result

PACKAGE = Path(__file__).resolve().parents[1]


def call(module, *arguments):
    """Runs python -m rheocyte.<module> and returns the finished process."""
    return subprocess.run([sys.executable, "-m", f"rheocyte.{module}", *map(str, arguments)], text=True, check=False,
                          capture_output=True, env={**os.environ, "PYTHONPATH": str(PACKAGE)})


class Commands(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def fails(self, process, words):
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        self.assertIn(words, process.stderr)
        self.assertFalse(list(self.folder.glob("*.png")) + list(self.folder.glob(".*")))

    def test_a_result_becomes_a_picture_in_both_formats(self):
        write_result(self.folder)
        process = call("picture", self.folder)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertTrue((self.folder / "picture.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("</svg>", (self.folder / "picture.svg").read_text())
        # Journals and mails: moderate sizes.
        self.assertLess((self.folder / "picture.png").stat().st_size, 1.5e6)
        self.assertLess((self.folder / "picture.svg").stat().st_size, 1.0e6)
        self.assertEqual(len(list(self.folder.iterdir())), 5)  # no temporary file is left

    def test_a_failed_case_is_drawn_with_its_reason(self):
        write_result(self.folder, status="surface-unstable", message="the surface wrinkles", deformation=None)
        self.assertEqual(call("picture", self.folder).returncode, 0)

    def test_what_is_missing_or_damaged_is_named(self):
        self.fails(call("picture", self.folder / "nowhere"), "nowhere/result.json cannot be read")
        write_result(self.folder)
        (self.folder / "contour.csv").write_text("x,r\n1,2\n")
        self.fails(call("picture", self.folder), "contour.csv has no column \"x_um\"")
        (self.folder / "contour.csv").write_text("x_um,r_um\n1,0\n0,nan\n-1,0\n")
        self.fails(call("picture", self.folder), "\"nan\" in column r_um")
        write_result(self.folder)
        (self.folder / "fields.vtu").write_text("<VTKFile>")
        self.fails(call("picture", self.folder), "fields.vtu is damaged")
        (self.folder / "result.json").write_text(json.dumps({"status": 1})[:-2])
        self.fails(call("picture", self.folder), "result.json is not valid JSON")
        self.fails(call("picture"), "give the folder")

    def test_a_table_becomes_a_convergence_figure(self):
        table = self.folder / "table.csv"
        table.write_text("series,degree,unknowns,deformation,error\np,3,1598,0.038710,0.0122\np,4,2968,0.038331,0.0023\n"
                         "p,8,12688,0.038244,0\nh,2,8000,0.03827,6e-4\n")
        process = call("convergence", table, self.folder / "figure")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertTrue((self.folder / "figure.svg").exists() and (self.folder / "figure.png").exists())

    def test_a_table_without_errors_is_refused(self):
        table = self.folder / "table.csv"
        table.write_text("series,degree,unknowns,deformation,error\np,8,12688,0.038244,0\n")
        self.fails(call("convergence", table, self.folder / "figure"), "holds no row with an error")
        self.fails(call("convergence", self.folder / "none.csv", self.folder / "figure"), "none.csv cannot be read")


class Drawing(unittest.TestCase):
    def test_a_dent_has_one_bridge_and_a_circle_none(self):
        # The chord of a rear dent joins the two rims.
        t = np.linspace(0, np.pi, 400)
        dented = closed(np.stack([(1 + 0.8 * np.cos(t)) * np.cos(t), (1 + 0.8 * np.cos(t)) * np.sin(t)], axis=1))
        (chord,) = bridges(dented, convex_hull(dented), 1e-3)
        self.assertAlmostEqual(chord[0, 1], -chord[1, 1], places=12)
        circle = closed(np.stack([np.cos(t), np.sin(t)], axis=1))
        self.assertEqual(bridges(circle, convex_hull(circle), 1e-3), [])

    def test_a_run_in_time_without_one_to_compare_with_says_that_its_error_is_not_known(self):
        run = {"deformation": 0.0123, "estimated_error": None, "time": {"comparison": "iteration-limit"}}
        self.assertEqual(deformation_with_error(run), "deformation 0.0123, error not known")
        self.assertEqual(deformation_with_error({**run, "time": {"comparison": None}}), "deformation 0.0123")

    def test_colormaps_darken_evenly(self):
        # Perceptually even: lightness falls in every step, and no step is more than twice the mean (8-bit rounding).
        for colormap in (LIQUID, CELL):
            lightness = np.array([to_lab(colormap(k)[:3])[0] for k in range(0, 256, 5)])
            steps = -np.diff(lightness)
            self.assertTrue((steps > 0).all() and steps.max() < 2 * steps.mean())


if __name__ == "__main__":
    unittest.main()
