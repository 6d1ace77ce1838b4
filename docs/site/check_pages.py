"""Whether the pages of the site hold together: check_pages.py FOLDER.

Every link within the site leads to a file and to a place in it, and no page, style or program would load anything from
elsewhere. Links that a reader follows may lead out.
"""
import re
import sys
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# What a browser loads with a page; of <link> only these kinds.
LOADED = {("img", "src"), ("img", "srcset"), ("script", "src"), ("iframe", "src"), ("source", "src"), ("source", "srcset"),
          ("video", "src"), ("audio", "src"), ("object", "data"), ("embed", "src"), ("form", "action"), ("use", "href"),
          ("image", "href")}
LINKED_FILES = {"stylesheet", "icon", "preload", "modulepreload", "prefetch", "preconnect", "dns-prefetch", "manifest"}
FOREIGN = re.compile(r"(?:https?:)?//", re.IGNORECASE)
FOREIGN_IN_STYLE = re.compile(r"(?:url\(\s*['\"]?|@import\s+['\"])((?:https?:)?//[^)'\"]*)", re.IGNORECASE)
# Programs ask for addresses by these; addresses in their comments and messages load nothing.
FOREIGN_IN_PROGRAM = re.compile(r"""(?:fetch|open|import|importScripts|src\s*=|href\s*=|Worker|EventSource|WebSocket)\s*\(?\s*
                                    ['"`]((?:https?:|wss?:)?//[^'"`]*)""", re.IGNORECASE | re.VERBOSE)


class Page(HTMLParser):
    """The links of a page, the names of its places, and what it loads."""

    def __init__(self, text):
        super().__init__()
        self.links, self.places, self.loaded, self.styles = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = {name: value or "" for name, value in attrs}
        self.places += [given["id"]] if "id" in given else []
        self.styles.append(given.get("style", ""))
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if tag == "link" and LINKED_FILES & set(given.get("rel", "").split()):
            self.loaded.append(given["href"])
        self.loaded += [given[name] for name in given if (tag, name) in LOADED]

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)


def target_of(page, link):
    """The file and the place in it to which a link of a page leads."""
    parts = urlsplit(link)
    file = (page.parent / unquote(parts.path)).resolve() if parts.path else page.resolve()
    return (file / "index.html" if file.is_dir() else file), unquote(parts.fragment)


def defects(folder):
    """Pairs of a file and a sentence."""
    pages = {file.resolve(): Page(file.read_text(encoding="utf-8")) for file in sorted(folder.rglob("*.html"))}
    for file, page in pages.items():
        yield from ((file, f"has several places called {place}") for place, count in Counter(page.places).items() if count > 1)
        yield from ((file, f"loads {address}") for address in page.loaded if FOREIGN.match(address))
        for style in page.styles:
            yield from ((file, f"loads {address}") for address in FOREIGN_IN_STYLE.findall(style))
        for link in dict.fromkeys(page.links + page.loaded):
            if FOREIGN.match(link) or link.startswith(("mailto:", "data:")):
                continue
            target, place = target_of(file, link)
            if not target.is_file():
                yield file, f"leads to {link}, which is not there"
            elif place and target in pages and place not in pages[target].places:
                yield file, f"leads to {link}, where no such place is"
    for pattern, suffix in ((FOREIGN_IN_STYLE, ".css"), (FOREIGN_IN_PROGRAM, ".js")):
        for file in folder.rglob(f"*{suffix}"):
            yield from ((file, f"loads {address}") for address in pattern.findall(file.read_text(encoding="utf-8")))


def main():
    folder = Path(sys.argv[1])
    found = list(defects(folder))
    for file, sentence in found:
        print(f"{file.relative_to(folder.resolve()) if file.is_absolute() else file}: {sentence}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
