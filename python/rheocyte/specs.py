"""Specs of tables and virtual recordings: files or dictionaries of the keys that `rheocyte help table|synth` explains."""

import json
import os
from collections.abc import Mapping
from pathlib import Path

from rheocyte.cases import flat_keys
from rheocyte.errors import UserError
from rheocyte.paths import path


def read_spec(spec, overrides, function):
    """Text of a spec, what stands for it in messages (of a file its name, in bytes), and the overrides as lines "key=value"."""
    settings = _toml(((key.replace("__", "."), value) for key, value in overrides.items()), function).splitlines()
    if isinstance(spec, Mapping):
        return _toml(flat_keys(spec), function), "the dictionary", settings
    if not isinstance(spec, (str, os.PathLike)):
        raise UserError(f"{function}: {type(spec).__name__} is not a spec; give a path or a dictionary.")
    file = path(spec, "the spec")
    try:
        return Path(file).read_text(encoding="utf-8"), os.fsencode(file), settings
    except (OSError, UnicodeDecodeError) as failure:
        raise UserError(f"{file}: cannot be read ({failure}).") from failure


def _toml(pairs, function):
    """Lines of TOML: its numbers, truths, texts and lists are those of JSON."""
    lines = []
    for key, value in pairs:
        try:
            lines.append(f"{key}={json.dumps(value, allow_nan=False)}\n")
        except (TypeError, ValueError) as failure:
            raise UserError(f"{function}: {key} = {value!r} is not a finite number, a text or a list of them.") from failure
    return "".join(lines)
