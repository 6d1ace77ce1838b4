from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

STATES: tuple[str, ...]

class Moduli(NamedTuple):
    young_modulus_kPa: NDArray[np.float64]
    young_modulus_kPa_error: NDArray[np.float64]
    state: NDArray[np.int8]
    @property
    def standard_error_kPa(self) -> NDArray[np.float64]: ...

class Shapes(NamedTuple):
    expected: NDArray[np.float64]
    excess: NDArray[np.float64]
    standard_error: NDArray[np.float64]
    odd_fraction: NDArray[np.float64]

class TextFiles(NamedTuple):
    table: Path
    lines: Path

def table_names() -> list[str]: ...
def dclab_plugin(file: str | PathLike[str]) -> Path: ...
def place_of_table(name: str | PathLike[str]) -> str: ...
def table(
    spec: str | PathLike[str] | Mapping[str, Any],
    folder: str | PathLike[str],
    *,
    jobs: int | None = None,
    executor: Executor | None = None,
    progress: bool | Callable[[float], object] | None = None,
    **overrides: Any,
) -> Table | Path: ...
def viscosity(
    medium: str,
    *,
    channel_width_um: float,
    flow_rate_ul_s: float,
    temperature_C: ArrayLike,
    model: str = "buyukurganci-2022",
) -> Any: ...

class Table:
    def __init__(self, name: str | PathLike[str] = "LE-2D-26") -> None: ...
    @classmethod
    def for_medium(cls, medium: str, *, temperature_C: float = 23.0, model: str = "buyukurganci-2022") -> Table: ...
    @property
    def identifier(self) -> str: ...
    @property
    def is_own(self) -> bool: ...
    @property
    def origin(self) -> dict[str, Any]: ...
    def modulus(
        self,
        area_um2: ArrayLike,
        deform: ArrayLike,
        *,
        channel_width_um: float,
        flow_rate_ul_s: float,
        pixel_size_um: float,
        viscosity_mPas: ArrayLike | None = None,
        medium: str | None = None,
        temperature_C: ArrayLike | None = None,
        viscosity_model: str = "buyukurganci-2022",
        correct_area: bool = True,
    ) -> Moduli: ...
    def shapes(
        self,
        area_um2: ArrayLike,
        deform: ArrayLike,
        inertia_ratio: ArrayLike,
        *,
        channel_width_um: float,
        pixel_size_um: float,
        correct_area: bool = True,
    ) -> Shapes: ...
    def lines(
        self,
        levels_kPa: ArrayLike | None = None,
        *,
        pixel_size_um: float,
        count: int = 11,
        channel_width_um: float | None = None,
        flow_rate_ul_s: float | None = None,
        viscosity_mPas: float | None = None,
    ) -> list[tuple[float, NDArray[np.float64]]]: ...
    def texts(self, folder: str | PathLike[str] | None = None) -> TextFiles: ...
    def support(
        self,
        *,
        pixel_size_um: float,
        channel_width_um: float | None = None,
        flow_rate_ul_s: float | None = None,
        viscosity_mPas: float | None = None,
    ) -> NDArray[np.float64]: ...
