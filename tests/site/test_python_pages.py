"""Docstrings of the Python package as pages: arguments are distinguished from sentences and calls."""
import sys
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / "docs/site"), str(TOP / "tools")]
import python_pages  # noqa: E402 (its folders are named just above)
from restructured_text import sentence  # noqa: E402


class Docstrings(unittest.TestCase):
    def test_arguments_stand_beside_or_above_their_meaning(self):
        text = "one, two        both of\n                them\nthree, four_and_more\n                what stands below"
        self.assertEqual(python_pages.documentation(text),
                         "``one, two``\n   both of them\n\n``three, four_and_more``\n   what stands below\n\n")

    def test_a_sentence_before_arguments_remains_one(self):
        self.assertEqual(python_pages.documentation("What it is, in words\nname    its meaning"),
                         "What it is, in words\n\n``name``\n   its meaning\n\n")

    def test_settings_stand_in_their_place(self):
        self.assertEqual(python_pages.documentation("first           a\n{settings}\nlast            z", [("between", "b")]),
                         "``first``\n   a\n\n``between``\n   b\n\n``last``\n   z\n\n")

    def test_a_call_is_code(self):
        self.assertEqual(python_pages.documentation(">>> a(\n...     b)"), ".. code-block:: pycon\n\n   >>> a(\n   ...     b)\n\n")

    def test_words_in_backticks_are_code_and_documents_are_links(self):
        self.assertEqual(sentence("by `a_b*` (docs/theory.md, eq:weak) of a_b*"),
                         r"by ``a_b*`` (:doc:`/docs/theory`, ``eq:weak``) of a\_b\*")


if __name__ == "__main__":
    unittest.main()
