"""Density of events in the plane, for colours and contours: a kernel estimate on a grid, in linear time."""

import numpy as np

CELLS = 384  # of the grid, each way


def robust_spread(values):
    """Standard deviation, or what the quartiles say if that is less: single outliers must not blur everything."""
    low, high = np.percentile(values, [25, 75])
    spread, quartiles = float(np.std(values)), float(high - low) / 1.349
    return quartiles if 0 < quartiles < spread else spread


def smoothed(rows, width):
    """Convolution of each row with a normal curve of standard deviation `width` (cells); nothing flows in at the ends."""
    reach = max(1, int(np.ceil(4 * width)))
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / width) ** 2)
    kernel /= kernel.sum()
    size = rows.shape[1] + 2 * reach
    return np.fft.irfft(np.fft.rfft(rows, size, axis=1) * np.fft.rfft(kernel, size), size, axis=1)[:, reach:reach + rows.shape[1]]


class Density:
    """Kernel estimate of the density of points (x, y) inside a rectangle ((left, right), (bottom, top)).

    The kernel is normal; its width is 0.8 n^(-1/6) times the robust spread of each coordinate: somewhat less than Scott's
    rule, for recordings often hold several kinds of cells. `values[i, j]` belongs
    to (self.x[j], self.y[i]); its integral is the fraction of the points that lie in the rectangle.
    """

    def __init__(self, x, y, rectangle):
        (left, right), (bottom, top) = rectangle
        self.x = left + (np.arange(CELLS) + 0.5) * (right - left) / CELLS
        self.y = bottom + (np.arange(CELLS) + 0.5) * (top - bottom) / CELLS
        counts, _, _ = np.histogram2d(y, x, CELLS, [(bottom, top), (left, right)])
        steps = (self.x[1] - self.x[0], self.y[1] - self.y[0])
        inside = (x > left) & (x < right) & (y > bottom) & (y < top)
        shrink = 0.8 * max(1, inside.sum()) ** (-1 / 6)
        widths = [max(0.8, shrink * robust_spread(v[inside]) / step) if inside.any() else 1
                  for v, step in zip((x, y), steps)]
        values = smoothed(smoothed(counts, widths[0]).T, widths[1]).T
        self.values = np.maximum(values, 0) / (max(1, len(x)) * steps[0] * steps[1])

    def at(self, x, y):
        """Bilinear interpolation; places outside the rectangle have the value at its rim."""
        column = np.clip((x - self.x[0]) / (self.x[1] - self.x[0]), 0, CELLS - 1.001)
        row = np.clip((y - self.y[0]) / (self.y[1] - self.y[0]), 0, CELLS - 1.001)
        j, i = column.astype(int), row.astype(int)
        s, t = column - j, row - i
        v = self.values
        return ((1 - t) * ((1 - s) * v[i, j] + s * v[i, j + 1]) + t * ((1 - s) * v[i + 1, j] + s * v[i + 1, j + 1]))


def levels_enclosing(densities, fractions):
    """The densities above which the given fractions of the events lie, from their densities."""
    return [float(np.quantile(densities, 1 - fraction)) for fraction in fractions]


def thinned(densities, greatest_number, seed=1):
    """Indices of at most so many events, dense ones last, so that they are drawn on top.

    Where events are few, all stay; where they overlap anyway, some are left out at random: an event stays with a
    probability that is limited by a constant over its density.
    """
    count = len(densities)
    kept = np.arange(count)
    if count > greatest_number:
        weight = 1 / np.maximum(densities, densities.max() * 1e-6)
        low, high = 0.0, 1 / weight.min()
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if np.minimum(1, middle * weight).sum() < greatest_number else (low, middle)
        kept = kept[np.random.default_rng(seed).random(count) < np.minimum(1, low * weight)]
    return kept[np.argsort(densities[kept], kind="stable")]
