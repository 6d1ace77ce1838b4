from typing import Any

import numpy as np
from numpy.typing import NDArray

class SmallDeformation:
    contour: NDArray[np.float64]
    def __init__(self, values: dict[str, Any], contour: NDArray[np.float64]) -> None: ...
    def __getattr__(self, name: str) -> Any: ...  # numbers with the names of result.json
    def to_dict(self) -> dict[str, Any]: ...

def analytic(
    radius_um: float,
    *,
    young_modulus_kPa: float | None = None,
    cortex_modulus_mN_per_m: float | None = None,
    tension_ratio: float | None = None,
    channel_width_um: float | None = None,
    tube_radius_um: float | None = None,
    flow_rate_ul_s: float = 0.04,
    viscosity_mPas: float = 15.0,
    square_duct: bool = False,
) -> SmallDeformation: ...
