"""What can be set for recordings can be set on the command line, over HTTP, on the page and in Python, under one name."""

import ast
import inspect
import re
import subprocess
from pathlib import Path

import pytest

import rheocyte
from rheocyte import UserError
from test_recordings import CELLS
from test_view_recordings import View

STUB = ast.parse((Path(rheocyte.__file__).parent / "recordings.pyi").read_text(encoding="utf-8"))
# What says which files are read and written, and what is reported meanwhile.
OF_FILES = {"help", "output", "jobs", "recursive", "quiet", "no-tsv", "no-picture", "progress", "condition"}


@pytest.fixture(scope="module")
def cells(tmp_path_factory):
    file = tmp_path_factory.mktemp("settings") / "cells.rtdc"
    rheocyte.synth(CELLS, file, recording__cells=40)
    return file


def options(program, command):
    """As `--help` lists them, those of files apart."""
    told = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^  (?:-\w,)?--([\w-]+)", told, re.MULTILINE)) - OF_FILES


def arguments(name):
    """Of a function, by its signature, which the stub has, too; as options."""
    signature = inspect.signature(getattr(rheocyte, name)).parameters
    stub = next(node for node in STUB.body if isinstance(node, ast.FunctionDef) and node.name == name)
    assert [*signature] == [arg.arg for arg in (*stub.args.args, *stub.args.kwonlyargs)]
    return {each.replace("_", "-") for each in signature if each not in ("recording", "recordings", "conditions")} - OF_FILES


@pytest.mark.parametrize("function", ["extract", "moduli", "time_course", "population"])
def test_options_of_a_command_are_arguments_of_its_function(function, program):
    assert options(program, function.replace("_", "-")) == arguments(function)


def test_what_the_view_declares_are_the_options_of_extract(cells, program, tmp_path):
    """The page makes its fields from it (page/tests/recordings_program.test.mjs)."""
    view = View(tmp_path, cells)
    try:
        view.wait_until("/api/items", lambda items: items[0]["state"] != "loading")
        declared = view.json("GET", "/api/settings")
        for setting in declared:
            answer = view.json("POST", "/api/items/0/moduli", {setting["name"]: {}})
            assert answer["error"].startswith(setting["name"]) or "The setting table" in answer["error"]
    finally:
        view.close()
    assert {setting["option"].removeprefix("--") for setting in declared} == options(program, "extract")
    assert [setting["name"] for setting in declared] == [*inspect.signature(rheocyte.extract).parameters][1:-1]


def test_the_documentation_has_all_settings():
    for function in (rheocyte.extract, rheocyte.moduli, rheocyte.time_course, rheocyte.population):
        told = {line.split()[0] for line in inspect.getdoc(function).splitlines() if re.match(r"\w", line)}
        assert {*inspect.signature(function).parameters} <= told
        assert max(map(len, function.__doc__.splitlines())) <= 128


@pytest.mark.parametrize("former, today", [
    ({"least": {"area_um": 50}}, {"min": {"area_um": 50}}), ({"greatest": {"area_um": 100}}, {"max": {"area_um": 100}}),
    ({"polygons": {("area_um", "deform"): [(50, -1), (100, -1), (100, 2)]}},
     {"polygon": {("area_um", "deform"): [(50, -1), (100, -1), (100, 2)]}}),
    ({"pixelation": False}, {"no_pixelation": True}), ({"correct_area": False}, {"no_area_correction": True}),
    ({"asymmetry": False}, {"no_asymmetry": True})])
def test_former_names_are_still_read_with_one_sentence(former, today, cells):
    with pytest.warns(FutureWarning, match="extract: .* is now called .*; this version still reads the old name.") as told:
        frame = rheocyte.extract(cells, **former)
    assert len(told) == 1
    assert frame.equals(rheocyte.extract(cells, **today))
    with pytest.raises(UserError, match="is the former name of"):
        rheocyte.extract(cells, **former, **today)
