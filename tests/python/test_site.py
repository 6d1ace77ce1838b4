"""The pages of the documentation site on Python say what the package says."""

import re
import sys
from pathlib import Path

import pytest

import rheocyte

TOP = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / "docs/site"), str(TOP / "tools")]
import python_pages  # noqa: E402 (its folders are named just above)
from stubs import Module  # noqa: E402


@pytest.mark.parametrize("name", ["extract", "moduli", "time_course", "population"])
def test_the_settings_of_a_function_read_as_its_help_does(program, name):
    package = Path(rheocyte.__file__).parent
    module = Module(package, "recordings")
    settings = python_pages.Settings(package, program).of(module.declared(name)[-1], module.written(name))
    assert "viscosity_mPas" in dict(settings)
    helped = " ".join(getattr(rheocyte, name).__doc__.split()).replace("e-0", "e-").replace("e+0", "e")
    assert [pair for pair in settings if " ".join(pair) not in helped] == []


def test_every_public_name_has_its_place(program):
    text = "".join(python_pages.pages(Path(rheocyte.__file__).parent, program).values())
    declared = set(re.findall(r"^\.\. py:(?:class|function|exception|data):: (\w+)", text, re.MULTILINE))
    assert set(rheocyte.__all__) <= declared
