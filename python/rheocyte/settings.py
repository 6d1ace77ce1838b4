"""Settings of what reads recordings, as the program declares them: arguments of functions, with their documentation."""

import functools
import inspect
import re
import textwrap
import warnings
from collections.abc import Mapping

import numpy as np

from rheocyte.arrays import number, numbers, truth
from rheocyte.errors import UserError
from rheocyte.paths import path, word
from rheocyte.stiffness_tables import place_of_table


_PLACE = re.compile(r"^( *)\{settings\}$", re.MULTILINE)  # in the documentation of a function


def declared(options):
    """The settings of a class of options of the compiled module, as dictionaries by their names."""
    return {setting["name"]: setting for setting in options.declared()}


def with_settings(options):
    """Gives a function the settings of these options as arguments in place of its `**settings`, and in place of
    {settings} in its documentation."""
    known = declared(options)

    def decorate(function):
        signature = inspect.signature(function)
        own = [each for each in signature.parameters.values() if each.kind is not each.VAR_KEYWORD]
        names = {each.name for each in own}
        added = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=_default(setting))
                 for name, setting in known.items() if name not in names]
        last = [each for each in own if each.kind is each.KEYWORD_ONLY]

        @functools.wraps(function)
        def called(*args, **given):
            arguments = {name: given.pop(name) for name in [*given] if name in names}
            return function(*args, **arguments, **_named(given, known, function.__name__))

        called.__signature__ = signature.replace(parameters=[*own[:len(own) - len(last)], *added, *last])
        called.__doc__ = _PLACE.sub(lambda place: "\n".join(_documented(each, place[1]) for each in known.values()),
                                    function.__doc__)
        return called

    return decorate


def filled(options, settings):
    """The options with these values."""
    known = declared(type(options))
    for name, value in settings.items():
        if value is not None:
            options.take(name, _taken(known[name], value))
    return options


def gated(settings):
    """Features on which limits and polygons look."""
    polygons = settings.get("polygon")
    axes = {axis for axes in polygons for axis in axes} if isinstance(polygons, Mapping) else set()
    return {*(settings.get("min") or {}), *(settings.get("max") or {}), *(axis.removeprefix("log:") for axis in axes)}


def _default(setting):
    return False if setting["kind"] == "flag" else None


def _named(given, known, function):
    """The values by today's names; UserError for a name that is none."""
    former = {setting["former"]: setting for setting in known.values() if setting["former"]}
    settings = {}
    for name, value in given.items():
        setting = known.get(name) or former.get(name)
        if not setting:
            raise UserError(f"{function} has no argument {name!r}; there are {', '.join(known)}.")
        if name in former:
            today, is_flag = setting["name"], setting["kind"] == "flag"
            if today in given:
                raise UserError(f"{function}: {name} is the former name of {today}; give one of them.")
            value = not truth(value, name) if is_flag else value
            stated = [f"{name}=False", f"{today}=True"] if is_flag else [name, today]
            warnings.warn(f"{function}: {stated[0]} is now called {stated[1]}; this version still reads the old name.",
                          FutureWarning, stacklevel=3)
        settings[setting["name"]] = value
    return settings


def _documented(setting, indent):
    text = _SAID.get(setting["name"], setting["sentence"])
    if setting["greatest"] is not None:
        text += " (" + f"{setting['least']:g} .. {setting['greatest']:g} {setting['unit']}".strip() + ")"
    if setting["default"]:
        text += f"; default: {setting['default']}"
    return textwrap.fill(f"{setting['name']:<15} {text}", 124, initial_indent=indent, subsequent_indent=indent + " " * 16,
                         break_on_hyphens=False)


def _taken(setting, value):
    """The value as the compiled module takes it."""
    name, kind = setting["name"], setting["kind"]
    if name in _FORMS:
        return _FORMS[name](value, name)
    if kind == "flag":
        return truth(value, name)
    if kind in _SEVERAL:
        several = _SEVERAL[kind](value, name)
        if not several:
            raise UserError(f"{name} is empty; give one or several.")
        return several
    if kind == "number" and not (setting["words"] and isinstance(value, str)):
        return number(value, name)
    return word(value, name)


def _limits(limits, name):
    if not isinstance(limits, Mapping):
        raise UserError(f"{name} is {limits!r}; give a dictionary of features, such as {{\"area_ratio\": 1.05}}.")
    return [f"{feature}={number(limit, feature)!r}" for feature, limit in limits.items()]


def _doses(doses, name):
    if not isinstance(doses, Mapping):
        raise UserError(f"{name} is {doses!r}; give a dictionary of conditions, such as {{\"drug\": 0.05}}.")
    return [f"{condition}={number(dose, condition)!r}" for condition, dose in doses.items()]


def _polygons(polygons, name):
    """As the command line has them: descriptions, or names of files."""
    if isinstance(polygons, Mapping):
        return [f"{','.join(features)}={_corners(corners, name)}" for features, corners in polygons.items()]
    files = polygons if isinstance(polygons, (list, tuple)) else [polygons]
    names = [path(file, name) for file in files]
    for file in names:
        if not file.endswith(".poly"):
            hint = " Export those of a session of DCscope there as .poly." if file.endswith(".so2") else ""
            raise UserError(f"{name}: {file} is not a file of polygon filters (.poly).{hint}")
    return names


def _corners(corners, name):
    pairs = numbers(corners, name)
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise UserError(f"{name}: the corners have the shape {pairs.shape}; they must be pairs of numbers.")
    return ":".join(f"{x!r},{y!r}" for x, y in pairs.tolist())


# Settings of several values, of which one may stand alone.
_SEVERAL = {"numbers": lambda values, name: np.atleast_1d(numbers(values, name)).tolist(),
            "texts": lambda values, name: [word(each, name) for each in ([values] if isinstance(values, str) else values)]}

# Settings that are more than a number, a word or a flag here.
_FORMS = {"table": lambda value, _: place_of_table(value), "min": _limits, "max": _limits, "polygon": _polygons, "dose": _doses}
_SAID = {"min": 'minimum values of features: min={"area_um": 40}', "max": 'maximum values: max={"area_ratio": 1.05}',
         "dose": 'doses of conditions: dose={"drug": 0.05}; the first condition has dose 0 by default',
         "polygon": 'corners in the plane of two features: {("area_um", "deform"): [(40, 0.01), (90, 0.01), (90, 0.1)]}; edges '
                    'are straight over the logarithm of "log:area_um"; or the name of a file of polygon filters of DCscope or '
                    "dclab (.poly), or a list of such names"}
