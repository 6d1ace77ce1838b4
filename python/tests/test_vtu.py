"""Reading of fields gives back what was written, and damage is reported in one sentence."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from rheocyte.files import InputError
from rheocyte.raster import PixelGrid, fill_triangles, rasterise, stream_function
from rheocyte.vtu import read_vtu, quadrilateral_position
from tests.synthetic import blocks, fields, write_vtu


class Vtu(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "fields.vtu"
        self.x, self.r, gap, region = blocks()
        self.data = fields(self.x, self.r, gap, region)

    def test_the_fields_come_back(self):
        # Bytes are copied: equality to the last bit.
        write_vtu(self.path, self.x, self.r, self.data)
        read = read_vtu(self.path, ["velocity", "stress", "region"])
        np.testing.assert_array_equal(read.points[read.elements, 0], self.x)
        np.testing.assert_array_equal(read.at_nodes("velocity", 1), self.data["velocity"][..., 1])
        np.testing.assert_array_equal(read.at_nodes("stress"), self.data["stress"])

    def test_the_order_of_a_quadratic_quadrilateral_is_that_of_vtk(self):
        # VTK's manual: corners 0 to 3 counter-clockwise, edges 4 bottom, 5 right, 6 top, 7 left, interior 8.
        np.testing.assert_array_equal(quadrilateral_position(2), [[0, 4, 1], [7, 8, 5], [3, 6, 2]])

    def test_opposite_edges_of_a_cubic_quadrilateral_run_the_same_way(self):
        # Top and left edges ascend with the first and the second direction, not around the element.
        np.testing.assert_array_equal(
            quadrilateral_position(3), [[0, 4, 5, 1], [10, 12, 13, 6], [11, 14, 15, 7], [3, 8, 9, 2]])

    def test_damage_is_named_in_one_sentence(self):
        write_vtu(self.path, self.x, self.r, self.data)
        whole = self.path.read_bytes()
        for damaged in (b"", b"no xml", b"<VTKFile>", whole[:5000], whole[:-300], whole[:2000] + whole[-40:],
                        whole.replace(b'"UInt8"', b'"Word"'), whole.replace(b'Name="region"', b'Name="reg"'),
                        whole.replace(b'NumberOfComponents="3"', b'NumberOfComponents="7"'),
                        whole.replace(b'header_type="UInt64"', b'header_type="UInt32"'),
                        whole.replace(b'offset="0"', b'offset="-900"'), whole.replace(b'offset="0"', b'offset="x"'),
                        whole.replace(b'type="UnstructuredGrid"', b'compressor="vtkZLibDataCompressor"'),
                        whole.replace(b"<Piece", b"<Part").replace(b"</Piece", b"</Part")):
            self.path.write_bytes(damaged)
            with self.assertRaisesRegex(InputError, "fields.vtu is damaged"):
                read_vtu(self.path, ["velocity", "region"])

    def test_a_linear_field_is_exact_on_every_pixel_inside(self):
        # Linear fields survive the triangles; 1e-4 of a pixel is lost at edges that are met by rounding only.
        grid = PixelGrid(np.linspace(-20, 20, 161), np.linspace(0, 10.9, 60))
        (image,) = rasterise(self.x, self.r, [2 * self.x - 3 * self.r + 1], grid)
        wanted = 2 * grid.x[None, :] - 3 * grid.r[:, None] + 1
        self.assertTrue(np.isfinite(image).all())
        np.testing.assert_allclose(image, wanted, atol=1e-4)

    def test_of_triangles_over_each_other_the_highest_is_seen(self):
        # A small one on a large one, above it or below.
        column, row = np.array([[0, 40, 0], [0, 20, 0]]), np.array([[0, 0, 40], [0, 0, 20]])
        for height, seen in ((1, 2), (-1, 1)):
            heights = np.array([0, height])
            order = np.argsort(heights)
            values = np.stack([heights, [1, 2]])[:, order, None] * np.ones(3)
            image = fill_triangles(column[order], row[order], values, (41, 41), highest=True)[1]
            self.assertAlmostEqual(image[5, 5], seen)
            self.assertAlmostEqual(image[5, 30], 1)

    def test_the_stream_function_of_uniform_flow_is_half_the_radius_squared(self):
        # The trapezoidal rule is exact for the integrand r.
        r = np.linspace(0, 3, 31)
        np.testing.assert_allclose(stream_function(np.ones((31, 2)), r)[:, 0], r**2 / 2, atol=1e-13)


if __name__ == "__main__":
    unittest.main()
