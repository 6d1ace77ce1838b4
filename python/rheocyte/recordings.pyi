from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol

import pandas
from numpy.typing import ArrayLike

_Path = str | PathLike[str]
_Progress = bool | Callable[[float], object] | None

class _Dataset(Protocol):
    path: Any

def extract(
    recording: _Path | _Dataset,
    *,
    table: _Path = "",
    section: Literal["tube", "square"] | None = None,
    pixelation: bool = True,
    correct_area: bool = True,
    asymmetry: bool = True,
    progress: _Progress = None,
    **measuring: Any,
) -> pandas.DataFrame: ...
def moduli(
    recording: _Path | _Dataset,
    table: _Path,
    *,
    section: Literal["tube", "square"] | None = None,
    fit_tension: bool = False,
    axial_tension_Pa: float | None = None,
    only_figure: bool = False,
    progress: _Progress = None,
    **measuring: Any,
) -> pandas.DataFrame: ...
def time_course(
    recordings: _Path | _Dataset | Sequence[_Path | _Dataset],
    table: _Path,
    contraction_um: ArrayLike,
    *,
    section: Literal["tube", "square"] = "square",
    progress: _Progress = None,
    **measuring: Any,
) -> pandas.DataFrame: ...
def synth(
    spec: _Path | Mapping[str, Any],
    file: _Path,
    *,
    replace: bool = False,
    progress: _Progress = None,
    **overrides: Any,
) -> int: ...
def features(masks: ArrayLike, pixel_size_um: float) -> pandas.DataFrame: ...
