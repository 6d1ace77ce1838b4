"""Plain sentences of helps and docstrings as reStructuredText."""
import re

DOCUMENT = re.compile(r"\bdocs/([\w-]+)\.md")
LABEL = re.compile(r"\beq:[a-z][a-z0-9-]*")


def escaped(text):
    return re.sub(r"([\\*_|`<>])", r"\\\1", text)


def sentence(text):
    """Words in backticks become code, documents of the tree links; the rest stays as it is."""
    parts = re.split(r"`([^`]*)`", " ".join(text.split()))
    return "".join(f"``{part}``" if at % 2 else plain(part) for at, part in enumerate(parts))


def plain(text):
    """Text without code: names of documents and labels of equations lead there."""
    found = []
    for part in re.split(rf"({DOCUMENT.pattern.replace('(', '(?:', 1)}|{LABEL.pattern})", text):
        if document := DOCUMENT.fullmatch(part):
            found.append(f":doc:`/docs/{document[1]}`")
        elif LABEL.fullmatch(part):
            found.append(f"``{part}``")
        else:
            found.append(escaped(part))
    return "".join(found)


def title(text, line="="):
    return f"{text}\n{line * len(text)}\n\n"


def indented(text):
    return "".join("   " + line if line.strip() else line for line in text.splitlines(keepends=True))


def code(text, language):
    return f".. code-block:: {language}\n\n{indented(text.rstrip())}\n\n"


def entry(name, text):
    """An entry of a list of definitions."""
    return f"``{name}``\n   {text}\n\n"


def table_of_links(rows):
    """Rows of a document, the title of its link, and a sentence."""
    lines = "".join(f"   * - :doc:`{name} <{target}>`\n     - {sentence(text)}\n" for target, name, text in rows)
    return f".. list-table::\n   :widths: auto\n\n{lines}\n"


def contents(names):
    return ".. toctree::\n   :hidden:\n\n" + "".join(f"   {name}\n" for name in names) + "\n"
