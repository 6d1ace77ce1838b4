"""The program's way into the package: arguments come over standard input, and a program that is gone leaves nothing."""

import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from tests.synthetic import write_result

PACKAGE = Path(__file__).resolve().parents[1]
CODE = "import sys; sys.path.insert(0, sys.argv.pop(1)); from rheocyte.start import main; main()"


def start(module, *arguments):
    """As src/store/python_package.cc does it."""
    return subprocess.Popen([sys.executable, "-I", "-B", "-c", CODE, PACKAGE, module, *arguments], stdin=subprocess.PIPE,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


class Start(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_folder_over_standard_input_is_drawn(self):
        write_result(self.folder)
        said, _ = start("picture").communicate(bytes(self.folder) + b"\0")
        self.assertEqual(said, b"")
        self.assertTrue((self.folder / "picture.png").exists() and (self.folder / "picture.svg").exists())

    def test_without_a_folder_nothing_happens(self):
        process = start("picture")
        self.assertEqual(process.communicate(b""), (b"", None))
        self.assertEqual(process.returncode, 0)

    def test_an_unknown_folder_is_the_users_error(self):
        process = start("picture", self.folder / "nowhere")
        said, _ = process.communicate()
        self.assertEqual((process.returncode, said.count(b"\n")), (2, 1), said)

    def test_it_ends_with_the_program(self):
        process = start("picture")
        process.send_signal(signal.SIGUSR1)
        self.addCleanup(process.communicate)
        self.assertNotEqual(process.wait(60), 0)


if __name__ == "__main__":
    unittest.main()
