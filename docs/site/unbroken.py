"""Numbers such as 7.9e-6 stay on one line in the narrow columns of tables; browsers would break them behind the minus."""
import re

from docutils import nodes

NUMBER = re.compile(r"([-+]?\d[\d.]*e-\d+)")


def keep_numbers_whole(app, doctree, docname):
    for entry in doctree.findall(nodes.entry):
        for text in list(entry.findall(nodes.Text)):
            parts = NUMBER.split(text.astext())
            if len(parts) > 1 and not isinstance(text.parent, (nodes.literal, nodes.math)):
                whole = [nodes.inline("", part, classes=["number"]) if at % 2 else nodes.Text(part)
                         for at, part in enumerate(parts) if part]
                text.parent.replace(text, whole)


def setup(app):
    app.connect("doctree-resolved", keep_numbers_whole)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
