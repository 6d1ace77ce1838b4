"""How Sphinx makes the documentation site from what staging.py has laid out; tools/site calls it."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

project = "rheocyte"
copyright = "the developers of rheocyte"
extensions = ["myst_parser", "equations", "unbroken"]
root_doc = "index"

# The documents are written for forges: $...$ and ```math blocks, links to headings by their words.
myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4
myst_dmath_double_inline = False

smartquotes = False  # much of what is quoted is to be typed
nitpicky = True
# Types of other packages in the signatures of functions, whose documentation is not part of this site.
nitpick_ignore_regex = [("py:class", r"(np|pandas|os)\..*|.*(PathLike|Mapping|Sequence|Callable|Iterator|KeysView|Executor"
                         r"|Path|ArrayLike|NDArray|Figure|Fields|Dataset|Any|Literal)")]
python_maximum_signature_line_length = 80
add_module_names = False
highlight_language = "text"

html_theme = "furo"
html_title = "rheocyte"
html_css_files = ["katex/katex.css", "site.css"]
html_js_files = ["site.js"]
html_math_renderer = "katex"
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}


def setup(app):
    app.config.html_static_path = [str(Path(app.srcdir, "_static")), str(HERE / "style")]
