"""The program for Windows under wine against that of this machine: the same files, numbers and sentences; and what Windows
alone has. python3 -m unittest, in this folder; skips where there is no wine, or no program (tools/windows). All kinds of files
have names with umlauts: each path from a text must be made as case/to_path.h does it."""

import json
import os
import re
import shutil
import sys
import tempfile
import unittest
import urllib.request
from pathlib import Path

from both import TOP, Differences, Native, Wine, kill, wait_for, why_not

# Both programs do the same in the same order, but for functions (exp, pow, sin) of two C libraries, whose last digits differ.
# Newton's method carries that on to where it ends, and the last states of a branch depend on it most.
CLOSED, STATES, NEARLY_UNSTABLE = 1e-12, 1e-10, 3e-7
# Steps in time and coarse states on the way along a branch end within a tolerance of their own.
WITHIN_TOLERANCE = {"square-channel": 1e-8, "paper-cell-in-time": 1e-9, "transit-square": 3e-8}
IN_TIME = ("paper-cell-in-time", "transit-square")
# What a case is solved for: at its end Newton's method leaves nothing but rounding. The states before are solved less closely.
MEASURES = ("deformation", "area_um2", "cell_velocity_m_per_s", "pressure_drop_Pa")

QUICK = ["numerics.accuracy=1e-2"]
CELLS = [(name, QUICK) for name in (
    "carreau-liquid", "channel-entry", "combined-cell", "large-stiff-cell", "mooney-rivlin-cell", "paper-cell",
    "paper-cell-in-time", "power-law-liquid", "rectangle", "shell-cell", "small-linear-cell")]
CELLS += [("square-channel", ["numerics.accuracy=3e-2"]), ("transit-square", ["time.end_um=12", "time.degree=2"])]
CELLS += [("paper-cell", ["numerics.accuracy=1e-3", *changes]) for changes in (
    [], ["cell.bulk.young_modulus_kPa=2.2"], ["cell.bulk.young_modulus_kPa=20", "cell.bulk.law=linear"],
    ["cell.radius_um=4.5"], ["flow.rate_ul_per_s=0.01"], ["flow.density_kg_per_m3=0"], ["channel.width_um=30"],
    ["flow.law=power-law", "flow.exponent=0.6", "flow.consistency_Pa_sn=0.4"], ["cell.bulk.law=mooney-rivlin"])]
CELLS += [("shell-cell", [*QUICK, *changes]) for changes in (
    ["cell.cortex.modulus_mN_per_m=60"], ["cell.cortex.tension_ratio=0.3"], ["cell.radius_um=6"])]
CELLS += [("combined-cell", [*QUICK, *changes]) for changes in (
    ["cell.cortex.modulus_mN_per_m=8"], ["cell.bulk.young_modulus_kPa=5"], ["flow.rate_ul_per_s=0.02"])]
CELLS += [("square-channel", ["numerics.accuracy=3e-2", "channel.camera=side", "cell.bulk.young_modulus_kPa=3"]),
          ("small-linear-cell", [*QUICK, "cell.radius_um=3"])]

# Virtual recordings: what is changed of examples/recordings/virtual-cells.toml.
RECORDINGS = [[], ["recording.seed=2"], ["recording.pictures=masks"], ["flow.rate_ul_per_s=0.06"],
              ["flow.medium=0.59% MC-PBS"], ["recording.pixel_size_um=0.26"], ["noise.contour_um=0.05"],
              ["cell.radius_um.mean=5.4"], ["cell.bulk.young_modulus_kPa.mean=4"],
              ["flow.temperature_C.mean=25", "noise.thermometer_C=0.2"]]


def setting(changes):
    return [word for change in changes for word in ("--set", change)]


@unittest.skipIf(why_not(), f"skipped: {why_not()}")
class OnBoth(unittest.TestCase):
    """Each program has a folder of its own with the same inputs."""

    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="rheocyte-windows-"))
        cls.wine, cls.native = Wine(cls.place / "program"), Native()
        cls.here, cls.there = cls.place / "native", cls.place / "windows"
        for folder in (cls.here, cls.there):
            shutil.copytree(TOP / "examples", folder / "examples")
            shutil.copy(TOP / "examples/tables/first-table.toml", folder / "Tafel für mich.toml")

    @classmethod
    def tearDownClass(cls):
        cls.wine.close()
        shutil.rmtree(cls.place)

    def both(self, *words, code=0):
        """Both runs; their exit codes are as expected."""
        ours, theirs = self.native.call(*words, cwd=self.here), self.wine.call(*words, cwd=self.there)
        self.assertEqual((ours.returncode, theirs.returncode), (code, code),
                         f"{words}\n{ours.stderr.decode()}\n{theirs.stderr.decode()}")
        return ours, theirs

    def assert_same(self, differences, what=""):
        if "-v" in sys.argv:
            print(f"\n{self.id()} {what}: at most {differences.greatest:.1e}")
        self.assertEqual(differences.found[:20], [])


class TestCells(OnBoth):
    def test_cells(self):
        """Thirty cells have the same states, outlines and fields."""
        for number, (name, changes) in enumerate(CELLS):
            with self.subTest(name=name, changes=changes):
                out = f"Größe-{number}"
                self.both("solve", f"examples/{name}.toml", *setting(changes), "-o", out, "--no-picture", "--quiet")
                differences = Differences(WITHIN_TOLERANCE.get(name, STATES))
                differences.files(self.here / out, self.there / out)
                self.assert_same(differences, f"{name}, {changes}")
                if name not in IN_TIME:
                    self.assert_same_measures(*(folder / out / "result.json" for folder in (self.here, self.there)))

    def assert_same_measures(self, one, other):
        ours, theirs = (json.loads(file.read_text()) for file in (one, other))
        greatest = max(abs(ours[name] / theirs[name] - 1) for name in MEASURES)
        if "-v" in sys.argv:
            print(f"    their measures: at most {greatest:.1e}")
        self.assertLess(greatest, CLOSED)

    def test_closed_results(self):
        """The analytical model, scaled tables, and plans agree to the limit of double precision."""
        differences = Differences(CLOSED)
        calls = [["analytic", "cell", "--radius-um", "6", "--young-modulus-kPa", "5", "-o", "Umriß.csv", "--json"],
                 ["analytic", "cell", "--radius-um", "6", "--cortex-modulus-mN-m", "20", "-o", "Hülle.csv", "--json"],
                 ["scale", "LE-2D-26", "-o", "größer.txt", "--channel-width-um", "30", "--inexact"],
                 ["scale", "HE-3D-26", "-o", "Linien-ü.txt", "--lines"]]
        for words in calls:
            ours, theirs = self.both(*words)
            differences.table(words[0], ours.stdout.decode(), theirs.stdout.decode())
        for name in ("Umriß.csv", "Hülle.csv", "größer.txt", "Linien-ü.txt"):
            differences.file(name, self.here / name, self.there / name)
        self.assert_same(differences)

    def test_plan(self):
        """A plan of an experiment, which is a search over populations, has the same numbers as shown."""
        ours, theirs = self.both("plan", "--radius-um", "7", "--young-modulus-kPa", "2")
        self.assertEqual(ours.stdout, theirs.stdout)

    def test_help(self):
        """What is printed are the same bytes."""
        for words in (["--help"], ["help", "case"], ["help", "synth"], ["solve", "--help"], ["--version"]):
            ours, theirs = self.both(*words)
            self.assertEqual(ours.stdout, theirs.stdout)
            self.assertNotIn(b"\r", theirs.stdout)


class TestRecordings(OnBoth):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for number, changes in enumerate(RECORDINGS):
            out = f"Prüfung-{number}.rtdc"
            made = cls.native.call("synth", "examples/recordings/virtual-cells.toml", "-o", out, *setting(changes), "--set",
                                   "recording.cells=150", cwd=cls.here)
            assert made.returncode == 0, made.stderr.decode()
            shutil.copy(cls.here / out, cls.there)
        cls.all = [f"Prüfung-{number}.rtdc" for number in range(len(RECORDINGS))]

    def test_synth(self):
        """Virtual recordings have the same cells and outlines."""
        differences = Differences(CLOSED)
        for number, changes in enumerate(RECORDINGS):
            out = f"künstlich-{number}.rtdc"
            self.both("synth", "examples/recordings/virtual-cells.toml", "-o", out, *setting(changes), "--set",
                      "recording.cells=40")
            for folder in (self.here, self.there):
                read = self.native.call("features", folder / out, "-o", folder / f"synth-{number}", cwd=folder)
                self.assertEqual(read.returncode, 0, read.stderr)
            differences.files(self.here / f"synth-{number}", self.there / f"synth-{number}")
        self.assert_same(differences)

    def test_commands(self):
        """Moduli by tables of the square and the tube, features, populations: the same numbers and sentences."""
        calls = {"square": ["extract", *self.all], "tube": ["extract", *self.all, "--section", "tube"],
                 "features": ["features", *self.all],
                 "population": ["population", "--condition", "ä=Prüfung-0.rtdc,Prüfung-1.rtdc", "--condition",
                                "ö=Prüfung-6.rtdc,Prüfung-8.rtdc", "--no-picture"]}
        differences = Differences(CLOSED)
        for name, words in calls.items():
            with self.subTest(name):
                ours, theirs = self.both(*words, "-o", f"{name}-ä")
                differences.table(name, ours.stdout.decode(), theirs.stdout.decode())
                differences.table(f"{name}, errors", ours.stderr.decode(), theirs.stderr.decode())
                differences.files(self.here / f"{name}-ä", self.there / f"{name}-ä")
        self.assert_same(differences)

    def test_moduli_of_bulk_and_cortex(self):
        """Moduli from outlines differ by less than a third of their errors: what pixels do to a cell is drawn by random numbers
        that the last digit of its area chooses."""
        self.both("moduli", *self.all[:3], "-o", "Module-ä")
        for name in self.all[:3]:
            ours, theirs = (json.loads((folder / "Module-ä" / name.replace(".rtdc", "_moduli.json")).read_text())
                            for folder in (self.here, self.there))
            difference = ours["stiffness_median_kPa"] - theirs["stiffness_median_kPa"]
            self.assertLess(abs(difference), ours["stiffness_median_kPa_error"] / 3)

    def test_companion(self):
        """Both write one companion file, of the same size but for what two versions of HDF5 write differently."""
        self.both("extract", "Prüfung-0.rtdc", "-o", "companion")
        names = [file.name for file in (self.here / "companion").glob("*.rtdc")]
        self.assertEqual(len(names), 1)
        for name in names:
            self.assertAlmostEqual((self.here / "companion" / name).stat().st_size,
                                   (self.there / "companion" / name).stat().st_size, delta=4096)

    def test_time_course(self):
        """Cells at several places behind a contraction have the same moduli and viscosities."""
        folder = self.here / "chip"
        folder.mkdir()
        shutil.copy(TOP / "data" / "dynamic_HE-chip-26.cbor", folder)
        shutil.copy(TOP / "examples/tables/dynamic-chip.toml", folder / "spec.toml")
        words = ["synth", "examples/recordings/virtual-cells.toml", "-o", "Läufe.rtdc", *setting([
            "recording.cells=30", "recording.places_um=[20, 60, 120, 200, 300]", "cell.viscosity_mPas=1000",
            f"shapes.table={folder}", "cell.bulk.young_modulus_kPa.mean=0.8"])]
        made = self.native.call(*words, cwd=self.here)
        if made.returncode != 0:
            self.fail(made.stderr.decode())
        shutil.copy(self.here / "Läufe.rtdc", self.there)
        self.both("time-course", "Läufe.rtdc", "--contraction-um", "0", "-o", "Zellen-ü.tsv")
        differences = Differences(CLOSED)
        differences.file("Zellen-ü.tsv", self.here / "Zellen-ü.tsv", self.there / "Zellen-ü.tsv")
        self.assert_same(differences)


class TestTables(OnBoth):
    SMALL = ["table", "Tafel für mich.toml", "--no-picture", *setting(
        ["table.radii=4", "table.rows_per_radius=20", "table.accuracy=1e-2"])]

    def same_tables(self, one, other, limit=STATES):
        differences = Differences(limit)
        differences.files(one, other, skip=(".cbor",))
        for folder in (one, other):
            shown = self.native.call("scale", folder, "-o", folder.with_suffix(".txt"), cwd=self.here)
            self.assertEqual(shown.returncode, 0, shown.stderr)
        differences.file("grid.txt", one.with_suffix(".txt"), other.with_suffix(".txt"))
        self.assert_same(differences)

    def test_table(self):
        """A table by several threads has the same rows."""
        self.both(*self.SMALL, "-o", "Täfelchen", "--jobs", "3")
        self.same_tables(self.here / "Täfelchen", self.there / "Täfelchen", NEARLY_UNSTABLE)

    def test_killed_table_goes_on(self):
        """What a killed call has finished is kept, and the table is the same as without the kill."""
        whole = self.wine.call(*self.SMALL, "-o", "whole", "--jobs", "1", cwd=self.there)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        process = self.wine.start(*self.SMALL, "-o", "killed", "--jobs", "1", cwd=self.there)
        pieces = self.there / "killed" / "branches"
        begun = wait_for(lambda: pieces.is_dir() and any(pieces.glob("radius-*.cbor")), 60)
        kill(process)
        self.assertTrue(begun, f"no branch in {list((self.there / 'killed').rglob('*'))}")
        kept = {file: file.stat().st_mtime_ns for file in pieces.glob("radius-*.cbor")}
        again = self.wine.call(*self.SMALL, "-o", "killed", "--jobs", "2", cwd=self.there)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(kept, {file: file.stat().st_mtime_ns for file in kept})
        self.same_tables(self.there / "whole", self.there / "killed", 0.0)

    def test_ctrl_c(self):
        """Ctrl-C ends a table with what is finished, a sentence and exit code 130; the same command goes on."""
        process, terminal = self.wine.start_in_terminal(*self.SMALL, "-o", "stopped", "--jobs", "1", cwd=self.there)
        branches = self.there / "stopped" / "branches"
        begun = wait_for(lambda: any(branches.glob("radius-*.cbor")), 60)
        os.write(terminal, b"\x03")
        _, errors = process.communicate(timeout=60)
        os.close(terminal)
        self.assertTrue(begun)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn(b"the same command continues from here", errors)
        again = self.wine.call(*self.SMALL, "-o", "stopped", cwd=self.there)
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_two_calls_share_a_table(self):
        """Two calls for one folder do each branch once, and both end well."""
        calls = [self.wine.start(*self.SMALL, "-o", "shared", "--jobs", "1", cwd=self.there) for _ in range(2)]
        for process in calls:
            output, errors = process.communicate(timeout=300)
            self.assertEqual(process.returncode, 0, output + errors)
        self.assertFalse([file for file in (self.there / "shared").rglob("*") if file.suffix == ".claim"])


class TestFiles(OnBoth):
    CELL = ["--set", "numerics.accuracy=1e-2", "--no-picture", "--quiet"]

    def solved(self, case, out):
        done = self.wine.call("solve", case, *self.CELL, "-o", out, cwd=self.there)
        self.assertEqual(done.returncode, 0, done.stderr.decode())

    def windows_path(self, path):
        return "Z:" + str(path).replace("/", "\\")

    def test_names(self):
        """Umlauts, blanks, other alphabets, drive letters, and backslashes in paths of all kinds of files."""
        folder = self.there / "Zellen größer ° 細胞"
        folder.mkdir()
        shutil.copy(self.there / "examples/paper-cell.toml", folder / "Fall für mich.toml")
        self.solved(self.windows_path(folder / "Fall für mich.toml"), f"{folder.name}\\Ergebnis ß")
        self.assertTrue((folder / "Ergebnis ß" / "result.json").is_file())
        made = self.wine.call("synth", "examples\\recordings\\virtual-cells.toml", "--set", "recording.cells=20", "-o",
                              self.windows_path(folder / "Prüfung 1.rtdc"), cwd=self.there)
        self.assertEqual(made.returncode, 0, made.stderr.decode())
        read = self.wine.call("extract", f"{folder.name}\\Prüfung 1.rtdc", "-o", self.windows_path(folder / "Maß"),
                              cwd=self.there)
        self.assertEqual(read.returncode, 0, read.stderr.decode())
        self.assertIn("Prüfung 1", (folder / "Maß" / "rheocyte_summary.tsv").read_text(encoding="utf-8"))

    def test_stars(self):
        """Paths with stars, which shells of Windows leave to the program."""
        folder = self.there / "Viele"
        folder.mkdir()
        for number in (2, 1):
            made = self.wine.call("synth", "examples/recordings/virtual-cells.toml", "--set", "recording.cells=20", "-o",
                                  folder / f"Maß {number}.rtdc", cwd=self.there)
            self.assertEqual(made.returncode, 0, made.stderr.decode())
        (folder / "notes.txt").write_text("mine")
        read = self.wine.call("extract", "Viele\\M*.rtdc", "-o", "Viele\\out", cwd=self.there)
        self.assertEqual(read.returncode, 0, read.stderr.decode())
        self.assertIn("2 of 2 recordings", read.stdout.decode())
        none = self.wine.call("extract", "Viele\\none*.rtdc", cwd=self.there)
        self.assertEqual((none.returncode, none.stderr.decode()), (2, "Viele\\none*.rtdc: there is no such file.\n"))

    def test_long_paths(self):
        """A result more than 260 characters deep."""
        deep = self.there
        for _ in range(6):
            deep /= "a-folder-with-a-name-of-fifty-characters-or-even-more"
        deep.mkdir(parents=True)
        self.assertGreater(len(str(deep)), 300)
        self.solved("examples/paper-cell.toml", deep.relative_to(self.there) / "out")
        self.assertTrue((deep / "out" / "result.json").is_file())

    def test_lines_of_windows(self):
        """A case whose lines end in CR LF is the same case; nothing that is written has them, but the kept case."""
        case = self.there / "crlf.toml"
        text = (self.there / "examples/paper-cell.toml").read_bytes()
        case.write_bytes(text.replace(b"\n", b"\r\n"))
        self.solved("crlf.toml", "crlf")
        self.solved("examples/paper-cell.toml", "lf")
        differences = Differences(0.0)
        differences.files(self.there / "crlf", self.there / "lf", skip=(".toml",))
        self.assert_same(differences)
        for file in (self.there / "crlf").iterdir():
            if file.suffix in (".json", ".csv"):
                self.assertNotIn(b"\r", file.read_bytes(), file)

    def test_result_is_replaced(self):
        """A new result takes the place of an older one, and files of the user stay; nothing else remains."""
        self.solved("examples/paper-cell.toml", "again/out")
        (self.there / "again/out/notes.txt").write_text("mine")
        self.solved("examples/small-linear-cell.toml", "again/out")
        self.assertEqual((self.there / "again/out/notes.txt").read_text(), "mine")
        self.assertEqual([file.name for file in (self.there / "again").iterdir()], ["out"])

    def test_no_python(self):
        """Without Python one sentence says so, and the numbers are kept."""
        done = self.wine.call("solve", "examples/paper-cell.toml", "--set", "numerics.accuracy=1e-2", "-o", "bare",
                              cwd=self.there)
        self.assertEqual(done.returncode, 0)
        self.assertIn("no picture (python.exe is not in the PATH", done.stderr.decode())
        self.assertTrue((self.there / "bare" / "result.json").is_file())

    def test_mistakes(self):
        """The same sentences and exit codes as here."""
        for words in (["solve", "none.toml"], ["extract", "none.rtdc"], ["sovle"], ["extract", "examples/paper-cell.toml"],
                      ["scale", "no-table", "-o", "x.txt"], ["solve", "examples"]):
            ours, theirs = self.both(*words, code=2)
            self.assertEqual(ours.stderr.decode(), theirs.stderr.decode())


class TestView(OnBoth):
    def asked(self, process, requests):
        """The answers to requests, (path, body or None), of a view that has been started."""
        address, token = re.match(r"view: (\S+)/\?token=(\w+)", process.stdout.readline().decode()).groups()
        answers = []
        for path, body in requests:
            request = urllib.request.Request(address + path, data=body and json.dumps(body).encode(),
                                             headers={"Authorization": f"Bearer {token}"})
            with urllib.request.urlopen(request, timeout=60) as answer:
                answers.append(answer.read())
        return answers

    def test_view(self):
        """The view answers on states, events, pictures and moduli as it does here."""
        made = self.native.call("synth", "examples/recordings/virtual-cells.toml", "-o", "Zellen-ö.rtdc", "--set",
                                "recording.cells=50", cwd=self.here)
        self.assertEqual(made.returncode, 0, made.stderr)
        shutil.copy(self.here / "Zellen-ö.rtdc", self.there)
        shown = self.native.call("solve", "examples/paper-cell.toml", "--check", "--json", "--set", "numerics.accuracy=1e-2",
                                 cwd=self.here)
        case = json.loads(shown.stdout)["case"]
        item = "/api/items/0"
        requests = [("/api/state", case), (f"{item}/events?features=area_um,deform", None),
                    (f"{item}/events/3", None), (f"{item}/events/3/image", None), ("/api/features", None), ("/", None)]
        words = ["view", "--no-browser", "Zellen-ö.rtdc"]
        answers = []
        for start, folder in ((self.native.start, self.here), (self.wine.start, self.there)):
            process = start(*words, cwd=folder)
            try:
                answers.append(self.asked(process, requests))
            finally:
                kill(process)
        differences = Differences(STATES)
        for (path, _), ours, theirs in zip(requests, *answers):
            if ours == theirs:
                continue
            self.assertTrue(ours.startswith(b"{"), path)
            differences.json(path, json.loads(ours), json.loads(theirs))
        self.assert_same(differences)


if __name__ == "__main__":
    unittest.main()
