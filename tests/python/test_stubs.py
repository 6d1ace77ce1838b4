"""The type stubs say what the package has."""

import ast
from pathlib import Path

import rheocyte
from rheocyte import case_stub

PACKAGE = Path(rheocyte.__file__).parent


def test_the_stub_of_cases_is_made_from_the_declared_keys():
    text = (PACKAGE / "cases.pyi").read_text(encoding="utf-8")
    assert text == case_stub.stub(), "run `python -m rheocyte.case_stub > python/rheocyte/cases.pyi`"
    ast.parse(text)


def test_the_stub_of_the_package_names_all_that_is_public():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    named = {alias.name: node.module for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert sorted(named) == rheocyte.__all__
    assert named == {name: f"rheocyte.{module}" for name, module in rheocyte._MODULES.items()}
    assert (PACKAGE / "py.typed").exists()
