"""librheocyte_cell for Windows: programs in C that mingw links to the import library and wine runs, and the same ones here.
python3 -m unittest, in this folder; skips as test_windows.py does, and without mingw."""

import os
import re
import shutil
import subprocess
import unittest

from both import NATIVE, TOP, Differences
from test_windows import OnBoth

MINGW = "x86_64-w64-mingw32-"
# Found: 3e-14.
LIBRARY = 1e-12


@unittest.skipIf(shutil.which(f"{MINGW}gcc") is None, "skipped: mingw is missing (Debian package gcc-mingw-w64-x86-64-posix)")
class TestLibrary(OnBoth):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.installed = cls.wine.program.parent
        cls.library = NATIVE.parent / "src" / "instrument" / "librheocyte_cell.so.1"

    def compile(self, compiler, source, *words):
        done = subprocess.run([compiler, "-std=c11", "-Wall", "-Wextra", "-Werror", "-O2", source, *words],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def outputs(self, source, *words):
        """What the program prints here and on Windows."""
        ours, theirs = self.here / source.stem, self.installed / f"{source.stem}.exe"
        self.compile("cc", source, f"-I{TOP / 'src' / 'instrument'}", self.library, "-lpthread", "-lm", "-o", ours)
        self.compile(f"{MINGW}gcc", source, f"-I{self.installed / 'include'}", f"-L{self.installed / 'lib'}",
                     "-lrheocyte_cell", "-static-libgcc", "-Wl,-Bstatic", "-lpthread", "-o", theirs)
        environment = {**os.environ, "RHEOCYTE_TABLES": str(TOP / "data"), "LD_LIBRARY_PATH": str(self.library.parent)}
        here = subprocess.run([ours, *words], env=environment, capture_output=True, check=False)
        there = self.wine.call_other(theirs, *words)
        self.assertEqual((here.returncode, there.returncode), (0, 0), here.stdout + there.stdout + there.stderr)
        return here.stdout.decode(), there.stdout.decode().replace("\r\n", "\n")

    def test_cells(self):
        """Masks and features have the same numbers, with the tension of the tables found beside the library."""
        ours, theirs = self.outputs(TOP / "tests/windows/cells.c")
        self.assertGreater(ours.count("\n"), 1600)
        differences = Differences(LIBRARY)
        differences.table("cells", ours, theirs)
        self.assert_same(differences)

    def test_example(self):
        """The ring buffer with three threads takes all cells, and its single cell is the same."""
        ours, theirs = self.outputs(TOP / "examples/instrument/ring_buffer.c", "1000", "0")
        differences = Differences(LIBRARY)
        differences.table("cell", *(text.splitlines()[0] for text in (ours, theirs)))
        self.assert_same(differences)
        self.assertIn("1000 cells, 0 failed", theirs)

    def test_library_needs_windows_alone(self):
        """The library imports only libraries of Windows, and exports only the interface."""
        shown = subprocess.run([f"{MINGW}objdump", "-p", self.installed / "rheocyte_cell.dll"], capture_output=True,
                               text=True, check=True).stdout
        imported = {name.lower() for name in re.findall(r"DLL Name: (\S+)", shown)}
        self.assertLessEqual(imported, {"kernel32.dll", "msvcrt.dll", "advapi32.dll", "shell32.dll", "shlwapi.dll",
                                        "user32.dll", "ws2_32.dll"})
        exported = set(re.findall(r"^\s*\[ *\d+\].* (\w+)$", shown.partition("[Ordinal/Name Pointer]")[2], re.MULTILINE))
        header = (self.installed / "include/rheocyte_cell.h").read_text("utf-8")
        self.assertEqual(exported, set(re.findall(r"\b(rheocyte_cell_\w+)\(", header)))

    def test_files_for_cmake_and_pkg_config(self):
        """A program links to the library by find_package; what pkg-config says lies beside it."""
        self.assertTrue((self.installed / "lib/pkgconfig/rheocyte_cell.pc").is_file())
        folder = self.there / "by-cmake"
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(by_cmake LANGUAGES C)\nfind_package(rheocyte_cell REQUIRED)\n"
            f"add_executable(by_cmake {TOP}/tests/windows/cells.c)\ntarget_link_libraries(by_cmake rheocyte::cell)\n")
        for words in (["-S", folder, "-B", folder / "build", f"-DCMAKE_TOOLCHAIN_FILE={TOP}/cmake/windows.cmake",
                       f"-DCMAKE_FIND_ROOT_PATH={self.installed}"], ["--build", folder / "build"]):
            done = subprocess.run(["cmake", *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
