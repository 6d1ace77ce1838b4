"""The study of beads: the paper's spline, isoelasticity lines, and the figure from what the commands write."""

import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from rheocyte.figures import figure7
from rheocyte.files import InputError


def deformation(area, modulus):
    """An invented law, of the kind that soft solids follow."""
    return 0.3 * (area / 144) ** 1.5 / modulus**2


class FakeLaboratory:
    """Writes what `rheocyte table`, `synth` and `extract` would, for the invented law."""

    def __init__(self, folder, exit_codes=None):
        self.folder, self.exit_codes, self.calls = folder, exit_codes or {}, []
        self.tell = lambda line: None

    def call(self, command, *arguments):
        self.calls.append((command, *map(str, arguments)))
        code = self.exit_codes.get(command, 0)
        if code == 0:
            getattr(self, command)(*map(str, arguments))
        return subprocess.CompletedProcess([command], code, "", "" if code == 0 else "rheocyte: it is broken.\n")

    def table(self, _, __, folder):
        Path(folder).mkdir(exist_ok=True)
        lines = ["radius_um,young_modulus_kPa,area_um2,deformation"]
        for radius in (6.0, 6.5, 7.0, 7.5):
            lines += [f"{radius},{e},{np.pi * radius**2},{deformation(np.pi * radius**2, e)}"
                      for e in np.geomspace(20, 2, 60)]
        (Path(folder) / "table_BEADS-7.csv").write_text("\n".join(lines) + "\n")

    def synth(self, *_):
        pass

    def extract(self, *arguments):
        folder = Path(arguments[arguments.index("-o") + 1])
        folder.mkdir()
        random = np.random.default_rng(1)
        area, modulus = random.normal(144, 8, 3000), random.normal(5.5, 0.8, 3000)
        lines = ["# rheocyte extract", "event\tarea_um2\tdeformation\tviscosity_mPas\tyoung_modulus_kPa\tstate"]
        lines += [f"{i}\t{a}\t{deformation(a, e)}\t7.9\t{e if i % 100 else 'nan'}\tvalid"
                  for i, (a, e) in enumerate(zip(area, modulus))]
        (folder / "beads_rheocyte.tsv").write_text("\n".join(lines) + "\n")


class Spline(unittest.TestCase):
    def test_a_quadratic_comes_back(self):
        x = np.array([0.1, 0.3, 0.4, 0.8, 1.5])
        spline = figure7.QuadraticSpline(x, 3 - 2 * x + 5 * x**2)
        places = np.linspace(0.1, 1.5, 57)
        np.testing.assert_allclose(spline(places), 3 - 2 * places + 5 * places**2, rtol=1e-12)

    def test_it_goes_through_its_points_with_a_continuous_slope(self):
        x = np.array([0.002, 0.004, 0.007, 0.012, 0.02, 0.03, 0.05])
        spline = figure7.QuadraticSpline(x, x**-0.5)
        np.testing.assert_allclose(spline(x), x**-0.5, rtol=1e-12)
        for knot in spline.knots[3:-3]:
            step = 1e-7
            before, after = (spline(knot) - spline(knot - step)) / step, (spline(knot + step) - spline(knot)) / step
            self.assertAlmostEqual(float(before / after), 1, delta=1e-3)

    def test_outside_its_points_there_is_nothing(self):
        spline = figure7.QuadraticSpline(np.array([1.0, 2, 3]), np.array([1.0, 4, 9]))
        self.assertTrue(np.isnan(spline(np.array([0.9, 3.1]))).all())


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_moduli_of_beads_come_back(self):
        laboratory = FakeLaboratory(self.folder)
        figure, rows = figure7.make(laboratory)
        self.assertEqual(len(figure.axes), 2)
        self.assertEqual([row["moduli"] for row in rows], ["paper's spline, as measured", "table, as measured",
                                                           "table, deformation corrected", "own way: both corrected",
                                                           "truth"])
        for row in rows:
            # The invented events have the moduli themselves; the spline through seven points of a falling power is off
            # by a percent.
            self.assertAlmostEqual(float(row["quantile_0.5_kPa"]), 5.5, delta=0.12)
        self.assertEqual([call[0] for call in laboratory.calls], ["table", "synth", "extract", "extract", "extract"])
        self.assertIn("--no-pixelation", laboratory.calls[2])
        self.assertNotIn("--no-pixelation", laboratory.calls[3])

    def test_what_fails_is_said_in_the_programs_words(self):
        with self.assertRaisesRegex(InputError, "it is broken"):
            figure7.make(FakeLaboratory(self.folder, {"synth": 2}))


if __name__ == "__main__":
    unittest.main()
