"""The commands and snippets of docs/recipes.md run as they are printed, one after the other in one folder."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import rheocyte
from conftest import TOP

BLOCK = re.compile(r"^```(bash|python)\n(.*?)^```$", re.M | re.S)
BLOCKS = BLOCK.findall((TOP / "docs" / "recipes.md").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    """A folder with the recordings and the examples that the recipes name."""
    place = tmp_path_factory.mktemp("recipes")
    (place / "examples").symlink_to(TOP / "examples")
    for name, seed in (("M1_data.rtdc", 1), ("M2_data.rtdc", 2)):
        rheocyte.synth(TOP / "examples/recordings/virtual-cells.toml", place / name, recording__cells=200, recording__seed=seed)
    return place


@pytest.mark.parametrize("kind, text", [pytest.param(*block, id=f"{k}-{block[0]}") for k, block in enumerate(BLOCKS)])
def test_a_recipe_runs(kind, text, folder, program):
    if re.match(r"# \d+ minutes", text):
        pytest.skip("it takes minutes")
    path = os.pathsep.join([str(Path(program).parent), os.environ["PATH"]])
    command = ["bash", "-euc", text] if kind == "bash" else [sys.executable, "-c", text]
    said = subprocess.run(command, cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True, check=False)
    assert said.returncode == 0, said.stderr
    print(said.stdout)
