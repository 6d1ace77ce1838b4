"""The sources of the documentation site: staging.py PROGRAM KATEX FOLDER.

Copies the documents of the tree into FOLDER and adds pages on commands and Python functions, navigation and the fonts of
equations. README.md becomes the index.md of its folder, which browsers and servers open first; documents keep their places
otherwise, so that their links hold.
"""
import os
import re
import shutil
import sys
from pathlib import Path

import command_pages
import python_pages

TOP = Path(__file__).resolve().parents[2]
DOCUMENTS = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md", "docs/figures/*.md"]
LINK = re.compile(r"\[([^\]]*)\]\(([^)#:\s]+)((?:#[^)]*)?)\)")
# Pages that are made here belong to this section of docs/README.md, behind its first texts.
REFERENCE = "Reference"


def documents():
    return sorted(file.relative_to(TOP) for pattern in DOCUMENTS for file in TOP.glob(pattern))


def staged_name(name):
    return name.with_name("index.md") if name.name == "README.md" else name


def write(folder, name, text):
    place = folder / name
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(text, encoding="utf-8")


def stage_target(folder, target):
    """The name in the site of what a document links to; files and folders that are no documents come along."""
    if target in documents():
        return staged_name(target)
    if (TOP / target).is_dir():
        if target / "README.md" in documents():
            return target / "index.md"
        files = sorted(file for file in (TOP / target).iterdir() if file.is_file())
        lines = "".join(f"* [{file.name}]({file.name})\n" for file in files)
        write(folder, target / "index.md", f"---\norphan: true\n---\n# Files of {target}\n\n{lines}")
        for file in files:
            shutil.copyfile(file, folder / target / file.name)
        return target / "index.md"
    (folder / target).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(TOP / target, folder / target)
    return target


def stage_document(folder, name):
    """The text of a document with its links as they are in the site, where names of files give way to titles."""
    def renamed(match):
        words, written, place = match.groups()
        target = Path(os.path.normpath(name.parent / written))
        staged = stage_target(folder, target)
        if words == written and staged.suffix == ".md":
            words = ""
        return f"[{words}]({os.path.relpath(staged, name.parent)}{place})"

    return LINK.sub(renamed, (TOP / name).read_text(encoding="utf-8"))


def sections_of_index():
    """Headings of docs/README.md with the documents that their tables link to, in this order."""
    index, found, heading = Path("docs/README.md"), {}, None
    for line in (TOP / index).read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            heading = line[3:].strip()
            found[heading] = []
        elif heading and line.startswith("|"):
            targets = (Path(os.path.normpath(index.parent / target)) for _, target, _ in LINK.findall(line))
            found[heading] += [target for target in targets if target not in found[heading]]
    return found


def navigation(made):
    """Hidden tables of contents, one for each section of docs/README.md."""
    text = "\n```{toctree}\n:hidden:\n\ndocs/index\n```\n"
    for heading, targets in sections_of_index().items():
        names = [str(staged_name(target).with_suffix("")) for target in targets if target != Path("README.md")]
        if heading == REFERENCE:
            names = made + names
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {heading}\n\n" + "\n".join(names) + "\n```\n"
    return text


def stage_katex(katex, folder):
    """KaTeX's style with the one format of fonts that today's browsers load."""
    style = (katex / "dist/katex.min.css").read_text(encoding="utf-8")
    style = re.sub(r',url\([^)]*\.(?:woff|ttf)\) format\("[a-z]+"\)', "", style)
    write(folder, "katex.css", style)
    (folder / "fonts").mkdir(exist_ok=True)
    for font in (katex / "dist/fonts").glob("*.woff2"):
        shutil.copyfile(font, folder / "fonts" / font.name)


def main():
    if len(sys.argv) != 4:
        sys.exit(f"error: {__doc__.splitlines()[0]}")
    program, katex, folder = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    for name in documents():
        write(folder, staged_name(name), stage_document(folder, name))
    for name, text in command_pages.pages(program).items():
        write(folder, name, text)
    for name, text in python_pages.pages(TOP / "python/rheocyte", program).items():
        write(folder, name, text)
    with open(folder / "index.md", "a", encoding="utf-8") as index:
        index.write(navigation(["commands/index", "python/index"]))
    stage_katex(katex, folder / "_static/katex")


if __name__ == "__main__":
    main()
