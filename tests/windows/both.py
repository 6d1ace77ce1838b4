"""The program of this machine and the one for Windows, which wine runs, and how far what they write differs."""

import fcntl
import json
import math
import os
import pty
import re
import shutil
import signal
import subprocess
import termios
import time
import zipfile
from decimal import Decimal
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
MADE = TOP / "build" / "windows"
NATIVE = Path(os.environ.get("RHEOCYTE_PROGRAM", TOP / "build" / "rheocyte"))
# What no two runs have in common, or what names the machine.
OF_THE_RUN = {"wall_time_s", "statistics", "compiler", "residual", "version", "date", "computed_s", "program", "threads"}
# Of differences of numbers of the order of one, such as errors: below it they are rounding.
ROUNDING = 1e-12
# A call takes half a minute at most, but other tests may run at the same time.
PATIENCE_S = 600
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def wine_of_64_bits():
    """The loader itself: the script `wine` warns that programs of 32 bits cannot be run."""
    for place in ("wine64", "/usr/lib/wine/wine64"):
        if found := shutil.which(place):
            return found
    return shutil.which("wine")


def why_not():
    """Why the program for Windows cannot be tested here; empty if it can."""
    if not list(MADE.glob("rheocyte-*-windows-x86_64.zip")):
        return "the program for Windows is not there (tools/windows makes it)"
    if not wine_of_64_bits():
        return "wine is not installed (Debian packages wine and wine64)"
    return ""


class Wine:
    """The unpacked program in a Windows of its own below build/windows."""

    def __init__(self, folder):
        self.folder = folder
        with zipfile.ZipFile(max(MADE.glob("rheocyte-*-windows-x86_64.zip"), key=os.path.getmtime)) as packed:
            packed.extractall(folder)
        self.program = next(folder.glob("*/rheocyte.exe"))
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith(("RHEOCYTE", "PYTHON", "DISPLAY"))}
        self.environment.update(LC_ALL="C.UTF-8", WINEPREFIX=str(MADE / "wine"), WINEDEBUG="-all",
                                WINEDLLOVERRIDES="mscoree,mshtml=d")
        self.server = shutil.which("wineserver")
        self.call("--version")  # makes that Windows where it is not there yet

    def arguments(self, *words):
        return [wine_of_64_bits(), str(self.program), *map(str, words)]

    def call(self, *words, cwd=None, **environment):
        return self.run(self.arguments(*words), cwd, **environment)

    def call_other(self, program, *words):
        """Another program for Windows."""
        return self.run([wine_of_64_bits(), str(program), *map(str, words)])

    def run(self, arguments, cwd=None, **environment):
        return subprocess.run(arguments, cwd=cwd or self.folder, env={**self.environment, **environment},
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE_S, check=False)

    def start(self, *words, cwd):
        return subprocess.Popen(self.arguments(*words), cwd=cwd, env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)

    def start_in_terminal(self, *words, cwd):
        """With a terminal of its own, which gives Ctrl-C to the program; the process and our end of the terminal."""
        ours, theirs = pty.openpty()

        def take_terminal():
            os.setsid()
            fcntl.ioctl(theirs, termios.TIOCSCTTY, 0)

        process = subprocess.Popen(self.arguments(*words), cwd=cwd, env=self.environment, stdin=theirs, stdout=theirs,
                                   stderr=subprocess.PIPE, preexec_fn=take_terminal)
        os.close(theirs)
        return process, ours

    def close(self):
        subprocess.run([self.server, "-k"], env=self.environment, check=False)


class Native:
    """The same calls of the program of this machine."""

    def call(self, *words, cwd):
        return subprocess.run([str(NATIVE), *map(str, words)], cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True,
                              timeout=PATIENCE_S, check=False)

    def start(self, *words, cwd):
        return subprocess.Popen([str(NATIVE), *map(str, words)], cwd=cwd, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)


def is_rounded_otherwise(one, other):
    """Whether two written numbers of fewer digits than are computed differ by one in the last."""
    a, b = Decimal(one), Decimal(other)
    last = max(a.as_tuple().exponent, b.as_tuple().exponent)
    return max(len(a.as_tuple().digits), len(b.as_tuple().digits)) < 15 and abs(a - b) <= Decimal((0, (1,), last))


def here(word):
    """A path of the program for Windows as that of the one here, which works in another folder."""
    if isinstance(word, str) and "\\" in word:
        return word.replace("Z:", "").replace("\\", "/").replace("/windows/", "/native/")
    return word


class Differences:
    """Collects where two results differ by more than `limit` of a number, or of the scale that stands beside it, and by more
    than ROUNDING. Paths of Windows count as those of the folder `native`."""

    def __init__(self, limit):
        self.limit, self.greatest, self.found = limit, 0.0, []

    def number(self, place, one, other, scale=0.0):
        if one == other or (math.isnan(one) and math.isnan(other)) or abs(one - other) < ROUNDING:
            return
        size = max(abs(one), abs(scale))
        difference = abs(one - other) / size if size > 0 else math.inf
        self.greatest = max(self.greatest, difference)
        if not difference <= self.limit:
            self.found.append(f"{place}: {one!r} and {other!r}, {difference:.1e} of {size:g}")

    def json(self, place, one, other, scales=None):
        if type(one) is not type(other) and not all(isinstance(x, int | float) for x in (one, other)):
            self.found.append(f"{place}: {one!r} and {other!r}")
        elif isinstance(one, dict):
            if one.keys() != other.keys():
                self.found.append(f"{place}: keys {sorted(one.keys() ^ other.keys())}")
                return
            for key in one.keys() - OF_THE_RUN:
                # An error is a difference of two numbers: it has the digits of these.
                inner = one if key in ("errors", "standard_errors") else None
                scale = (scales or {}).get(key, 0.0)
                scale = 1000 * scale if isinstance(scale, int | float) else 0.0
                if key == "estimated_error":  # relative to the deformation
                    scale = 1.0
                self.one_json(f"{place}/{key}", one[key], other[key], scale, inner)
        elif isinstance(one, list):
            if len(one) != len(other):
                self.found.append(f"{place}: {len(one)} and {len(other)} entries")
                return
            size = max((abs(x) for x in one if isinstance(x, int | float)), default=0.0)
            for number, pair in enumerate(zip(one, other)):
                self.one_json(f"{place}/{number}", *pair, size, None)
        elif one != here(other):
            self.found.append(f"{place}: {one!r} and {other!r}")

    def one_json(self, place, one, other, scale, scales):
        if isinstance(one, int | float) and isinstance(other, int | float) and not isinstance(one, bool):
            self.number(place, float(one), float(other), scale if isinstance(scale, int | float) else 0.0)
        else:
            self.json(place, one, other, scales)

    def table(self, place, one, other):
        """Words between white space and commas; numbers relative to the greatest of their column."""
        rows, others = ([re.split(r"[\t ,;=\"]+", line) for line in text.split("\n")] for text in (one, other))
        if len(rows) != len(others):
            self.found.append(f"{place}: {len(rows)} and {len(others)} lines")
            return
        sizes = {}
        for row in rows:
            for column, word in enumerate(row):
                if NUMBER.fullmatch(word):
                    sizes[len(row), column] = max(sizes.get((len(row), column), 0.0), abs(float(word)))
        for line, (row, theirs) in enumerate(zip(rows, others), 1):
            if len(row) != len(theirs):
                self.found.append(f"{place}:{line}: {row} and {theirs}")
                continue
            for column, (word, their) in enumerate(zip(row, theirs)):
                if word == here(their):
                    continue
                if NUMBER.fullmatch(word) and NUMBER.fullmatch(their):
                    if not is_rounded_otherwise(word, their):
                        self.number(f"{place}:{line}", float(word), float(their), sizes[len(row), column])
                else:
                    self.found.append(f"{place}:{line}: {word!r} and {their!r}")

    def files(self, one, other, skip=()):
        """All files of two folders that are no pictures."""
        names = [{str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()
                  and file.suffix not in (".png", ".svg", ".gif", *skip)} for folder in (one, other)]
        if names[0] != names[1]:
            self.found.append(f"files {sorted(names[0] ^ names[1])}")
        for name in sorted(names[0] & names[1]):
            self.file(name, one / name, other / name)

    def file(self, name, one, other):
        content, theirs = one.read_bytes(), other.read_bytes()
        if content == theirs:
            return
        if name.endswith(".json"):
            self.json(name, json.loads(content), json.loads(theirs))
        elif b"\0" not in content:
            self.table(name, content.decode(), theirs.decode())
        elif not name.endswith((".rtdc", ".vtu", ".cbor", ".bin", ".h5")):
            self.found.append(f"{name}: other bytes")


def wait_for(condition, seconds):
    """Until it is true; whether it became so."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False


def kill(process):
    """With all that it started."""
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    for stream in (process.stdout, process.stderr):
        stream.close()
