"""Words that no sentence of the program, the page or the documents has: what people would not say is rewritten."""
import ast
import re

WORDS = re.compile(r"\b(?:told|tells?|anew|likewise|nobody|whoever)\b", re.IGNORECASE)
# Codes and columns in files, which keep their names.
CODES = re.compile(r"\bnot-told-apart\b")
CODE_SPAN = re.compile(r"`[^`\n]*`")
ROOMS = ("src", "python", "page")
C_TOKEN = re.compile(r"""(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<raw>R"([^(\s]*)\(.*?\)\3")|(?P<text>"(?:\\.|[^"\\\n])*")"""
                     r"""|(?<!\w)'(?:\\.|[^'\\\n])+'""", re.S)
PAGE_TOKEN = re.compile(r"""(?P<comment>(?<![:\\])//[^\n]*|/\*.*?\*/)|(?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'"""
                        r"""|`(?:\\.|[^`\\])*`|(?<=>)[^<>{}=;()]*(?=<))""", re.S)


def _tokens(pattern, text):
    for match in pattern.finditer(text):
        if literal := match.group("text") or match.groupdict().get("raw"):
            yield text.count("\n", 0, match.start()) + 1, literal


def _python_texts(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.lineno, node.value


def texts(name, text):
    """(line, text) of what people read in a file: string literals of sources, all of a document."""
    if name.parts[0] in ROOMS and "tests" not in name.parts:
        if name.suffix in (".h", ".cc"):
            return _tokens(C_TOKEN, text)
        if name.suffix in (".ts", ".tsx"):
            return ((line, re.sub(r"\$\{[^{}]*\}", "", part)) for line, part in _tokens(PAGE_TOKEN, text))
        if name.suffix == ".py":
            return _python_texts(text)
    if name.suffix == ".md" and (name.parts[0] == "docs" or name.parts in (("README.md",), ("CHANGELOG.md",))):
        return [(1, CODE_SPAN.sub("", text))]
    return ()


def check_words(name, text):
    for line, part in texts(name, text):
        for offset, words in enumerate(part.split("\n")):
            for match in WORDS.finditer(CODES.sub("", words)):
                yield line + offset, f"\"{match.group()}\" is no word of our sentences: reports, gives, determines, again, also, no one"
