"""A body of revolution seen from any side, as a shaded image."""

import numpy as np

from rheocyte.contour import resampled

LIGHT = np.array([-0.35, 0.6, 0.72])  # right, up, towards the eye
AMBIENT, SHINE, EXPONENT = 0.1, 0.5, 24
FINER = 2  # pixels are averaged over so many in each direction


def seen(meridian, azimuth_deg, elevation_deg, half_width, pixels, colormap):
    """RGBA image (pixels, pixels, 4) of the body within +-half_width; transparent beside it.

    `meridian` (n, 2) holds x and r >= 0. Azimuth 0 looks at the side, the x axis pointing right; a positive one turns
    the rear towards the eye, a positive elevation lifts the eye. Orthographic, with one light.
    """
    points, normals = surface(meridian, spacing(half_width, pixels))
    return image_of(points, normals, (azimuth_deg, elevation_deg), half_width, pixels, colormap)


def spacing(half_width, pixels):
    """The distance between surface points at which each pixel is met at any angle: 0.7 pixels."""
    return 1.4 * half_width / (FINER * pixels)


def image_of(points, normals, angles_deg, half_width, pixels, colormap):
    """As `seen`, of any surface by its points (n, 3), no farther apart than `spacing`, and outward normals."""
    fine = FINER * pixels
    azimuth_deg, elevation_deg = angles_deg
    turn = rotation(np.radians(azimuth_deg), np.radians(elevation_deg))
    points, normals = points @ turn.T, normals @ turn.T
    columns, rows = ((points[:, :2] / half_width + 1) / 2 * fine).astype(int).T
    visible = (normals[:, 2] > 0) & (np.minimum(columns, rows) >= 0) & (np.maximum(columns, rows) < fine)
    order = np.flatnonzero(visible)[np.argsort(points[visible, 2], kind="stable")]  # the nearest is painted last
    image = np.zeros((fine, fine, 4))
    image[rows[order], columns[order]] = shaded(normals[order], colormap)
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


def surface(meridian, step):
    """Points and outward normals (n, 3) of the surface, less than a step apart: x, up, to the eye."""
    length = np.hypot(*np.diff(meridian, axis=0).T).sum()
    curve = resampled(meridian, int(length / step) + 3)
    tangent = np.gradient(curve, axis=0)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)  # from the front pole to the rear one
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    angle = np.linspace(0, 2 * np.pi, int(2 * np.pi * curve[:, 1].max() / step) + 3, endpoint=False)
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)

    def revolve(pairs):
        return np.concatenate([np.broadcast_to(pairs[:, None, :1], (len(pairs), len(angle), 1)),
                               pairs[:, None, 1:] * around[None]], axis=2).reshape(-1, 3)

    return revolve(curve), revolve(normal)


def rotation(azimuth, elevation):
    """Matrix that turns the body round the vertical axis and then tilts it towards the eye."""
    c, s = np.cos(azimuth), np.sin(azimuth)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    c, s = np.cos(elevation), np.sin(elevation)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ turn
