"""`rheocyte view` on a recording gives the numbers of the command line, over HTTP, by the standard library alone."""

import array
import http.client
import json
import os
import re
import struct
import subprocess
import tempfile
import time
import unittest
import zlib
from pathlib import Path

PROGRAM = os.environ.get("RHEOCYTE_PROGRAM", "rheocyte")
TOP = Path(__file__).resolve().parents[2]
EVENTS = 40


class View:
    """A running `rheocyte view` and a way to ask it."""

    def __init__(self, folder, *paths):
        self.process = subprocess.Popen(
            [PROGRAM, "view", *map(str, paths), "--no-browser", "--output", str(folder)],
            stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        self.host, self.token = re.fullmatch(r"view: http://([^/]+)/\?token=(\S+)\n", line).groups()

    def ask(self, method, path, body=None):
        connection = http.client.HTTPConnection(self.host, timeout=60)
        connection.request(method, path, None if body is None else json.dumps(body),
                           {"Authorization": f"Bearer {self.token}"})
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, answer.headers, content

    def json(self, method, path, body=None):
        return json.loads(self.ask(method, path, body)[2])

    def wait_until(self, path, is_done):
        """Asks until the answer is the expected one."""
        for _ in range(600):
            answer = self.json("GET", path)
            if is_done(answer):
                return answer
            time.sleep(0.05)
        raise AssertionError(f"{path} still says {answer}")

    def close(self):
        self.process.terminate()
        self.process.stdout.close()
        self.process.wait(60)


def rows_of(table):
    """The columns of a table of events as texts, by their names."""
    lines = [line.split("\t") for line in Path(table).read_text().splitlines() if not line.startswith("#")]
    return dict(zip(lines[0], zip(*lines[1:])))


def single(numbers):
    """Doubles as the table of events prints them: in single precision."""
    return [struct.unpack("f", struct.pack("f", number))[0] for number in numbers]


def pixels_of(png):
    """Width, height and rows of an unfiltered PNG of 8 bit grey."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", png[16:24])
    length, = struct.unpack(">I", png[33:37])
    rows = zlib.decompress(png[41:41 + length])
    return width, height, [rows[i * (width + 1) + 1:(i + 1) * (width + 1)] for i in range(height)]


class RecordingInTheView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.recording = cls.folder / "data" / "cells.rtdc"
        cls.recording.parent.mkdir()
        subprocess.run([PROGRAM, "synth", TOP / "examples/recordings/virtual-cells.toml", "-o", cls.recording, "--set",
                        f"recording.cells={EVENTS}", "--quiet"], check=True)
        subprocess.run([PROGRAM, "extract", cls.recording, "-o", cls.folder / "want", "--quiet"], check=True)
        cls.rows = rows_of(cls.folder / "want/cells_rheocyte.tsv")
        (cls.folder / "data/broken.rtdc").write_text("no recording")
        cls.view = View(cls.folder / "out", cls.recording.parent)
        items = cls.view.wait_until("/api/items", lambda all: all[0]["state"] != "loading" != all[1]["state"])
        cls.broken, cls.item = items
        cls.moduli = cls.start_moduli()

    @classmethod
    def tearDownClass(cls):
        cls.view.close()
        cls.temporary.cleanup()

    @classmethod
    def start_moduli(cls):
        cls.view.json("POST", "/api/items/1/moduli", {})
        return cls.view.wait_until("/api/items/1/moduli", lambda state: state["state"] != "running")

    def columns(self, *names):
        """Columns of events as doubles."""
        status, headers, content = self.view.ask("GET", f"/api/items/1/events?features={','.join(names)}&type=float64")
        self.assertEqual(status, 200, content[:300])
        told = json.loads(headers["X-Rheocyte-Columns"])
        self.assertEqual(told["features"], list(names))
        numbers = array.array("d", content)
        return [numbers[i * told["events"]:(i + 1) * told["events"]] for i in range(len(names))]

    def test_a_damaged_recording_is_listed_with_a_sentence(self):
        self.assertEqual(self.broken["state"], "failed")
        self.assertIn("is not an HDF5 file", self.broken["error"])
        self.assertEqual(self.item["events"], len(self.rows["event"]))
        self.assertEqual(self.item["conditions"]["medium"], "CellCarrier")

    def test_labels_are_kept(self):
        self.view.json("PATCH", "/api/items/1", {"condition": "treated"})
        self.assertEqual(self.view.json("GET", "/api/items/1")["condition"], "treated")

    def test_columns_and_moduli_are_those_of_extract(self):
        self.assertEqual(self.moduli["state"], "ready", self.moduli)
        area, modulus, error = self.columns("area_um", "emodulus", "young_modulus_kPa_error")
        for column, name in ((area, "area_um2"), (modulus, "young_modulus_kPa"), (error, "young_modulus_kPa_error")):
            wanted = single(float(text) for text in self.rows[name])
            self.assertEqual([repr(x) for x in single(column)], [repr(x) for x in wanted])
        self.assertEqual(self.moduli["summary"]["valid"], self.rows["state"].count("valid"))

    def test_an_event_has_its_modulus_its_picture_and_a_case(self):
        event = next(i for i, state in enumerate(self.rows["state"]) if state == "valid")
        told = self.view.json("GET", f"/api/items/1/events/{event}")
        self.assertEqual(single([told["young_modulus_kPa"]]), single([self.columns("emodulus")[0][event]]))
        self.assertLess(told["model"]["residual_rms_um"], 0.34)
        width, height, mask = pixels_of(self.view.ask("GET", f"/api/items/1/events/{event}/mask")[2])
        self.assertEqual(told["image_size"], {"width": width, "height": height})
        pixel = told["pixel_um"]
        for x, y in zip(told["outline"]["x_um"], told["outline"]["y_um"]):
            self.assertEqual(mask[int(y / pixel)][int(x / pixel)], 255, "the outline runs through pixels of the mask")

    def test_the_case_of_an_event_has_the_shape_of_the_fitted_cell(self):
        event = next(i for i, state in enumerate(self.rows["state"]) if state == "valid")
        told = self.view.json("GET", f"/api/items/1/events/{event}")
        status, _, content = self.view.ask("POST", "/api/state?stream=test&accuracy=1e-3", told["case"])
        self.assertEqual(status, 200, content[:300])
        state = json.loads(content)
        # The table interpolates to 1e-3 and the outline has modes up to the seventh.
        self.assertAlmostEqual(state["deformation"] / told["model"]["deformation"], 1, delta=0.02)
        self.assertAlmostEqual(state["area_um2"] / told["model"]["area_um2"], 1, delta=0.005)

    def test_lines_are_there_and_exports_equal_the_files_of_extract(self):
        lines = self.view.json("GET", "/api/items/1/lines")
        self.assertEqual(lines["table"][:5], "HE-3D")
        self.assertGreater(len(lines["lines"]), 5)
        written = self.view.json("POST", "/api/export", {"what": "events", "item": 1, "name": "cells.tsv"})
        self.assertEqual(Path(written["file"]).read_text(), (self.folder / "want/cells_rheocyte.tsv").read_text())
        status, _, _ = self.view.ask("POST", "/api/export", {"what": "events", "item": 1, "name": "../cells.tsv"})
        self.assertEqual(status, 400)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["data", "out", "want"])


if __name__ == "__main__":
    unittest.main()
