"""Colours of the figures: colormaps with evenly rising lightness, and the few fixed colours."""

import numpy as np
from matplotlib.colors import ListedColormap, to_rgb

INK = "#14202b"
ALARM = "#b3261e"

# D65 white and the matrix from linear sRGB to XYZ.
WHITE = np.array([0.95047, 1.0, 1.08883])
TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                   [0.0193339, 0.1191920, 0.9503041]])


def to_lab(colour):
    """CIELAB of a colour in any notation of matplotlib."""
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    ratio = TO_XYZ @ linear / WHITE
    f = np.where(ratio > 0.008856, np.cbrt(ratio), 7.787 * ratio + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def from_lab(lab):
    """sRGB in [0, 1] of CIELAB colours (n, 3)."""
    fy = (lab[:, 0] + 16) / 116
    f = np.stack([fy + lab[:, 1] / 500, fy, fy - lab[:, 2] / 200], axis=1)
    xyz = np.where(f > 0.206893, f**3, (f - 16 / 116) / 7.787) * WHITE
    linear = np.clip(xyz @ np.linalg.inv(TO_XYZ).T, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def even_colormap(name, *anchors):
    """A colormap through the anchors, straight and at constant speed in CIELAB: equal steps look equal."""
    lab = np.array([to_lab(colour) for colour in anchors])
    distance = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(lab, axis=0), axis=1))])
    places = np.linspace(0, distance[-1], 256)
    return ListedColormap(from_lab(np.stack([np.interp(places, distance, lab[:, k]) for k in range(3)], axis=1)), name)


LIQUID = even_colormap("rheocyte-liquid", "#f3f8fb", "#9cc7df", "#3f82b5", "#12406f")
CELL = even_colormap("rheocyte-cell", "#fff6df", "#fbc873", "#e5703a", "#9c1f3a")
