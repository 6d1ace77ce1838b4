"""An installed program finds its tables, pictures and documents from where it is: test_install.py FOLDER."""

import gzip
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else None


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="rheocyte install ")  # with a blank in its name
        cls.tree = pathlib.Path(cls.folder.name) / "moved"
        shutil.copytree(TREE, cls.tree)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def call(self, *arguments):
        made = subprocess.run([self.tree / "bin/rheocyte", *arguments], env={"PATH": "/usr/bin:/bin", "HOME": "/"},
                              cwd=self.folder.name, capture_output=True, text=True, check=False)
        self.assertEqual(made.returncode, 0, made.stderr)
        return made

    def test_a_moved_tree_works(self):
        examples = self.tree / "share/doc/rheocyte/examples"
        solved = self.call("solve", examples / "paper-cell.toml", "-o", "cell", "--set", "numerics.accuracy=1e-3")
        self.assertEqual(solved.stderr.count("warning"), 0, solved.stderr)
        self.assertGreater((pathlib.Path(self.folder.name) / "cell/picture.png").stat().st_size, 0)
        self.call("synth", examples / "recordings/virtual-cells.toml", "-o", "cells.rtdc", "--set", "recording.cells=50")
        self.assertIn("50 of 50 events", self.call("extract", "cells.rtdc").stdout)

    def of_the_library(self, *command, **variables):
        environment = {"PATH": "/usr/bin:/bin", "HOME": "/", "LD_LIBRARY_PATH": str(self.tree / "lib"), **variables}
        return subprocess.run(command, env=environment, cwd=self.folder.name, check=True, capture_output=True,
                              text=True).stdout

    def test_the_library_for_instruments_is_found_with_its_tables(self):
        source = self.tree / "share/doc/rheocyte/examples/instrument/ring_buffer.c"
        found = {"PKG_CONFIG_PATH": str(self.tree / "lib/pkgconfig")}
        if shutil.which("pkg-config") is None or shutil.which("cc") is None:
            self.skipTest("there is no pkg-config, or no cc")
        flags = shlex.split(self.of_the_library("pkg-config", "--cflags", "--libs", "rheocyte_cell", **found))
        self.of_the_library("cc", source, *flags, "-lpthread", "-lm", "-o", "ring_buffer")
        self.assertIn("100 cells, 0 failed", self.of_the_library("./ring_buffer", "100", "0"))

    def test_cmake_finds_the_library_for_instruments(self):
        folder = pathlib.Path(self.folder.name, "project")
        folder.mkdir()
        shutil.copy(self.tree / "share/doc/rheocyte/examples/instrument/ring_buffer.c", folder)
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.20)\nproject(ring LANGUAGES C)\nfind_package(rheocyte_cell REQUIRED)\n"
            "add_executable(ring ring_buffer.c)\ntarget_link_libraries(ring rheocyte::cell pthread m)\n", "utf-8")
        self.of_the_library("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.tree}")
        self.of_the_library("cmake", "--build", folder / "build")
        self.assertIn("100 cells, 0 failed", self.of_the_library(folder / "build/ring", "100", "0"))

    def test_every_command_has_a_page_and_is_completed(self):
        commands = [line.split()[0] for line in self.call("--help").stdout.split("Subcommands:")[1].splitlines()
                    if line.startswith("  ")]
        for command in commands:
            page = gzip.decompress((self.tree / f"share/man/man1/rheocyte-{command}.1.gz").read_bytes()).decode()
            self.assertTrue(page.startswith(f'.TH "RHEOCYTE-{command.upper()}"'), page[:60])
            self.assertIn("\\-\\-help", page)
        completion = self.tree / "share/bash-completion/completions/rheocyte"
        script = f'source "{completion}"; COMP_WORDS=(rheocyte ext); COMP_CWORD=1; _rheocyte; echo "${{COMPREPLY[*]}}"; ' \
                 'COMP_WORDS=(rheocyte extract --med); COMP_CWORD=2; _rheocyte; echo "${COMPREPLY[*]}"'
        said = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said, "extract\n--medium\n")


if __name__ == "__main__":
    unittest.main()
