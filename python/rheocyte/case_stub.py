"""python -m rheocyte.case_stub: the type stub of the module cases, from the declared keys of a case."""

from rheocyte.cases import case_keys

HEAD = '''# Made by `python -m rheocyte.case_stub`; the keys are declared in src/case/case_keys.cc.
from collections.abc import Mapping
from os import PathLike
from typing import Any, Literal

def case_keys() -> list[dict[str, Any]]: ...
'''
METHODS = '''    def __init__(self, source: str | PathLike[str] | Mapping[str, Any] | Case | None = None, **overrides: Any) -> None: ...
    def replace(self, **overrides: Any) -> Case: ...
    def to_dict(self) -> dict[str, Any]: ...
    def to_toml(self) -> str: ...
    @property
    def hash(self) -> str: ...
'''


def tree_of(keys):
    """Nested dictionaries of the sections; keys are the leaves."""
    tree = {}
    for key in keys:
        *sections, last = key["name"].split(".")
        place = tree
        for section in sections:
            place = place.setdefault(section, {})
        place[last] = key
    return tree


def type_of(key):
    """The annotation of a key; None stands for one without effect."""
    if key["type"] == "str":
        return f"Literal[{', '.join(repr(option).replace(chr(39), chr(34)) for option in key['options'])}]"
    return {"float": "float | None", "list": "list[float] | None"}[key["type"]]


def class_of(name, tree, methods=""):
    """Classes of a section: those of the sections in it first."""
    lines, below = [], []
    for part, content in tree.items():
        if "name" in content:
            choice = content["type"] == "str" and content["condition"]
            lines.append(f"    {part}: {type_of(content)}{' | None' if choice else ''}  # {content['sentence']}")
        else:
            kind = f"_{part.capitalize()}" if name == "Case" else f"{name}{part.capitalize()}"
            below.append(class_of(kind, content))
            lines.append(f"    {part}: {kind}")
    return "".join(below) + f"\nclass {name}:\n" + "\n".join(lines) + "\n" + methods


def stub():
    """The text of cases.pyi."""
    return HEAD + class_of("Case", tree_of(case_keys()), METHODS)


if __name__ == "__main__":
    print(stub(), end="")
