"""The check of the site's pages on small sites: what is wrong is named, what is right passes."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/site"))
import check_pages  # noqa: E402 (the folder is named just above)


class Pages(unittest.TestCase):
    def defects(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                place = Path(folder, name)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(text, encoding="utf-8")
            return [sentence for _, sentence in check_pages.defects(Path(folder))]

    def test_links_to_pages_and_places_that_are_there_pass(self):
        self.assertEqual(self.defects({
            "index.html": '<p id="here"><a href="#here">a</a> <a href="docs/a.html#b">b</a> <a href="docs/a.html?q=1">c</a></p>',
            "docs/a.html": '<h1 id="b">B</h1><a href="..">up</a> <a href="../index.html">up</a><img src="c%20d.png"/>',
            "docs/c d.png": ""}), [])

    def test_links_that_lead_nowhere_are_named(self):
        self.assertEqual(self.defects({"index.html": '<a href="b.html">b</a><a href="#c">c</a><img src="d.png">'}),
                         ["leads to b.html, which is not there", "leads to #c, where no such place is",
                          "leads to d.png, which is not there"])

    def test_two_places_of_one_name_are_named(self):
        self.assertEqual(self.defects({"index.html": '<p id="a"></p><p id="a"></p>'}), ["has several places called a"])

    def test_links_out_that_a_reader_follows_pass(self):
        self.assertEqual(self.defects({"index.html": '<a href="https://doi.org/10.1">doi</a><link rel="canonical" href="https://a.b/">',
                                       "a.js": "// see https://a.b\nconst home = 'https://a.b';"}), [])

    def test_what_would_be_loaded_from_elsewhere_is_named(self):
        found = self.defects({
            "index.html": '<link rel="stylesheet" href="https://a.b/c.css"><script src="//a.b/c.js"></script>'
                          '<img src="http://a.b/c.png"><p style="background: url(https://a.b/d.png)"></p>',
            "a.css": "@import 'https://a.b/e.css'; @font-face { src: url(https://a.b/f.woff2) }",
            "a.js": "fetch('https://a.b/g')"})
        self.assertEqual(sorted(found), sorted(f"loads {address}" for address in (
            "https://a.b/c.css", "//a.b/c.js", "http://a.b/c.png", "https://a.b/d.png", "https://a.b/e.css",
            "https://a.b/f.woff2", "https://a.b/g")))


if __name__ == "__main__":
    unittest.main()
