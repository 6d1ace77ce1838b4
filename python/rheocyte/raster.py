"""Fields of high-order elements on a regular grid of pixels, as pictures and stream functions need them."""

from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from PIL import Image


@dataclass
class PixelGrid:
    """Pixel centres x[j], r[i], both equidistant; lengths in um."""

    x: np.ndarray
    r: np.ndarray

    @property
    def shape(self):
        return len(self.r), len(self.x)

    def coordinates(self, x, r):
        """Positions in units of pixels, counted from the first pixel's centre."""
        return (x - self.x[0]) / (self.x[1] - self.x[0]), (r - self.r[0]) / (self.r[1] - self.r[0])


def subdivision(degree, parts):
    """Matrix (parts + 1, degree + 1): values at equidistant nodes -> values at equidistant points of an interval."""
    nodes = np.linspace(0, 1, degree + 1)
    points = np.linspace(0, 1, parts + 1)
    matrix = np.ones((parts + 1, degree + 1))
    for j in range(degree + 1):
        for k in range(degree + 1):
            if k != j:
                matrix[:, j] *= (points - nodes[k]) / (nodes[j] - nodes[k])
    return matrix


def rasterise(x, r, values, grid, parts=12):
    """Values at the pixel centres that the elements cover, NaN elsewhere.

    x, r: node positions (n, p + 1, p + 1) of equidistant nodes; values: list of arrays like x.
    Each element is cut into 2 parts^2 triangles with linear fields. Returns (len(values), rows, columns).
    """
    matrix = subdivision(x.shape[1] - 1, parts)
    fine = [matrix @ np.asarray(field, dtype=float) @ matrix.T for field in (x, r, *values)]
    fine[0], fine[1] = grid.coordinates(fine[0], fine[1])
    column, row, *rest = map(triangles_of, fine)
    return fill_triangles(column, row, np.stack(rest), grid.shape)


def triangles_of(field):
    """Corners (T, 3) of the two triangles of each square between the points (m, a, b) of grids."""
    corners = np.stack([field[:, :-1, :-1], field[:, :-1, 1:], field[:, 1:, 1:], field[:, 1:, :-1]], axis=-1)
    return np.concatenate([corners[..., [0, 1, 2]].reshape(-1, 3), corners[..., [0, 2, 3]].reshape(-1, 3)])


def fill_triangles(column, row, values, shape, highest=False):
    """Linear interpolation inside triangles, NaN elsewhere; column, row: (T, 3) in pixels, values: (fields, T, 3).

    `highest`: where triangles lie over each other, the one with the highest first value counts; they come in its order.
    """
    image = np.full((len(values), *shape), np.nan)
    first = [np.maximum(np.ceil(c.min(axis=1) - 1e-6), 0).astype(int) for c in (column, row)]
    last = [np.minimum(np.floor(c.max(axis=1) + 1e-6), n - 1).astype(int) for c, n in ((column, shape[1]), (row, shape[0]))]
    count = [end - begin + 1 for begin, end in zip(first, last)]
    touched = (count[0] > 0) & (count[1] > 0)
    for across in range(int(count[0][touched].max(initial=0))):
        wide = touched & (count[0] > across)
        for up in range(int(count[1][wide].max(initial=0))):
            chosen = np.flatnonzero(wide & (count[1] > up))
            j, i = first[0][chosen] + across, first[1][chosen] + up
            weights, inside = barycentric(column[chosen], row[chosen], j, i)
            found, i, j = np.sum(values[:, chosen[inside]] * weights[inside], axis=-1), i[inside], j[inside]
            shown = ~(found[0] < image[0, i, j]) if highest else slice(None)
            image[:, i[shown], j[shown]] = found[:, shown]
    return image


def barycentric(column, row, j, i):
    """Weights (T, 3) of the points (j, i) in the triangles, and which points lie inside or on an edge."""
    with np.errstate(divide="ignore", invalid="ignore"):
        a = (column[:, 1] - column[:, 0], row[:, 1] - row[:, 0])
        b = (column[:, 2] - column[:, 0], row[:, 2] - row[:, 0])
        p = (j - column[:, 0], i - row[:, 0])
        determinant = a[0] * b[1] - a[1] * b[0]
        second = (p[0] * b[1] - p[1] * b[0]) / determinant
        third = (a[0] * p[1] - a[1] * p[0]) / determinant
        weights = np.stack([1 - second - third, second, third], axis=-1)
    return weights, (weights >= -1e-5).all(axis=-1)


def extended(image, pixels):
    """The image continued by some pixels over its edge, so that a clip path cuts through colour and not beside it."""
    padded = np.pad(image, 1, constant_values=np.nan)
    flat, steps = padded.reshape(-1), (-padded.shape[1], padded.shape[1], -1, 1)
    inside = np.zeros(padded.shape, dtype=bool)
    inside[1:-1, 1:-1] = True
    rim = np.flatnonzero(inside & ~np.isfinite(padded))
    for _ in range(pixels):
        neighbours = np.stack([flat[rim + step] for step in steps])
        known = np.isfinite(neighbours)
        found = known.any(axis=0)
        flat[rim[found]] = np.where(known, neighbours, 0).sum(axis=0)[found] / known.sum(axis=0)[found]
        rim = rim[~found]
    return padded[1:-1, 1:-1]


def stream_function(axial_velocity, r):
    """Stokes's stream function psi = int_0^r u_x r dr, one column of pixels after the other; r[0] = 0 (the axis)."""
    flux = np.nan_to_num(axial_velocity) * r[:, None]
    steps = 0.5 * (flux[1:] + flux[:-1]) * np.diff(r)[:, None]
    return np.vstack([np.zeros(flux.shape[1]), np.cumsum(steps, axis=0)])


def mirrored(image):
    """The full section from the half above the axis; row 0 (the axis) appears once."""
    return np.vstack([image[:0:-1], image])


class Raster(Artist):
    """Pixels (rows, columns, 4) of 8 bits that fill a rectangle of the axes (left, right, bottom, top), smoothed.

    Matplotlib's own images resample in floating point, which takes longer than all the rest of a picture.
    """

    def __init__(self, pixels, extent, zorder):
        super().__init__()
        self.pixels, self.extent = pixels, extent
        self.set_zorder(zorder)

    def draw(self, renderer):
        left, right, bottom, top = self.extent
        (x0, y0), (x1, y1) = self.axes.transData.transform([(left, bottom), (right, top)])
        scale = renderer.get_image_magnification()
        size = round((x1 - x0) * scale), round((y1 - y0) * scale)
        graphics = renderer.new_gc()
        self._set_gc_clip(graphics)
        smooth = Image.fromarray(self.pixels[::-1]).resize(size, Image.Resampling.BILINEAR)
        renderer.draw_image(graphics, x0, y0, np.array(smooth))  # a view of it cannot be written to
        graphics.restore()
