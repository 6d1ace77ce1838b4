"""Cases: what is to be solved. Keys, units, ranges and sentences come from the declarations in src/case."""

import os
from collections.abc import Mapping

from rheocyte.errors import UserError
from rheocyte.native_module import native
from rheocyte.paths import path

_KEYS = {key["name"]: key for key in native.case_keys()}
_SECTIONS = {name[:end] for name in _KEYS for end in range(len(name)) if name[end] == "."}
_FORMER = {key["former_name"]: name for name, key in _KEYS.items() if key["former_name"]}


def case_keys():
    """All keys of a case, in the order of the documents.

    Returns a list of dictionaries: name (dotted, with its unit), unit, sentence, allowed (range or words), default (as
    text, None if there is none), condition (where it has an effect), option (its name on command lines), former_name,
    type, options.
    """
    return [dict(key) for key in _KEYS.values()]


def _aliases():
    """Short names of keys: their options on command lines, then the last parts that only one key has."""
    aliases = {}
    for name in _KEYS:
        aliases.setdefault(name.rsplit(".", 1)[1], []).append(name)
    short = {last: names[0] for last, names in aliases.items() if len(names) == 1}
    short.update({key["option"].strip("-").replace("-", "_"): name for name, key in _KEYS.items() if key["option"]})
    return short


_ALIASES = _aliases()


def _full_name(name):
    """The key that a keyword means; an unknown one stays, for the sentence that refuses it."""
    dotted = name.replace("__", ".")
    return dotted if dotted in _KEYS else _ALIASES.get(name, dotted)


def flat_keys(values, prefix=""):
    """Pairs of a dotted key and its value from nested dictionaries."""
    for name, value in values.items():
        if not isinstance(name, str) or not name.isprintable():
            raise UserError(f"Case: the key {name!r} is not a text; write \"cell.radius_um\".")
        full = prefix + name
        if isinstance(value, Mapping) and (value or full in _SECTIONS):
            yield from flat_keys(value, full + ".")
        else:
            yield full, value


class _Section:
    """The keys below a dot: case.cell.bulk."""

    __slots__ = ("_case", "_prefix")

    def __init__(self, case, prefix):
        object.__setattr__(self, "_case", case)
        object.__setattr__(self, "_prefix", prefix)

    def __getattr__(self, name):
        return self._case._read(self._prefix + name)

    def __setattr__(self, name, value):
        self._case._write(self._prefix + name, value)

    def __dir__(self):
        return sorted({name[len(self._prefix):].split(".")[0] for name in _KEYS if name.startswith(self._prefix)})

    def __repr__(self):
        return f"<{self._prefix.rstrip('.')} of {self._case!r}>"


class Case:
    """One cell in its channel, complete and checked: every value is inside its range.

    Case(source=None, **overrides)

    source      path of a TOML file, a nested or dotted dictionary, another Case, or None
    overrides   keys that replace those of the source: by the option of the command line (radius_um,
                young_modulus_kPa, channel_width_um, flow_rate_ul_s, viscosity_mPas), by the last part of the key where
                only one key has it, or in full with two underscores for each dot (cell__bulk__law)

    Keys are attributes with the names of case files: case.cell.bulk.young_modulus_kPa. One that has no effect in the
    case is None. Setting one checks the whole case again; the case stays as it was if that fails. UserError (a
    ValueError) names the key, its value, its range and the nearest known key.

    >>> case = rheocyte.Case({"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15}},
    ...                      radius_um=7.66, young_modulus_kPa=1.5)
    >>> case.cell.bulk.young_modulus_kPa = 2
    """

    __slots__ = ("_stated", "_values", "_nested")

    def __init__(self, source=None, **overrides):
        if isinstance(source, Case) and not overrides:
            self._keep(source._stated, source._values, source._nested)  # which never change, they are replaced
            return
        replaced = dict(flat_keys({_full_name(name): value for name, value in overrides.items()}))
        if isinstance(source, (str, os.PathLike)):
            file = path(source, "the case")
            native.CaseValues.from_file(file, list(replaced.items()))  # reports mistakes with their lines
            stated = dict(native.stated_in_file(file))
        elif isinstance(source, Case):
            stated = dict(source._stated)
        elif source is None or isinstance(source, Mapping):
            stated = dict(flat_keys(source or {}))
        else:
            raise UserError(f"Case: {type(source).__name__} is not a source of a case; give a path or a dictionary.")
        self._take(stated, replaced)

    def _take(self, stated, replaced):
        """Completes what is stated; a stated key that loses its effect by one that replaces others is forgotten."""
        values = native.CaseValues.from_keys(list(stated.items()), list(replaced.items()))
        nested = values.nested()
        named = {_FORMER.get(name, name): value for name, value in (stated | replaced).items()}
        has_effect = dict(flat_keys(nested))
        self._keep({name: value for name, value in named.items() if name in has_effect}, values, nested)

    def _keep(self, stated, values, nested):
        object.__setattr__(self, "_stated", stated)
        object.__setattr__(self, "_values", values)
        object.__setattr__(self, "_nested", nested)

    def _read(self, name):
        if name in _SECTIONS:
            return _Section(self, name + ".")
        if name not in _KEYS:
            raise AttributeError(f"a case has no key {name!r}; rheocyte.case_keys() lists them")
        value = self._nested
        for part in name.split("."):
            value = value.get(part) if isinstance(value, dict) else None
        return value

    def _write(self, name, value):
        if name in _SECTIONS:
            if not isinstance(value, Mapping):
                raise UserError(f"Case: {name} is a section; set its keys, or give it a dictionary.")
            self._take(self._stated, dict(flat_keys(value, name + ".")))
        elif name in _KEYS:
            self._take(self._stated, {name: value})
        else:
            raise AttributeError(f"a case has no key {name!r}; rheocyte.case_keys() lists them")

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return self._read(name)

    def __setattr__(self, name, value):
        self._write(name, value)

    def __dir__(self):
        return sorted({*(name.split(".")[0] for name in _KEYS), *super().__dir__()})

    def replace(self, **overrides):
        """A copy with other values; keywords as for Case."""
        return Case(self, **overrides)

    def to_dict(self):
        """All keys that have an effect, nested as in a case file."""
        return self._values.nested()

    def to_toml(self):
        """A case file that gives the same case to the last bit."""
        return self._values.toml()

    @property
    def hash(self):
        """Fingerprint as in result.json (case_hash): equal for equal cases."""
        return self._values.hash()

    def __eq__(self, other):
        return self.hash == other.hash if isinstance(other, Case) else NotImplemented

    def __hash__(self):
        return hash(self.hash)

    def __reduce__(self):
        return Case, (self.to_dict(),)

    def __repr__(self):
        keys = ", ".join(f"{name}={value!r}" for name, value in flat_keys(self._nested))
        return f"Case({keys})"
