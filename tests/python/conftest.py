"""Cases and recordings that several tests take."""

import os
from pathlib import Path

import pytest

TOP = Path(__file__).resolve().parents[2]
REFERENCE = TOP.parent / "shared" / "reference"
CELLS = {"recording": {"cells": 300, "seed": 5}, "channel": {"width_um": 20},
         "flow": {"rate_ul_per_s": 0.04, "medium": "CellCarrier", "temperature_C": {"mean": 23, "sd": 0.3}},
         "cell": {"radius_um": {"mean": 5.5, "sd": 0.2},
                  "bulk": {"young_modulus_kPa": {"mean": 8, "sd": 0.5, "distribution": "lognormal"}}}}
PAPER = {"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
         "cell": {"radius_um": 7.66, "bulk": {"young_modulus_kPa": 4.0}}, "numerics": {"accuracy": 1e-3}}


@pytest.fixture
def paper():
    """The keys of a cell like the paper's, which solves in a fraction of a second."""
    return {section: dict(keys) for section, keys in PAPER.items()}


@pytest.fixture(scope="session")
def program():
    """The program, whose numbers the package's must equal."""
    named = os.environ.get("RHEOCYTE_PROGRAM")
    if not named:
        pytest.skip("RHEOCYTE_PROGRAM names no program")
    return named


@pytest.fixture(scope="session")
def top():
    """The folder of the sources."""
    return TOP


@pytest.fixture(scope="session")
def state():
    """One solved state."""
    import rheocyte

    return rheocyte.solve(PAPER)
