"""The analytical model of small deformations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rheocyte.arrays import number, positive, truth
from rheocyte.errors import UserError
from rheocyte.native_module import native

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class SmallDeformation:
    """A cell of the analytical model: deformation, area_um2, cell_velocity_m_per_s, ... with the names of result.json.

    contour     meridian, array (n, 2) of x and r in um, front to rear
    """

    contour: NDArray[np.float64]

    def __init__(self, values: dict[str, Any], contour: NDArray[np.float64]) -> None:
        self.__dict__.update(values)
        self.contour = contour

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any: ...  # numbers with the names of result.json

    def to_dict(self) -> dict[str, Any]:
        """All numbers, as `rheocyte analytic cell --json` prints them."""
        return {name: value for name, value in self.__dict__.items() if name != "contour"}

    def __repr__(self):
        return f"<SmallDeformation: {self.model}, deformation {self.deformation:.6g}>"


def analytic(radius_um: float, *, young_modulus_kPa: float | None = None, cortex_modulus_mN_per_m: float | None = None,
             tension_ratio: float | None = None, channel_width_um: float | None = None, tube_radius_um: float | None = None,
             flow_rate_ul_s: float = 0.04, viscosity_mPas: float = 15.0, square_duct: bool = False) -> SmallDeformation:
    """Shape, velocity and pressure drop of a little deformed cell in closed form (docs/theory-analytic.md).

    young_modulus_kPa           of a solid, or
    cortex_modulus_mN_per_m     of a shell, with its tension as a fraction of it, tension_ratio (0.1)
    channel_width_um            of the square channel (20), or tube_radius_um
    square_duct                 take the velocity on the axis of the square channel, as published analytical tables do

    Returns a SmallDeformation; `within_limits` says whether the cell lies where the model holds. UserError for a cell
    that does not fit into the tube or is far too soft.
    """
    if (young_modulus_kPa is None) == (cortex_modulus_mN_per_m is None):
        raise UserError("give either young_modulus_kPa, for a solid, or cortex_modulus_mN_per_m, for a shell.")
    if young_modulus_kPa is not None and tension_ratio is not None:
        raise UserError("tension_ratio is for shells; leave it out, or give cortex_modulus_mN_per_m.")
    radius, rate = positive(radius_um, "radius_um"), positive(flow_rate_ul_s, "flow_rate_ul_s")
    mPas = positive(viscosity_mPas, "viscosity_mPas")
    given = {"young_modulus_kPa": young_modulus_kPa, "cortex_modulus_mN_per_m": cortex_modulus_mN_per_m,
             "channel_width_um": channel_width_um, "tube_radius_um": tube_radius_um}
    good = {name: None if value is None else positive(value, name) for name, value in given.items()}
    tension = number(0.1 if tension_ratio is None else tension_ratio, "tension_ratio")
    if tension < 0:
        raise UserError(f"tension_ratio is {tension:g}; it must be 0 or more.")
    conditions = native.AnalyticConditions(good["channel_width_um"], good["tube_radius_um"], rate, mPas,
                                           truth(square_duct, "square_duct"))
    values, contour = native.analytic(conditions, radius, good["young_modulus_kPa"],
                                    good["cortex_modulus_mN_per_m"], tension)
    return SmallDeformation(values, contour)
