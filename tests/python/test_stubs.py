"""The type stubs say what the package has."""

import ast
import importlib
import inspect
from pathlib import Path

import pytest

import rheocyte
from rheocyte import case_stub, recordings_stub

PACKAGE = Path(rheocyte.__file__).parent


def test_the_stub_of_cases_is_made_from_the_declared_keys():
    text = (PACKAGE / "cases.pyi").read_text(encoding="utf-8")
    assert text == case_stub.stub(), "run `python -m rheocyte.case_stub > python/rheocyte/cases.pyi`"
    ast.parse(text)


def test_the_stub_of_recordings_is_made_from_the_declared_settings():
    text = (PACKAGE / "recordings.pyi").read_text(encoding="utf-8")
    assert text == recordings_stub.stub(), "run `python -m rheocyte.recordings_stub > python/rheocyte/recordings.pyi`"


def test_the_stub_of_the_package_names_all_that_is_public():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    named = {alias.name: node.module for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert sorted(named) == rheocyte.__all__
    assert named == {name: f"rheocyte.{module}" for name, module in rheocyte._MODULES.items()}
    assert (PACKAGE / "py.typed").exists()


def arguments(function):
    """Names and kinds, and what is optional."""
    a = function.args
    first = len(a.args) - len(a.defaults)
    plain = [(arg.arg, i >= first) for i, arg in enumerate(a.args) if arg.arg not in ("self", "cls")]
    return plain + [(arg.arg, default is not None) for arg, default in zip(a.kwonlyargs, a.kw_defaults)]


def functions(tree):
    """Functions and methods of a module that users see, by their names; of overloads the last one."""
    found = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = arguments(node)
        elif isinstance(node, ast.ClassDef):
            found |= {f"{node.name}.{name}": value for name, value in functions(node).items()}
    return {name: value for name, value in found.items() if not any(part.startswith("_") for part in name.split("."))}


@pytest.mark.parametrize("module", ["populations", "recordings"])
def test_the_stub_of_a_module_has_its_functions_with_their_arguments(module):
    loaded = importlib.import_module(f"rheocyte.{module}")
    source = ast.parse(inspect.getsource(loaded))
    typed = functions(ast.parse((PACKAGE / f"{module}.pyi").read_text(encoding="utf-8")))
    for name, wanted in functions(source).items():
        if signature := getattr(getattr(loaded, name, None), "__signature__", None):  # with settings
            wanted = [(each.name, each.default is not each.empty) for each in signature.parameters.values()]
        assert typed.pop(name) == wanted, name
    assert not typed


@pytest.mark.parametrize("module", ["analytical_model", "in_time", "states", "stiffness_tables"])
def test_other_modules_have_types_of_their_own(module):
    source = ast.parse(inspect.getsource(importlib.import_module(f"rheocyte.{module}")))
    public = [node for part in source.body for node in ([part] if isinstance(part, ast.FunctionDef) else getattr(part, "body", []))
              if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and not getattr(part, "name", "").startswith("_")]
    overloaded = {node.name for node in public if any(ast.unparse(each) == "overload" for each in node.decorator_list)}
    assert public
    for node in public:
        arguments_of = [*node.args.args, *node.args.kwonlyargs]
        untyped = [a.arg for a in arguments_of if a.annotation is None and a.arg not in ("self", "cls")]
        assert node.name in overloaded or (node.returns is not None and not untyped), (node.name, untyped)
