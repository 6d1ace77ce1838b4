from collections.abc import Mapping, Sequence
from typing import Any

import pandas
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

class Population:
    record: dict[str, Any]
    recordings: pandas.DataFrame
    conditions: pandas.DataFrame
    comparisons: pandas.DataFrame
    def __init__(
        self,
        record: dict[str, Any],
        tables: Mapping[str, Mapping[str, Sequence[Any]]],
        events: Sequence[Mapping[str, Sequence[Any]]],
    ) -> None: ...
    def events(self, recording: int = 0) -> pandas.DataFrame: ...
    def check(self) -> pandas.DataFrame: ...
    def plot(self) -> Figure: ...
    def plot_checks(self) -> Figure | None: ...

def plan(
    radius_um: float,
    young_modulus_kPa: float,
    *,
    spread: float = 0.2,
    radius_spread: float = 0.07,
    between_recordings: float = 0.03,
    difference: float = 0.1,
    power: float = 0.8,
    cells: float = 500,
    mode_2: float = 0.1,
    pixel_size_um: float = 0.34,
    temperature_C: float = 23,
    width_um: ArrayLike = (15, 20, 30),
    medium: str | Sequence[str] = ("0.49% MC-PBS", "0.83% MC-PBS"),
    rate_ul_s: ArrayLike = (),
) -> pandas.DataFrame: ...
