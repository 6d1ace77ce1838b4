"""Figures of lines: tables are computed by the program, lines go through their branches. No solver takes part."""

import os
import unittest
import unittest.mock

import numpy as np

from rheocyte import colours
from rheocyte.figures import figure3, figure4, figure8, lines, paper
from rheocyte.figures.cases import Laboratory, toml
from rheocyte.figures.tables import Branch, read_branches
from rheocyte.files import InputError
from tests.test_figures import WithFakeProgram


def branch(radius, softest=0.5):
    """d = 0.001 r^3 / E^2 on dense rows; the area is 4 r^2."""
    modulus = np.geomspace(50, softest, 400)
    deformation = 0.001 * radius**3 / modulus**2
    return Branch(radius, modulus, {"deformation": deformation, "area_um2": np.full(400, 4 * radius**2),
                                    "moment_ratio": 1 - deformation}, True)


class Lines(unittest.TestCase):
    def test_a_line_goes_through_the_branches(self):
        line = lines.line_of_branches([branch(radius) for radius in np.linspace(3, 9, 9)], 5.0, power=1)
        area = np.linspace(40, 320, 50)
        # Rows 1.2 % apart, the logarithms between them are straight; radii 0.75 apart; points of the line 0.02 apart.
        np.testing.assert_allclose(line.at_area(area, "deformation"), 4e-5 * (area / 4) ** 1.5, rtol=2e-4)
        self.assertFalse(line.ended)
        self.assertTrue(np.isnan(line.at_area(500.0, "deformation")))

    def test_a_line_ends_with_the_smooth_branches(self):
        found = [branch(radius, softest=0.5 * radius) for radius in np.linspace(3, 9, 13)]
        line = lines.line_of_branches(found, 3.1, power=1)
        self.assertTrue(line.ended)
        # The end lies between two radii, at equal steps of the modulus's logarithm.
        np.testing.assert_allclose(line.radius_um[-1], 6.2, atol=0.01)
        np.testing.assert_allclose(line["deformation"][-1], 0.001 * 6.2**3 / 3.1**2, rtol=0.02)
        self.assertIsNone(lines.line_of_branches(found, 80.0, power=1))

    def test_polynomials_of_degree_five_are_met(self):
        x = np.linspace(0, 3, 9)
        wanted = np.linspace(-0.1, 3.1, 33)
        # Rounding of sums with weights of order 10.
        np.testing.assert_allclose(lines.smooth(x, x**5 - x, wanted), wanted**5 - wanted, atol=1e-11)

    def test_overlap_is_found_where_the_order_changes(self):
        r = np.linspace(3, 10, lines.POINTS)
        measures = {"area_um2": np.pi * r**2, "deformation": r, "moment_ratio": 0.9 + 0 * r}
        soft = lines.Line(1.0, r, measures, False)
        stiff = lines.Line(2.0, r, measures | {"moment_ratio": 0.9 + 1e-3 * (r - 6)}, False)
        area, overlap = figure8.overlapping([stiff, soft])
        (stretch,) = figure8.stretches(overlap)
        np.testing.assert_allclose(area[list(stretch)], [50, np.pi * 6.1**2], atol=1)
        self.assertEqual(figure8.stretches(np.zeros(4, dtype=bool)), [])


class Figures(WithFakeProgram):
    def laboratory(self, **environment):
        change = unittest.mock.patch.dict(os.environ, FAKE_LOG=str(self.log), **environment)
        change.start()
        self.addCleanup(change.stop)
        few = unittest.mock.patch.object(lines, "ANALYTICAL_RADII_UM", np.linspace(3.8, 9.4, 4))
        few.start()
        self.addCleanup(few.stop)
        self.told = []
        return Laboratory(str(self.program), self.out / "cases", tell=self.told.append)

    def test_tables_are_made_once_and_told(self):
        self.out.mkdir()
        figure, rows = figure4.make(self.laboratory())
        figure.canvas.draw()
        names = ["linear-solid", "neo-hookean-solid", "linear-shell", "neo-hookean-shell"]
        self.assertEqual(self.solved(), names)
        self.assertIn("table linear-shell: 12 of 12 radii, 3 s elapsed", self.told)
        self.assertIn("table linear-shell: 720 states on 12 branches, 100 solves, 5 s of one processor", self.told)
        self.assertIn("identifier = \"linear-shell\"", (self.out / "tables/linear-shell.toml").read_text())
        self.assertEqual({row["model"] for row in rows}, {"linear", "neo-hookean"})
        row = next(row for row in rows if row["modulus"] == "9.16" and row["area_um2"] == "100.00")
        # d = 0.02 r^2 / E^2 with 100 = pi r^2 (1 + d); lines and rows are dense enough for 1e-4 of it.
        deformation = float(row["deformation"])
        self.assertAlmostEqual(deformation * (1 + deformation), 0.02 * 100 / np.pi / 9.16**2, delta=1e-6)

    def test_a_failed_table_is_noted_in_its_place(self):
        for module, failing, notes in ((figure3, "linear-shell", 2), (figure4, "neo-hookean-solid", 1),
                                       (figure8, "neo-hookean", 2), (figure8, "nothing", 0)):
            laboratory = self.laboratory(FAKE_FAILS=failing)
            figure, rows = module.make(laboratory)
            figure.canvas.draw()
            found = [text for axes in figure.axes for text in axes.texts if text.get_color() == colours.ALARM]
            self.assertEqual(len(found), notes, failing)
            self.assertEqual(all("a worker has ended" in failure.trouble for failure in laboratory.failures), True)

    def test_the_command_tells_what_failed(self):
        ended = self.call(8, self.out, FAKE_FAILS="neo-hookean-shell")
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertIn("not solved, and marked in the figure: table neo-hookean-shell", ended.stderr.splitlines()[-1])
        self.assertEqual({row["cell"] for row in self.table(8)}, {"solid"})
        self.assertLess((self.out / "figure-8.png").stat().st_size, 4e5)
        refused = self.call(8, self.out, FAKE_REFUSES="neo-hookean-solid")
        self.assertEqual(refused.returncode, 2)
        self.assertEqual(refused.stderr, "rheocyte: contains a table that was begun as another\n")

    def test_damaged_tables_are_refused(self):
        path = self.folder / "table.csv"
        for text in ("", "radius_um,deformation,area_um2,moment_ratio,end_of_branch\n1,1,1,1,0\n",
                     "radius_um,young_modulus_kPa,deformation,area_um2,moment_ratio,end_of_branch\n1,x,1,1,1,0\n"):
            path.write_text(text)
            with self.assertRaises(InputError):
                read_branches(path)

    def test_specs_hold_every_key_in_its_section(self):
        text = toml(paper.shell_table("linear-shell", "linear"))
        self.assertIn('[cell.cortex]\nlaw = "linear"\ntension_ratio = 0.1\n', text)
        self.assertIn('[table]\nidentifier = "linear-shell"\n', text)


if __name__ == "__main__":
    unittest.main()
