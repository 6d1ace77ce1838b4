"""Pages on the public names of the Python package, from its type stubs and docstrings."""
import ast
import re

from help_texts import entries, help_of, sections
from restructured_text import code, contents, entry, indented, sentence, table_of_links, title
from stubs import Module, declarations, decorators, docstring, groups, modules, named, names_of

# A line of a docstring on an argument: its name, two blanks or more, its meaning.
ARGUMENT = re.compile(r"(\S+(?: \S+)*?) {2,}(\S.*)")
SETTINGS = "{settings}"  # stands in docstrings for what rheocyte.settings declares


class Settings:
    """What stands for {settings} in a docstring: said by the package, or else by the help of the command."""

    def __init__(self, package, program):
        told = named(ast.parse((package / "settings.py").read_text(encoding="utf-8")).body, "_SAID")[-1]
        self.said, self.program = ast.literal_eval(told.value), program

    def of(self, function, written):
        """Names and meanings for a function by its stub, but not for those arguments that its source has itself."""
        own = {each.arg for each in (*written.args.args, *written.args.kwonlyargs)}
        taken = [each.arg for each in function.args.kwonlyargs if each.arg not in own]
        helped = entries(sections(help_of(self.program, function.name.replace("_", "-")))["Options"])
        texts = {name.split()[0].split(",")[-1].lstrip("-").replace("-", "_"): text for name, text in helped}
        return [(name, self.said.get(name, texts[name])) for name in taken]


def documentation(text, settings=()):
    """A docstring: paragraphs, and lists of arguments."""
    return "".join(block(part.splitlines(), settings) for part in re.split(r"\n\s*\n", text) if part.strip())


def block(lines, settings):
    """A call as code, or what stands before a list of arguments, and the list."""
    if lines[0].startswith(">>> "):
        return code("\n".join(lines), "pycon")
    starts = [bool(ARGUMENT.fullmatch(line)) or below.startswith(8 * " ") for line, below in zip(lines, [*lines[1:], ""])]
    begin = starts.index(True) if True in starts else len(lines)
    said, found = sentence(" ".join(lines[:begin])), []
    for line in lines[begin:]:
        if line.strip() == SETTINGS:
            found += [list(each) for each in settings]
        elif matched := ARGUMENT.fullmatch(line):
            found.append([matched[1], matched[2]])
        elif not line.startswith(" "):  # its meaning stands below
            found.append([line, ""])
        else:
            found[-1][1] += " " + line.strip()
    return (said + "\n\n" if said else "") + "".join(entry(name, sentence(text)) for name, text in found)


def directive(kind, signatures, body, type_text=""):
    lines = ("\n" + " " * len(f".. py:{kind}:: ")).join(signatures)
    option = f"   :type: {type_text}\n" if type_text else ""
    return f".. py:{kind}:: {lines}\n{option}\n{indented(body)}\n"


def function_text(module, declared, kind, settings=None, written=None):
    name = declared[-1].name
    signatures = [name + module.signature(each) for each in declared]
    text = docstring(written) if written else ""
    filled = settings.of(declared[-1], written) if settings and SETTINGS in text else ()
    return directive(kind, signatures, documentation(text, filled))


def member_text(module, declared, written):
    """A method, a property or an attribute of a class."""
    node = declared[-1]
    if isinstance(node, ast.AnnAssign):
        private = ast.unparse(node.annotation).startswith("_")
        said = module.remark(written or node)
        return directive("attribute", [node.target.id], sentence(said) + "\n" if said else "",
                         "" if private else module.type_text(node.annotation))
    if "property" in decorators(node):
        return directive("property", [node.name], documentation(docstring(written)), module.type_text(node.returns))
    kind = "classmethod" if "classmethod" in decorators(node) else "method"
    return function_text(module, declared, kind, written=written)


def class_text(module, name):
    declared, written = module.declared(name)[-1], module.written(name)
    started = named(declared.body, "__init__")
    body = documentation(docstring(written))
    members = dict.fromkeys(each for node in declared.body for each in names_of(node) if not each.startswith("_"))
    for member in members:
        body += member_text(module, declarations(declared.body, member), (named(written.body, member) or [None])[-1])
    return directive("class", [name + (module.signature(started[0]) if started else "")], body)


def name_text(module, name, settings):
    declared = module.declared(name)
    if isinstance(declared[-1], ast.ClassDef):
        bases = {ast.unparse(base) for base in declared[-1].bases}
        return class_text(module, name) if not bases & {"ValueError", "ArithmeticError"} else directive(
            "exception", [name], documentation(docstring(declared[-1])))
    if isinstance(declared[-1], ast.FunctionDef):
        return function_text(module, declared, "function", settings, module.written(name))
    said = module.remark(module.written(name))
    return directive("data", [name], sentence(said) + "\n", module.type_text(declared[-1].annotation))


def returned(module, names, listed):
    """Classes of the module that these functions and classes give, and those that these give, but none that is listed."""
    texts = "".join(module.signature(node) for name in names for declared in module.declared(name)
                    for node in ast.walk(declared) if isinstance(node, ast.FunctionDef))
    classes = [node.name for node in module.stub.body if isinstance(node, ast.ClassDef)]
    found = [name for name in classes if name not in listed and re.search(rf"-> {name}\b", texts)]
    return found + returned(module, found, listed | {*found}) if found else []


def pages(package, program):
    """{file: text} of the pages, one for each group of names, with an index."""
    first, grouped, paragraphs = groups(package)
    home, settings, found, rows = modules(package), Settings(package, program), {}, []
    listed = {name for names in grouped.values() for name in names}
    for heading, names in grouped.items():
        loaded = {name: Module(package, home[name]) for name in names}
        text = title(heading) + ".. py:currentmodule:: rheocyte\n\n"
        text += "".join(name_text(module, name, settings) for name, module in loaded.items())
        for part in dict.fromkeys(home[name] for name in names):
            module = loaded[next(name for name in names if home[name] == part)]
            text += "".join(class_text(module, name) for name in returned(module, names, listed))
        page = heading.lower().replace(" ", "-")
        found[f"python/{page}.rst"] = text
        rows.append((page, heading, ", ".join(f"`{name}`" for name in names)))
    index = title("Python functions") + ".. py:module:: rheocyte\n\n" + sentence(first) + "\n\n"
    index += "".join(sentence(text) + "\n\n" for text in paragraphs) + table_of_links(rows)
    found["python/index.rst"] = index + contents(page for page, *_ in rows)
    return found
