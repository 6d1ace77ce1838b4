"""Whatever arrives at `rheocyte view`, and however little the system gives it, it answers afterwards.

    python3 test_view_floods.py [REQUESTS]      of each of 20 threads; RHEOCYTE_PROGRAM names the program
"""

import json
import os
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM = os.environ.get("RHEOCYTE_PROGRAM", "rheocyte")
THREADS = 20
REQUESTS = 50
CASE = {"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
        "cell": {"radius_um": 7, "bulk": {"young_modulus_kPa": 4}}, "numerics": {"accuracy": 0.01}}
IN_TIME = {**CASE, "time": {"end_us": 2000}, "cell": {**CASE["cell"], "viscosity_mPas": 15}}
# What the shell says before it becomes the program; memory and processes as a container limits them.
LIMITS = {"none": "", "small stacks": "ulimit -S -s 1024", "stacks without limit": "ulimit -s unlimited",
          "few open files": "ulimit -n 64", "little memory": "ulimit -v 3000000"}


class View:
    """A running view in a folder of its own."""

    def __init__(self, limit, before=()):
        self.folder = tempfile.TemporaryDirectory()
        os.chmod(self.folder.name, 0o777)  # also for another user
        self.process = subprocess.Popen(
            [*before, "/bin/sh", "-c", f"{limit or ':'}; exec \"$0\" view --no-browser --output \"$1\"", PROGRAM,
             self.folder.name], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.fullmatch(r"view: http://127.0.0.1:(\d+)/\?token=(\S+)\n", line)
        self.port, self.token = (int(found[1]), found[2]) if found else (None, None)

    def head(self, method, path, more=""):
        return (f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\nAuthorization: Bearer {self.token}\r\n"
                f"{more}").encode()

    def request(self, method, path, body=None):
        text = b"" if body is None else json.dumps(body).encode()
        return self.head(method, path, f"Content-Length: {len(text)}\r\nConnection: close\r\n\r\n") + text

    def send(self, data, close_early=False):
        """The answer; nothing if the connection is closed before it comes, by us or by the view."""
        try:
            with socket.create_connection(("127.0.0.1", self.port), timeout=120) as wire:
                wire.sendall(data)
                if close_early:
                    return b""
                pieces = []
                while piece := wire.recv(1 << 16):
                    pieces.append(piece)
                return b"".join(pieces)
        except ConnectionError:
            return b""

    def close(self):
        if self.port:
            self.process.send_signal(signal.SIGINT)
        _, err = self.process.communicate(timeout=120)
        self.folder.cleanup()
        return self.process.returncode, err


def without_token(view):
    return view.request("GET", "/api/keys").replace(view.token.encode(), b"wrong")


def requests_of(view):
    """All that clients do: (bytes, whether the client goes away at once)."""
    ranges = "Range: bytes=" + ",".join(["0-1"] * 12000) + "\r\n"
    many_keys = {str(number): 0 for number in range(20000)}
    state = view.request("POST", "/api/state?fields=1&stream=slider", CASE)
    export = view.request("POST", "/api/export", {"what": "result", "case": CASE, "name": "flood"})
    return [(without_token(view), False),
            (without_token(view).replace(b"Connection: close\r\n", ranges.encode()), True),
            (view.head("GET", "/api/keys", ranges + "Connection: close\r\n\r\n"), False),
            (view.request("GET", "/api/health"), False),
            (view.request("GET", "/"), False),
            (view.request("GET", "/api/items/0/events/1"), False),
            (state, True), (state, False), (state[:-20], True),
            (view.request("POST", "/api/evolve?fields=1", IN_TIME), True),
            (export, True),
            (view.request("POST", "/api/export", many_keys), False),
            (view.head("POST", "/api/export", "Content-Length: 16000000\r\n\r\n") + b"[" * 100000, True),
            (view.head("GET", "/" + "x" * 70000), True),
            (b"\x16\x03\x01\x02\x00" + bytes(200), False),
            (b"", True)]


def flood(view, number, count):
    choice = random.Random(number)
    offered = requests_of(view)
    for _ in range(count):
        view.send(*choice.choice(offered))


class Floods(unittest.TestCase):
    count = REQUESTS

    def answers(self, view):
        answer = view.send(view.request("GET", "/api/health"))
        self.assertTrue(answer.startswith(b"HTTP/1.1 200"), (answer[:300], view.process.poll()))

    def test_the_view_answers_after_a_flood_under_every_limit(self):
        """Closes, ranges, bodies cut short, cells that no one waits for: nothing of it ends the view."""
        for name, limit in LIMITS.items():
            with self.subTest(limit=name):
                view = View(limit)
                threads = [threading.Thread(target=flood, args=(view, number, self.count)) for number in range(THREADS)]
                for thread in threads:
                    thread.start()
                for thread in threads:
                    thread.join()
                self.answers(view)
                code, err = view.close()
                self.assertEqual((code, err), (0, ""))

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("setpriv"), "needs a user without other processes")
    def test_where_the_system_gives_few_threads_it_answers_or_says_so(self):
        """A limit of processes, which counts threads, ends no view by an exception that no one catches."""
        user = ["setpriv", "--reuid", "54321", "--regid", "54321", "--clear-groups"]
        answered = 0
        for most in (1, 2, 3, 4, 5, 6, 8, 12):
            with self.subTest(processes=most):
                view = View(f"ulimit -u {most}", user)
                if view.port:
                    flood(view, most, self.count)
                    self.answers(view)
                    answered += 1
                code, err = view.close()
                self.assertEqual(code, 0 if view.port else 2, err)
                self.assertIn("gives no more" if not view.port else "", err)
        self.assertGreater(answered, 2)

    def test_silent_connections_keep_nobody_out(self):
        """More of them than the view keeps, and it still answers others."""
        view = View("ulimit -n 200")
        silent = [socket.create_connection(("127.0.0.1", view.port)) for _ in range(150)]
        self.answers(view)
        for wire in silent:
            wire.close()
        self.answers(view)
        self.assertEqual(view.close()[0], 0)


if __name__ == "__main__":
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        Floods.count = int(sys.argv.pop(1))
    unittest.main()
