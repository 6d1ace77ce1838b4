"""The surface of a cell in a square channel, from one eighth of it."""

import unittest

import numpy as np

from rheocyte.duct_surface import IMAGES, front_view, images_of, refined, silhouettes, surface_faces, whole
from rheocyte.vtu import Fields, hexahedron_position

SPREAD = np.linspace(0, 1, 7)


def sphere_patch():
    """The sphere of radius 2 over 0 <= z <= y as one face of degree 6, (1, 7, 7, 3)."""
    along, round_axis = np.meshgrid(SPREAD * np.pi, SPREAD * np.pi / 4)
    return 2 * np.stack([np.cos(along), np.sin(along) * np.cos(round_axis), np.sin(along) * np.sin(round_axis)], axis=-1)[None]


class DuctSurface(unittest.TestCase):
    def test_every_node_of_a_hexahedron_has_one_place_in_vtks_order(self):
        for degree in range(1, 8):
            position = hexahedron_position(degree)
            self.assertEqual(sorted(position.ravel()), list(range((degree + 1) ** 3)))
        second = hexahedron_position(2)
        np.testing.assert_array_equal(second[0, :, :][[0, 0, -1, -1], [0, -1, -1, 0]], [0, 1, 2, 3])
        np.testing.assert_array_equal([second[1, 1, 0], second[1, 1, 2], second[1, 0, 1], second[1, 2, 1], second[0, 1, 1],
                                       second[2, 1, 1], second[1, 1, 1]], range(20, 27))

    def test_the_surface_is_what_cell_and_liquid_share(self):
        nodes = np.stack(np.meshgrid([0.0, 1], [0.0, 1], [0.0, 1], indexing="ij"), axis=-1)[..., ::-1]
        points = np.concatenate([(nodes + [k, 0, 0]).reshape(-1, 3) for k in range(3)])
        elements = np.arange(24).reshape(3, 2, 2, 2)
        fields = Fields(points, elements, {"region": np.repeat([1.0, 1.0, 0.0], 8)})
        faces = surface_faces(fields)
        self.assertEqual(faces.shape, (1, 2, 2, 3))
        np.testing.assert_allclose(faces[..., 0], 2)

    def test_between_the_nodes_the_surface_is_smooth_and_its_normals_point_outward(self):
        points, normals = refined(sphere_patch(), 40)
        np.testing.assert_allclose(np.linalg.norm(points, axis=-1), 2, rtol=3e-3)
        inner = (slice(None), slice(2, -2), slice(2, -2))  # at the poles the face ends in a point
        np.testing.assert_allclose(normals[inner], points[inner] / 2, atol=0.03)

    def test_the_images_of_a_part_make_the_cell_and_every_camera_sees_a_circle(self):
        eighth, quarter = sphere_patch(), np.concatenate([sphere_patch(), sphere_patch()[..., [0, 2, 1]]])
        for section, faces in (("square", eighth), ("rectangle", quarter)):
            every = whole(refined(faces, 20)[0], IMAGES[section])
            self.assertEqual(every.shape, (8, 20, 20, 3))
            for axis in range(3):
                np.testing.assert_allclose([every[..., axis].min(), every[..., axis].max()], [-2, 2], rtol=1e-2)
            for outline in [*silhouettes(faces, IMAGES[section], 11).values(), front_view(faces, IMAGES[section])]:
                np.testing.assert_allclose(np.hypot(*outline.T), 2, rtol=1e-2)
                np.testing.assert_array_equal(outline[0], outline[-1])

    def test_a_square_has_two_silhouettes_a_rectangle_one_and_a_turned_camera_its_own(self):
        self.assertEqual(list(silhouettes(sphere_patch(), IMAGES["square"])), ["side", "diagonal"])
        self.assertEqual(list(silhouettes(sphere_patch(), IMAGES["square"], 45)), ["side", "diagonal"])
        self.assertEqual(list(silhouettes(sphere_patch(), IMAGES["square"], 11)), ["side", "diagonal", "11°"])
        self.assertEqual(list(silhouettes(sphere_patch(), IMAGES["rectangle"])), ["side"])

    def test_a_cell_off_the_axis_has_one_image_and_keeps_its_place(self):
        quarter = np.concatenate([sphere_patch(), sphere_patch()[..., [0, 2, 1]]])
        half = np.concatenate([quarter, quarter * [1, -1, 1]]) + [0, 5, 0]
        for offset, place, seen, camera in (((0, 5), (0, 5), "side", None), ((5, 0), (5, 0), "90°", 90)):
            images = images_of({"channel": {"section": "square"}, "cell": {"offset_um": offset}})
            points, normals = refined(half, 20, 5)
            inner = (slice(None), slice(2, -2), slice(2, -2))  # at the poles the faces end in a point
            np.testing.assert_allclose(normals[inner], (points[inner] - [0, 5, 0]) / 2, atol=0.03)
            np.testing.assert_allclose(np.hypot(*(front_view(half, images) - place).T), 2, rtol=1e-2)
            outlines = silhouettes(half, images, camera)
            self.assertEqual(list(outlines), [seen])
            np.testing.assert_allclose(np.hypot(*outlines[seen].T), 2, rtol=1e-2)


if __name__ == "__main__":
    unittest.main()
