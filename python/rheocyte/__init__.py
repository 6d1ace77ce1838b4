"""Cells in the channel of real-time deformability cytometry (RT-DC): shapes, tables, Young's moduli.

Solve a cell          Case, solve, Session, Result, evolve
Tables                Table, table, table_names, viscosity, STATES
Recordings            extract, moduli, time_course, features, synth, dclab_plugin
Populations           population, Population, plan
Small deformations    analytic
Mistakes              UserError (a ValueError), NoStateError
Keys of a case        case_keys

Lengths are in um, areas in um2, velocities in m/s, pressures in Pa, Young's moduli in kPa, moduli of a cortex in mN/m:
every name carries its unit. `help(rheocyte.solve)` and docs/python.md tell more.

Names are loaded when they are first used. Without the compiled module the pictures of `rheocyte.picture` and its
neighbours, which need numpy and matplotlib only, work all the same.
"""

import importlib

_MODULES = {
    "Case": "cases", "case_keys": "cases",
    "Result": "states", "Session": "states", "solve": "states",
    "Evolution": "in_time", "evolve": "in_time",
    "STATES": "stiffness_tables", "Table": "stiffness_tables", "table_names": "stiffness_tables",
    "dclab_plugin": "stiffness_tables", "table": "stiffness_tables", "viscosity": "stiffness_tables",
    "extract": "recordings", "features": "recordings", "moduli": "recordings", "synth": "recordings",
    "time_course": "recordings",
    "Population": "populations", "plan": "populations", "population": "recordings",
    "analytic": "analytical_model",
    "NoStateError": "errors", "UserError": "errors",
}
__all__ = sorted(_MODULES)


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
