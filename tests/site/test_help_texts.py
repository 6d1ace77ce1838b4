"""The program's help, taken apart: names and sentences are distinguished wherever they stand."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
import help_texts  # noqa: E402 (the folder is named just above)

HELP = """compute something
Usage: rheocyte compute [OPTIONS] CASE

Positionals:
  CASE TEXT REQUIRED          the case, a file

Options:
  --quiet                     print nothing
  --radius-um NUMBER REQUIRED radius of the cell
  --temperature VALUE|feature|metadata
                              degC; or feature
  --continue DIR Excludes: --start
                              go on

For example: rheocyte compute a.toml; rheocyte help case
"""


class Help(unittest.TestCase):
    def entries(self, heading):
        return help_texts.entries(help_texts.sections(HELP)[heading])

    def test_sentence_usage_and_examples_are_found(self):
        found = help_texts.sections(HELP)
        self.assertEqual(" ".join(found[""]).strip(), "compute something")
        self.assertEqual(found["Usage"], ["rheocyte compute [OPTIONS] CASE"])
        self.assertEqual(found["Examples"], ["rheocyte compute a.toml", "rheocyte help case"])

    def test_the_sentence_of_an_option_stands_beside_or_below_its_name(self):
        self.assertEqual(self.entries("Positionals"), [("CASE TEXT REQUIRED", "the case, a file")])
        self.assertEqual(self.entries("Options")[0], ("--quiet", "print nothing"))
        self.assertEqual(self.entries("Options")[2], ("--temperature VALUE|feature|metadata", "degC; or feature"))

    def test_a_name_that_fills_its_column_ends_there(self):
        self.assertEqual(self.entries("Options")[1], ("--radius-um NUMBER REQUIRED", "radius of the cell"))

    def test_excluded_options_belong_to_the_sentence(self):
        self.assertEqual(self.entries("Options")[3], ("--continue DIR", "go on; not together with --start"))


if __name__ == "__main__":
    unittest.main()
