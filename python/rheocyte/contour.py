"""The closed contour and its convex hull as polygons, good enough to draw (numbers come from the solver)."""

import numpy as np


def closed(meridian):
    """The polygon (n, 2) of the whole contour from the half with r >= 0; first and last point are the same."""
    return np.vstack([meridian, meridian[-2::-1] * [1, -1]])


def resampled(line, count, shift=0.0):
    """`count` points at equal distances along a polyline (n, 2), the first one `shift` distances from its start.

    Without a shift the last point of a line is that of the polyline, so the distance is length / (count - 1).
    """
    length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    places = (np.arange(count) + shift) / (count - 1) * length[-1]
    return np.stack([np.interp(places, length, line[:, k]) for k in (0, 1)], axis=1)


def convex_hull(points):
    """Indices of the hull's corners, counter-clockwise, by a monotone chain."""
    order = np.lexsort((points[:, 1], points[:, 0]))
    return half_hull(points, order)[:-1] + half_hull(points, order[::-1])[:-1]


def half_hull(points, order):
    """Corners of the lower half of the hull for ascending x, of the upper half for descending x."""
    chain = []
    for k in order:
        while len(chain) > 1:
            a, b = points[chain[-1]] - points[chain[-2]], points[k] - points[chain[-1]]
            if a[0] * b[1] - a[1] * b[0] > 0:
                break
            chain.pop()
        chain.append(int(k))
    return chain


def bridges(points, hull, least_depth):
    """Chords (2, 2) of the hull below which the polygon lies deeper than least_depth."""
    count = len(points) - 1
    corners = sorted({k % count for k in hull})
    chords = []
    for first, last in zip(corners, corners[1:] + [corners[0] + count]):
        start, end = points[first], points[last % count]
        length = np.hypot(*(end - start))
        between = points[np.arange(first + 1, last) % count]
        if len(between) == 0 or length == 0:
            continue
        offset = between - start
        depth = np.abs((end - start)[0] * offset[:, 1] - (end - start)[1] * offset[:, 0]) / length
        if depth.max() > least_depth:
            chords.append(np.array([start, end]))
    return chords
