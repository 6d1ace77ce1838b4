"""Cells in the channel of real-time deformability cytometry (RT-DC): shapes, tables, Young's moduli.

{names}

UserError is a ValueError. Lengths are in um, areas in um2, velocities in m/s, pressures in Pa, Young's moduli in kPa, moduli of a
cortex in mN/m: every name carries its unit. `help(rheocyte.solve)` and docs/python.md say more.

Names are loaded when they are first used. Without the compiled module the pictures of `rheocyte.picture` and its
neighbours, which need numpy and matplotlib only, work all the same.
"""

import importlib
import re
from pathlib import Path

# The list for type checkers is ours, too: a function is declared there once.
_GROUPS = {group: {name: module for module, name in re.findall(r"^from rheocyte\.(\w+) import (\w+) as", lines, re.M)}
           for group, lines in re.findall(r"^# (.+)\n((?:from .*\n)+)",
                                          Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"), re.M)}
_MODULES = {name: module for names in _GROUPS.values() for name, module in names.items()}
__all__ = sorted(_MODULES)
__doc__ = (__doc__ or "").replace("{names}", "\n".join(f"{group:<22}{', '.join(names)}" for group, names in _GROUPS.items()))


def __getattr__(name):
    if name == "__version__":
        return importlib.import_module("rheocyte.native_module").native.version
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{__name__}.{_MODULES[name]}"), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *_MODULES, "__version__"})
