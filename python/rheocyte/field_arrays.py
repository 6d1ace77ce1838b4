"""Fields of a state on places of a regular grid."""

import numpy as np

from rheocyte.arrays import numbers
from rheocyte.errors import UserError

NAMES = ("velocity", "velocity_relative", "pressure", "stress", "shear_stress", "displacement", "region")
_VECTORS = ("velocity", "velocity_relative", "displacement")


def on_grid(fields, x_um, r_um):
    """Dictionary of arrays (rows, columns), of vectors (rows, columns, 2); NaN where there is neither cell nor liquid."""
    from rheocyte.raster import PixelGrid, rasterise

    grid = PixelGrid(_places(x_um, "x_um"), _places(r_um, "r_um"))
    x, r = fields.points[fields.elements, 0], fields.points[fields.elements, 1]
    shown = (x.max(axis=(1, 2)) >= grid.x[0]) & (x.min(axis=(1, 2)) <= grid.x[-1])
    wanted = [(name, component) for name in NAMES for component in ((0, 1) if name in _VECTORS else (None,))]
    values = [fields.at_nodes(name, component)[shown] for name, component in wanted]
    images = dict(zip(wanted, rasterise(x[shown], r[shown], values, grid)))
    return {name: np.stack([images[name, 0], images[name, 1]], axis=-1) if name in _VECTORS else images[name, None]
            for name in NAMES}


def _places(values, name):
    places = numbers([] if values is None else values, name)
    steps = np.diff(places) if places.ndim == 1 else places
    if places.ndim != 1 or len(places) < 2 or not (steps > 0).all() or np.ptp(steps) > 1e-6 * steps.max():
        raise UserError(f"{name} must be at least two growing, equidistant places in um; give both x_um and r_um.")
    return places
