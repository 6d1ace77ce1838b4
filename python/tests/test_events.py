"""Densities integrate to one, contours enclose what they say, and the picture of events appears whole."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from rheocyte.density import Density, levels_enclosing, thinned
from rheocyte.event_plot import Panel, draw, limits_of, ranges, smoothed, upper_end, visible_part

PACKAGE = Path(__file__).resolve().parents[1]
RECTANGLE = ((0.0, 200.0), (0.0, 0.2))


def cloud(count=20000):
    """A normal population (area, deformation)."""
    random = np.random.default_rng(7)
    return random.normal(100, 12, count), random.normal(0.08, 0.012, count)


class Densities(unittest.TestCase):
    def test_the_integral_is_the_fraction_inside(self):
        x, y = cloud()
        density = Density(np.append(x, [500.0] * len(x)), np.append(y, y), RECTANGLE)
        cell = (density.x[1] - density.x[0]) * (density.y[1] - density.y[0])
        self.assertAlmostEqual(density.values.sum() * cell, 0.5, delta=1e-3)  # half of the events lie outside

    def test_a_normal_population_has_its_density(self):
        x, y = cloud(200000)
        density = Density(x, y, RECTANGLE)
        shrink = 0.8 * len(x) ** (-1 / 6)
        peak = 1 / (2 * np.pi * 12 * 0.012 * (1 + shrink**2))  # the kernel adds its variance
        self.assertAlmostEqual(density.at(np.array([100.0]), np.array([0.08]))[0] / peak, 1, delta=0.03)

    def test_contours_enclose_their_fraction(self):
        x, y = cloud()
        density = Density(x, y, RECTANGLE)
        seen = density.at(x, y)
        low, high = levels_enclosing(seen, [0.95, 0.5])
        self.assertAlmostEqual((seen >= low).mean(), 0.95, delta=1e-3)
        self.assertAlmostEqual((seen >= high).mean(), 0.5, delta=1e-3)
        # Of a normal population 50 % lie within sqrt(2 ln 2) standard deviations.
        inside = ((x - 100) / 12) ** 2 + ((y - 0.08) / 0.012) ** 2 < 2 * np.log(2)
        self.assertGreater((inside == (seen >= high)).mean(), 0.97)

    def test_thinning_keeps_what_is_rare(self):
        x, y = cloud()
        x[:5], y[:5] = [20, 30, 40, 150, 170], 0.18
        seen = Density(x, y, RECTANGLE).at(x, y)
        kept = thinned(seen, 2000)
        self.assertAlmostEqual(len(kept), 2000, delta=150)
        self.assertTrue(set(range(5)) <= set(kept.tolist()))
        self.assertTrue((np.diff(seen[kept]) >= 0).all())  # dense ones are drawn last
        self.assertEqual(len(thinned(seen, 10**6)), len(x))

    def test_equal_events_and_single_ones_do_no_harm(self):
        for count in (1, 3):
            density = Density(np.full(count, 80.0), np.full(count, 0.05), RECTANGLE)
            self.assertTrue(np.isfinite(density.values).all())


class Axes(unittest.TestCase):
    def test_ranges_are_the_standard_ones_until_events_need_more(self):
        self.assertEqual(upper_end(np.full(100, 80.0), 200), 200)
        self.assertEqual(upper_end(np.append(np.full(999, 80.0), 900), 200), 200)  # one in a thousand may be outside
        self.assertEqual(upper_end(np.full(100, 310.0), 200), 350)

    def test_the_axis_of_deformations_ends_where_the_events_do(self):
        """All panels of a picture share one, which leaves at most a fifth of its length empty."""
        story = {"width_um": 20}
        panels = [Panel(story, np.stack([np.full(100, 80.0), np.full(100, d)], axis=1), [], None, {}) for d in (0.04, 0.011)]
        for count, greatest in ((2, 0.04), (1, 0.04)):
            (_, (low, high)), *others = ranges(panels[:count])
            self.assertEqual(low, 0)
            self.assertTrue(greatest < high < 1.25 * greatest)
            self.assertTrue(all(other[1] == (low, high) for other in others))
        self.assertEqual(ranges(panels[1:])[0][1], (0, 0.03))

    def test_gates_on_the_axes_are_drawn(self):
        gates = {"x": [60, 90], "y": [None, 0.08], "polygons": [{"x": [70, 95, 80], "y": [0.01, 0.01, 0.05]}]}
        self.assertEqual(limits_of(gates), [("x", 60), ("x", 90), ("y", 0.08)])
        story = {"title": "a", "sample": "", "measured": "", "events": 2, "drawable": 2, "width_um": 20}
        axes, = draw([Panel(story, np.array([[80, 0.03], [85, 0.04]]), [], None, gates)]).axes
        drawn = [line.get_xydata().tolist() for line in axes.lines]
        self.assertIn([[70, 0.01], [95, 0.01], [80, 0.05], [70, 0.01]], drawn)
        self.assertEqual(len(drawn), 4)

    def test_lines_are_cut_at_the_axes(self):
        line = np.array([[50, 0.0], [150, 0.1], [250, 0.2]])
        np.testing.assert_allclose(visible_part(line, RECTANGLE)[-1], [200, 0.15])
        self.assertEqual(len(visible_part(line + [300, 0], RECTANGLE)), 0)

    def test_evening_keeps_a_smooth_line(self):
        x = np.linspace(30, 290, 400)
        line = np.stack([x, 1e-3 * x + 1e-6 * x**2], axis=1)
        np.testing.assert_allclose(smoothed(line), line, rtol=1e-9)


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def call(self, *arguments):
        return subprocess.run([sys.executable, "-B", "-m", "rheocyte.event_plot", *map(str, arguments)], text=True,
                              check=False, capture_output=True, env={**os.environ, "PYTHONPATH": str(PACKAGE)})

    def write(self, count):
        np.stack(cloud(count), axis=1).astype("<f4").tofile(self.folder / "events-0")
        story = {"title": "M001.rtdc", "sample": "beads", "measured": "20 µm", "events": count + 2, "drawable": count,
                 "width_um": 20, "events_file": "events-0", "table": "TEST", "pixels": 0.34,
                 "lines": [{"young_modulus_kPa": 1.23, "area_um2": [50, 250], "deformation": [0.01, 0.15]}],
                 "support": {"area_um2": [30, 280, 280, 30], "deformation": [0, 0, 0.18, 0.1]}}
        gates = {"x": [80, None], "y": [None, None], "polygons": [{"x": [80, 120, 100], "y": [0.05, 0.05, 0.1]}]}
        (self.folder / "plot.json").write_text(json.dumps({"panels": [story], "gates": gates}), encoding="utf-8")

    def test_words_of_the_picture(self):
        for count in (1, 3000):
            self.write(count)
            process = self.call(self.folder, self.folder / "out")
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            self.assertTrue((self.folder / "out.png").read_bytes().startswith(b"\x89PNG"))
        # Letters are outlines in the file; matplotlib keeps the text as comments.
        svg = (self.folder / "out.svg").read_text()
        for words in ("M001.rtdc", "1.2 kPa", "beads", "20 µm", "3\u2009002 events, 2 without shape", "range of the table", "equal E from deformation, TEST", "gates"):
            self.assertTrue(words in svg, words)
        self.assertLess((self.folder / "out.svg").stat().st_size, 6e5)

    def test_what_is_damaged_is_named(self):
        self.assertIn("cannot be read", self.call(self.folder, self.folder / "out").stderr)
        self.write(10)
        (self.folder / "plot.json").write_text("{}")
        process = self.call(self.folder, self.folder / "out")
        self.assertEqual((process.returncode, process.stderr.count("\n")), (2, 1))
        self.assertIn("plot.json is damaged", process.stderr)
        self.assertEqual(self.call().returncode, 2)


if __name__ == "__main__":
    unittest.main()
