"""A body of revolution seen from any side, as a shaded image."""

import numpy as np

from rheocyte.contour import resampled
from rheocyte.raster import fill_triangles, triangles_of

LIGHT = np.array([-0.35, 0.6, 0.72])  # right, up, towards the eye
AMBIENT, SHINE, EXPONENT = 0.1, 0.5, 24
FINER = 2  # pixels are averaged over so many in each direction
STEPS = 145  # points along the meridian and around of a body of revolution


def seen(meridian, azimuth_deg, elevation_deg, half_width, pixels, colormap):
    """RGBA image (pixels, pixels, 4) of the body within +-half_width; transparent beside it.

    `meridian` (n, 2) holds x and r >= 0. Azimuth 0 looks at the side, the x axis pointing right; a positive one turns
    the rear towards the eye, a positive elevation lifts the eye. Orthographic, with one light.
    """
    points, normals = surface(meridian)
    return image_of(points[None], normals[None], (azimuth_deg, elevation_deg), half_width, pixels, colormap)


def image_of(points, normals, angles_deg, half_width, pixels, colormap):
    """As `seen`, of any surface: points and outward normals (m, a, b, 3) on m grids. Of parts behind each other the one
    that is nearer to the eye is seen."""
    fine = FINER * pixels
    azimuth_deg, elevation_deg = angles_deg
    turn = rotation(np.radians(azimuth_deg), np.radians(elevation_deg))
    column, row, depth = ((points @ turn.T)[..., c] for c in range(3))
    column, row = (((place / half_width + 1) / 2) * fine - 0.5 for place in (column, row))
    triangles = np.stack([triangles_of(field) for field in (column, row, depth, *np.moveaxis(normals @ turn.T, -1, 0))])
    triangles = triangles[:, (triangles[-1] > 0).any(axis=1)]  # towards the eye
    triangles = triangles[:, np.argsort(triangles[2].sum(axis=1))]
    _, *normal = fill_triangles(triangles[0], triangles[1], triangles[2:], (fine, fine), highest=True)
    normal = np.stack(normal)
    visible = normal[2] > 0  # not where there is nothing
    image = np.zeros((fine, fine, 4))
    image[visible] = shaded(normal[:, visible].T / np.linalg.norm(normal[:, visible], axis=0)[:, None], colormap)
    blocks = image.reshape(pixels, FINER, pixels, FINER, 4)
    cover = blocks[..., 3:].mean(axis=(1, 3))
    colour = (blocks[..., :3] * blocks[..., 3:]).mean(axis=(1, 3)) / np.maximum(cover, 1e-9)
    return np.concatenate([colour, cover], axis=-1)


def shaded(normals, colormap):
    """RGBA of surface points: light that wraps round the body, and a little shine."""
    light = LIGHT / np.linalg.norm(LIGHT)
    half = (light + [0, 0, 1]) / np.linalg.norm(light + [0, 0, 1])
    diffuse = AMBIENT + (1 - AMBIENT) * (0.5 + 0.5 * normals @ light) ** 1.7
    colour = np.array(colormap(1 - diffuse))
    colour[:, :3] += (1 - colour[:, :3]) * (SHINE * np.clip(normals @ half, 0, None) ** EXPONENT)[:, None]
    return colour


def surface(meridian):
    """Points and outward normals (STEPS, STEPS, 3) of the surface: x, up, to the eye."""
    curve = resampled(meridian, STEPS)
    tangent = np.gradient(curve, axis=0)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)  # from the front pole to the rear one
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    angle = np.linspace(0, 2 * np.pi, STEPS)
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)

    def revolve(pairs):
        return np.concatenate([np.broadcast_to(pairs[:, None, :1], (STEPS, STEPS, 1)), pairs[:, None, 1:] * around[None]], axis=2)

    return revolve(curve), revolve(normal)


def rotation(azimuth, elevation):
    """Matrix that turns the body round the vertical axis and then tilts it towards the eye."""
    c, s = np.cos(azimuth), np.sin(azimuth)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    c, s = np.cos(elevation), np.sin(elevation)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ turn
