# Made by `python -m rheocyte.recordings_stub`; the settings are declared in src/events/recording_settings.cc.
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol

import pandas
from numpy.typing import ArrayLike

from rheocyte.populations import Population

_Path = str | PathLike[str]
_Progress = bool | Callable[[float], object] | None

class _Dataset(Protocol):
    path: Any

_Recording = _Path | _Dataset | pandas.DataFrame

def extract(
    recording: _Recording,
    *,
    table: _Path | None = None,
    section: Literal["tube", "square"] | None = None,
    channel_width_um: float | None = None,
    flow_rate_ul_s: float | None = None,
    pixel_size_um: float | None = None,
    viscosity_mPas: float | None = None,
    medium: str | None = None,
    viscosity_model: str | None = None,
    temperature: float | str | None = None,
    temperature_if_missing: float | None = None,
    min: Mapping[str, float] | None = None,
    max: Mapping[str, float] | None = None,
    polygon: Mapping[tuple[str, str], ArrayLike] | _Path | Sequence[_Path] | None = None,
    patience: float | None = None,
    no_pixelation: bool = False,
    no_area_correction: bool = False,
    no_asymmetry: bool = False,
    axial_tension_Pa: float | None = None,
    progress: _Progress = None,
) -> pandas.DataFrame: ...
def moduli(
    recording: _Recording,
    table: _Path | None = None,
    *,
    section: Literal["tube", "square"] | None = None,
    channel_width_um: float | None = None,
    flow_rate_ul_s: float | None = None,
    pixel_size_um: float | None = None,
    viscosity_mPas: float | None = None,
    medium: str | None = None,
    viscosity_model: str | None = None,
    temperature: float | str | None = None,
    temperature_if_missing: float | None = None,
    min: Mapping[str, float] | None = None,
    max: Mapping[str, float] | None = None,
    polygon: Mapping[tuple[str, str], ArrayLike] | _Path | Sequence[_Path] | None = None,
    patience: float | None = None,
    fit_tension: bool = False,
    axial_tension_Pa: float | None = None,
    outline_noise_um: float | None = None,
    progress: _Progress = None,
) -> pandas.DataFrame: ...
def time_course(
    recordings: _Recording | Sequence[_Recording],
    table: _Path | None = None,
    contraction_um: ArrayLike | None = None,
    *,
    section: Literal["tube", "square"] | None = None,
    channel_width_um: float | None = None,
    flow_rate_ul_s: float | None = None,
    pixel_size_um: float | None = None,
    viscosity_mPas: float | None = None,
    medium: str | None = None,
    viscosity_model: str | None = None,
    temperature: float | str | None = None,
    temperature_if_missing: float | None = None,
    min: Mapping[str, float] | None = None,
    max: Mapping[str, float] | None = None,
    polygon: Mapping[tuple[str, str], ArrayLike] | _Path | Sequence[_Path] | None = None,
    patience: float | None = None,
    progress: _Progress = None,
) -> pandas.DataFrame: ...
def population(
    conditions: Mapping[str, _Recording | Sequence[_Recording]],
    *,
    model: str | None = None,
    section: Literal["tube", "square"] | None = None,
    by: str | None = None,
    paired: bool = False,
    between_recordings: float | None = None,
    dose: Mapping[str, float] | None = None,
    dose_unit: str | None = None,
    shared_spread: bool = False,
    outline_noise_um: float | None = None,
    table: _Path | None = None,
    axial_tension_Pa: float | None = None,
    no_bins: bool = False,
    jobs: float | None = None,
    channel_width_um: float | None = None,
    flow_rate_ul_s: float | None = None,
    pixel_size_um: float | None = None,
    viscosity_mPas: float | None = None,
    medium: str | None = None,
    viscosity_model: str | None = None,
    temperature: float | str | None = None,
    temperature_if_missing: float | None = None,
    min: Mapping[str, float] | None = None,
    max: Mapping[str, float] | None = None,
    polygon: Mapping[tuple[str, str], ArrayLike] | _Path | Sequence[_Path] | None = None,
    patience: float | None = None,
    progress: _Progress = None,
) -> Population: ...
def plan(
    radius_um: float,
    young_modulus_kPa: float,
    *,
    spread: float | None = None,
    radius_spread: float | None = None,
    between_recordings: float | None = None,
    difference: float | None = None,
    power: float | None = None,
    cells: float | None = None,
    mode_2: float | None = None,
    pixel_size_um: float | None = None,
    temperature: float | None = None,
    width_um: ArrayLike | None = None,
    medium: str | Sequence[str] | None = None,
    rate_ul_s: ArrayLike | None = None,
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
