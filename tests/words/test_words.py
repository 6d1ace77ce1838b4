"""The words that the program prints are those of the files beside this one, which are reviewed."""
import os
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools"))
import help_texts  # noqa: E402 (the folder is named just above)
from sentences import all_sentences, without_numbers  # noqa: E402

PROGRAM = os.environ["RHEOCYTE_PROGRAM"]
AGAIN = "If the change is intended, `tools/write_words build/rheocyte` writes the files again."


def files(folder):
    return {file.stem: file.read_text(encoding="utf-8") for file in (HERE / folder).glob("*.txt")}


class Words(unittest.TestCase):
    maxDiff = None

    def compare(self, folder, printed):
        reviewed = files(folder)
        self.assertEqual(sorted(printed), sorted(reviewed), AGAIN)
        for name, text in printed.items():
            with self.subTest(name):
                self.assertMultiLineEqual(reviewed[name], text, f"{folder}/{name}.txt. {AGAIN}")


class Help(Words):
    def test_the_help_of_each_command_is_the_reviewed_one(self):
        self.compare("help", help_texts.all_help(PROGRAM))


class Sentences(Words):
    def test_the_sentences_on_small_recordings_are_the_reviewed_ones(self):
        self.compare("sentences", all_sentences(PROGRAM))

    def test_only_numbers_are_replaced(self):
        text = "E 1.5e-3 kPa (quartiles 2.2 to +3.1),  95 % of 10 events; c3, E2D/r0 of HL60 cells by HE-3D-el-26"
        self.assertEqual(without_numbers(text),
                         "E # kPa (quartiles # to #), # % of # events; c3, E2D/r0 of HL60 cells by HE-3D-el-26")


if __name__ == "__main__":
    unittest.main()
