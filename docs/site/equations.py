"""Equations of the documents: typeset by KaTeX when the site is built, found by their labels.

A label stands in a paragraph of its own above a ```math block, or at the beginning of a step of a list. Wherever else a
text names it, it becomes a link.
"""
import html
import json
import re
import subprocess
from pathlib import Path

from docutils import nodes
from sphinx.transforms import SphinxTransform
from sphinx.util import logging
from sphinx.util.nodes import make_refnode

LABEL = re.compile(r"eq:[a-z][a-z0-9-]*")
logger = logging.getLogger(__name__)


class Typesetter:
    """KaTeX in a process of Node.js, started with the first formula."""

    def __init__(self, katex):
        self.katex, self.process = katex, None

    def html(self, tex, display, place):
        if self.process is None:
            program = Path(__file__).with_name("typeset.mjs")
            self.process = subprocess.Popen(["node", program, self.katex], text=True, encoding="utf-8",
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if "error" in answer:
            logger.warning("the formula %r cannot be typeset: %s", tex, answer["error"], location=place)
        return answer.get("html", f"<code>{html.escape(tex)}</code>")

    def close(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait()


class LabelledEquations(SphinxTransform):
    """Gives equations the names of their labels, which are then shown beside them."""

    default_priority = 400

    def apply(self):
        for literal in list(self.document.findall(nodes.literal)):
            paragraph, label = literal.parent, literal.astext()
            if not LABEL.fullmatch(label) or not isinstance(paragraph, nodes.paragraph) or paragraph.index(literal) > 0:
                continue
            block = paragraph.next_node(descend=False, siblings=True)
            if len(paragraph) == 1 and isinstance(block, nodes.math_block):
                target = block
                block["label_text"] = label
                paragraph.parent.remove(paragraph)
            elif isinstance(paragraph.parent, nodes.list_item):
                target = literal
            else:
                continue
            target["ids"].append(label.replace(":", "-"))
            self.env.equations_of_documents[label] = self.env.docname


def link_labels(app, doctree, docname):
    """Names of equations lead to them."""
    for literal in list(doctree.findall(nodes.literal)):
        label = literal.astext()
        home = app.env.equations_of_documents.get(label)
        if LABEL.fullmatch(label) and not literal["ids"]:
            if home is None:
                logger.warning("no equation has the label %s", label, location=literal)
            elif not isinstance(literal.parent, nodes.reference):
                identifier = label.replace(":", "-")
                literal.replace_self(make_refnode(app.builder, docname, home, identifier, literal.deepcopy()))


def visit_inline(translator, node):
    translator.body.append(translator.builder.app.typesetter.html(node.astext(), False, node))
    raise nodes.SkipNode


def visit_block(translator, node):
    label = node.get("label_text")
    held = node.parent["ids"] == node["ids"]  # themes put formulas into containers, which take their names
    identifier = f' id="{node["ids"][0]}"' if label and not held else ""
    link = f'<a class="equation-label" href="#{node["ids"][0]}">{label}</a>' if label else ""
    formula = translator.builder.app.typesetter.html(node.astext(), True, node)
    translator.body.append(f'<div class="equation"{identifier}>{formula}{link}</div>\n')
    raise nodes.SkipNode


def begin(app):
    app.env.equations_of_documents = {}
    app.typesetter = Typesetter(app.config.katex_package)


def setup(app):
    app.add_config_value("katex_package", None, "env")
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
    app.add_transform(LabelledEquations)
    app.connect("builder-inited", begin)
    app.connect("doctree-resolved", link_labels)
    app.connect("build-finished", lambda app, exception: app.typesetter.close())
    return {"parallel_read_safe": False, "parallel_write_safe": False}
