"""What the Python package declares, in stubs or in its sources, and what its sources say about it, read without importing either."""
import ast
import re


class Module:
    """A module of the package: signatures by its stub, where it has one, and docstrings by its source."""

    def __init__(self, package, name):
        self.source_text = (package / f"{name}.py").read_text(encoding="utf-8")
        stub = package / f"{name}.pyi"
        self.stub_text = stub.read_text(encoding="utf-8") if stub.exists() else self.source_text
        self.source, self.stub = ast.parse(self.source_text), ast.parse(self.stub_text)
        self.aliases = {node.targets[0].id: node.value for node in ast.walk(self.stub)
                        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
                        and node.targets[0].id.startswith("_")}

    def declared(self, name):
        """The declarations of this name in the stub: several of an overloaded function."""
        return declarations(self.stub.body, name)

    def written(self, name):
        """The definition of this name in the source."""
        return named(self.source.body, name)[-1]

    def type_text(self, annotation):
        """A type with the stub's own abbreviations written out."""
        return ast.unparse(Spelled(self.aliases).visit(ast.parse(ast.unparse(annotation), mode="eval").body))

    def signature(self, function):
        """Arguments and result of a function as its stub has them, without `self`."""
        spelled = Spelled(self.aliases).visit(ast.parse(ast.unparse(function)).body[0])
        for arguments in (spelled.args.posonlyargs, spelled.args.args):
            if arguments and arguments[0].arg in ("self", "cls"):
                del arguments[0]
        returned = f" -> {ast.unparse(spelled.returns)}" if spelled.returns and spelled.name != "__init__" else ""
        return f"({ast.unparse(spelled.args)}){returned}"

    def remark(self, node):
        """The comment at the end of a declaration's line, in the stub or in the source."""
        for tree, text in ((self.source, self.source_text), (self.stub, self.stub_text)):
            if node in ast.walk(tree):
                _, _, comment = text.splitlines()[node.end_lineno - 1].partition("  # ")
                return comment
        return ""


class Spelled(ast.NodeTransformer):
    """Writes private names of a stub out: `_Path` as what it stands for, other ones without their underscore."""

    def __init__(self, aliases):
        self.aliases = aliases

    def visit_Name(self, node):
        if node.id in self.aliases:
            return self.visit(ast.parse(ast.unparse(self.aliases[node.id]), mode="eval").body)
        return ast.Name(node.id.lstrip("_"), node.ctx)


def names_of(node):
    """The names that a statement binds."""
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        return [node.name]
    if isinstance(node, ast.AnnAssign):
        return [node.target.id]
    if isinstance(node, ast.Assign):
        return [target.id for target in node.targets if isinstance(target, ast.Name)]
    return []


def named(statements, name):
    return [node for node in statements if name in names_of(node)]


def declarations(statements, name):
    """Those of this name; of an overloaded function not the one that does the work."""
    nodes = named(statements, name)
    overloads = [node for node in nodes if isinstance(node, ast.FunctionDef) and "overload" in decorators(node)]
    return overloads or nodes


def decorators(function):
    return {ast.unparse(decorator) for decorator in function.decorator_list}


def docstring(node):
    """The documentation of a function, a class, or a property that is made by `property(..., doc=...)`."""
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        return ast.get_docstring(node) or ""
    if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
        return next((keyword.value.value for keyword in node.value.keywords if keyword.arg == "doc"), "")
    return ""


def groups(package):
    """Headings of the package's documentation with their public names, and its other paragraphs."""
    text = ast.get_docstring(ast.parse((package / "__init__.py").read_text(encoding="utf-8")))
    first, _, *others = text.split("\n\n")
    return first, {group: re.findall(r" as (\w+)$", names, re.M) for group, names in listed(package)}, others


def listed(package):
    """(group, lines) of the list of public names."""
    return re.findall(r"^# (.+)\n((?:from .*\n)+)", (package / "__init__.pyi").read_text(encoding="utf-8"), re.M)


def modules(package):
    """{public name: module}"""
    return {name: module for _, lines in listed(package)
            for module, name in re.findall(r"^from rheocyte\.(\w+) import (\w+) as", lines, re.M)}
