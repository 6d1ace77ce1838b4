"""The examples in C, Python and Rust compute the same cell.

test_examples.py LIBRARY TABLES C_COMPILER STATIC_LIBRARY
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
EXAMPLES, HEADERS = TOP / "examples" / "instrument", TOP / "src" / "instrument"
LIBRARY, STATIC = Path(sys.argv[1]), Path(sys.argv[4])
TABLES, COMPILER = sys.argv[2:4]
ENVIRONMENT = {**os.environ, "RHEOCYTE_TABLES": TABLES, "LD_LIBRARY_PATH": str(LIBRARY.parent)}


def run(*command):
    return subprocess.run([str(word) for word in command], env=ENVIRONMENT, check=True, capture_output=True,
                          text=True).stdout


def numbers(text):
    """Area, deformation, E and S of the example's cell."""
    line = next(line for line in text.splitlines() if line.startswith("area "))
    return [float(number) for number in re.findall(r" ([-+.\de]+|nan)", line)]


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.of_python = numbers(run(sys.executable, EXAMPLES / "cells.py", LIBRARY))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_python_finds_moduli(self):
        area, deformation, modulus, stiffness = self.of_python
        self.assertAlmostEqual(area, 136, delta=4)  # pi 21 18 pixels of 0.34 um, less the outermost half pixels
        self.assertTrue(0 < deformation < 0.02)
        self.assertTrue(modulus > 0 and stiffness > 0)

    def compile_c(self, name, *libraries):
        program = self.folder / name
        run(COMPILER, "-std=c11", "-Wall", "-Wextra", "-Werror", "-O2", f"-I{HEADERS}", EXAMPLES / "ring_buffer.c",
            *libraries, "-lpthread", "-lm", "-o", program)
        return program

    def test_c_takes_all_cells_of_the_ring(self):
        text = run(self.compile_c("shared", LIBRARY), 3000, 0)
        self.assertEqual(numbers(text), self.of_python)
        self.assertIn("3000 cells, 0 failed", text)

    def test_c_with_the_static_library_is_the_same(self):
        text = run(self.compile_c("static", STATIC, "-lstdc++", "-ldl"), 300, 0)
        self.assertEqual(numbers(text), self.of_python)

    def test_rust_is_the_same(self):
        if shutil.which("rustc") is None:
            self.skipTest("there is no rustc")
        folder = self.folder / "rust"
        folder.mkdir()
        (folder / "librheocyte_cell.so").symlink_to(LIBRARY)
        run("rustc", "-o", folder / "cells", "-L", folder, EXAMPLES / "cells.rs")
        self.assertEqual(numbers(run(folder / "cells")), self.of_python)

    def test_the_library_needs_nothing_but_the_libraries_of_c_and_c_plus_plus(self):
        if shutil.which("readelf") is None:
            self.skipTest("there is no readelf")
        needed = re.findall(r"NEEDED.*\[(.*?)\]", run("readelf", "-d", LIBRARY))
        allowed = re.compile(r"(libstdc\+\+|libm|libgcc_s|libc|libdl|libpthread|ld-linux-x86-64)\.so")
        self.assertEqual([name for name in needed if not allowed.match(name)], [])

    def test_only_the_interface_is_exported(self):
        names = run("nm", "-D", "--defined-only", LIBRARY).split("\n")
        symbols = {line.split()[-1].split("@")[0] for line in names if line} - {"RHEOCYTE_CELL_1"}
        declared = set(re.findall(r"\b(rheocyte_cell_\w+)\(", (HEADERS / "rheocyte_cell.h").read_text("utf-8")))
        self.assertEqual(symbols, declared)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
