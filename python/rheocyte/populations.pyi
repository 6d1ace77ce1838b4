from collections.abc import Mapping, Sequence
from typing import Any

import pandas
from matplotlib.figure import Figure

class Population:
    record: dict[str, Any]
    recordings: pandas.DataFrame
    conditions: pandas.DataFrame
    comparisons: pandas.DataFrame
    dose_responses: pandas.DataFrame
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

def framed_plan(table: Mapping[str, Sequence[Any]], lines: list[str]) -> pandas.DataFrame: ...
