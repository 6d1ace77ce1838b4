#!/usr/bin/env python3
"""What the rule for the pixels of the edge, and a tilt of the camera, change in the features of masks.

    bench/edge_rules.py [--shapes 600]

Outlines r = r0 (1 + c2 cos 2 theta + c3 cos 3 theta), sizes over 4 %, are drawn at random places by the rules of
bench/independent_recordings.py. Prints the mean differences from masks of the pixels whose centre lies inside, with standard errors.
"""
import argparse

import numpy as np
from independent_recordings import ANGLES, features, hull, mask, polygon_features

SHAPES = ((0.003, 0), (0.015, 0), (0.0155, 0.1), (0.045, 0.2))  # deformation, c2
NAMES = ("ln A", "d", "c3", "c4", "c5")


def outline(radius, deformation, mode_2):
    angle = np.linspace(0, 2 * np.pi, ANGLES, endpoint=False)
    mode_3 = np.sqrt((deformation - 0.75 * mode_2**2) / 2)  # d = 3/4 c2^2 + 2 c3^2
    return radius * (1 + mode_2 * np.cos(2 * angle) + mode_3 * np.cos(3 * angle))


def modes(corners):
    """c3, c4 and c5 of a polygon's radius about its centroid."""
    corners = corners - polygon_features(corners)[2]
    parts = np.linspace(0, 1, 40, endpoint=False)[:, None, None]
    points = ((1 - parts) * corners + parts * np.roll(corners, -1, axis=0)).reshape(-1, 2)
    angle, even = np.arctan2(points[:, 1], points[:, 0]), np.linspace(-np.pi, np.pi, 1440, endpoint=False)
    order = np.argsort(angle)
    radius = np.interp(even, angle[order], np.hypot(*points[order].T), period=2 * np.pi)
    return [2 * np.mean(radius * np.cos(k * even)) / radius.mean() for k in (3, 4, 5)]


def seen(shape, place, masks, tilt_degree=0):
    size = 2 * int(shape.max() + 4)
    picture = mask(shape, np.radians(tilt_degree), size / 2 + place, (size, size), masks)
    found = features(picture)
    return np.array([np.log(found["area_um"]), found["deform"], *modes(hull(picture))])


def differences(radius, deformation, mode_2, shapes):
    """From the masks by centres: by rule, one row for each shape."""
    random = np.random.default_rng(1)
    rules = {"coverage": ("coverage", 0), "samples": ("samples", 0), "tilt of 1 degree": ("centre", 1)}
    found = {rule: [] for rule in rules}
    for _ in range(shapes):
        shape, place = outline(radius * np.exp(0.04 * random.normal()), deformation, mode_2), random.uniform(-0.5, 0.5, 2)
        centre = seen(shape, place, "centre")
        for rule, arguments in rules.items():
            found[rule].append(seen(shape, place, *arguments) - centre)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shapes", type=int, default=600)
    options = parser.parse_args()
    print("| radius (pixels) | d | c2 | masks | " + " | ".join(f"{name} (1e-4)" for name in NAMES) + " |\n|" + 9 * "---|")
    for radius in (12, 18, 25):
        for deformation, mode_2 in SHAPES:
            for rule, found in differences(radius, deformation, mode_2, options.shapes).items():
                mean, error = 1e4 * np.mean(found, axis=0), 1e4 * np.std(found, axis=0) / np.sqrt(options.shapes)
                print(f"| {radius} | {deformation} | {mode_2} | {rule} | " +
                      " | ".join(f"{m:+.1f} ± {e:.1f}" for m, e in zip(mean, error)) + " |", flush=True)


if __name__ == "__main__":
    main()
