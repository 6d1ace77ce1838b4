"""python -m rheocyte.recordings_stub: the type stub of the module recordings, from the declared settings."""

from rheocyte.native_module import native
from rheocyte.settings import declared

STUB = '''# Made by `python -m rheocyte.recordings_stub`; the settings are declared in src/events/recording_settings.cc.
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
{extract}
    progress: _Progress = None,
) -> pandas.DataFrame: ...
def moduli(
    recording: _Recording,
    table: _Path | None = None,
    *,
{moduli}
    progress: _Progress = None,
) -> pandas.DataFrame: ...
def time_course(
    recordings: _Recording | Sequence[_Recording],
    table: _Path | None = None,
    contraction_um: ArrayLike | None = None,
    *,
{time_course}
    progress: _Progress = None,
) -> pandas.DataFrame: ...
def population(
    conditions: Mapping[str, _Recording | Sequence[_Recording]],
    *,
{population}
    progress: _Progress = None,
) -> Population: ...
def plan(
    radius_um: float,
    young_modulus_kPa: float,
    *,
{plan}
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
'''
FORMS = {"table": "_Path", "min": "Mapping[str, float]", "max": "Mapping[str, float]", "dose": "Mapping[str, float]",
         "polygon": "Mapping[tuple[str, str], ArrayLike] | _Path | Sequence[_Path]"}


SEVERAL = {"numbers": "ArrayLike", "texts": "str | Sequence[str]"}


def type_of(setting):
    """The annotation of a setting that is given."""
    if setting["kind"] == "choice":
        return f"Literal[{', '.join(f'{chr(34)}{word}{chr(34)}' for word in setting['words'])}]"
    plain = "float | str" if setting["kind"] == "number" and setting["words"] else "float"
    if setting["kind"] in SEVERAL and setting["name"] not in FORMS:
        return SEVERAL[setting["kind"]]
    return FORMS.get(setting["name"], plain if setting["kind"] == "number" else "str")


def arguments(options, own=()):
    """The lines of a function's settings but those that it declares itself."""
    return "\n".join(f"    {name}: bool = False," if setting["kind"] == "flag" else f"    {name}: {type_of(setting)} | None = None,"
                     for name, setting in declared(options).items() if name not in own)


def stub():
    """The text of recordings.pyi."""
    return STUB.format(extract=arguments(native.ExtractOptions), moduli=arguments(native.ModuliOptions),
                       time_course=arguments(native.TimeCourseOptions),
                       population=arguments(native.PopulationOptions),
                       plan=arguments(native.PlanOptions, ("radius_um", "young_modulus_kPa")))


if __name__ == "__main__":
    print(stub(), end="")
