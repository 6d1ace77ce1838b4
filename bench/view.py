#!/usr/bin/env python3
"""Times of the view's interface, as a slider meets them.

    bench/view.py [PROGRAM]        200 moves of Young's modulus by 2 %, with contour and fields, warm
"""
import http.client
import json
import re
import statistics
import subprocess
import sys
import time

CELL = {"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
        "cell": {"radius_um": 7, "bulk": {"young_modulus_kPa": 4}}}
MOVES = 200


class View:
    """The running program and one connection to it."""

    def __init__(self, program):
        self.process = subprocess.Popen([program, "view", "--no-browser"], stdout=subprocess.PIPE, text=True)
        found = re.match(r"view: http://(.*):(\d+)/\?token=(\w+)", self.process.stdout.readline())
        self.head = {"Authorization": f"Bearer {found[3]}"}
        self.connection = http.client.HTTPConnection(found[1], int(found[2]))

    def ask(self, path, body):
        """(status, bytes of the answer, seconds)."""
        start = time.perf_counter()
        self.connection.request("POST", path, json.dumps(body), self.head)
        answer = self.connection.getresponse()
        content = answer.read()
        return answer.status, content, time.perf_counter() - start

    def memory_MB(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(re.search(r"VmRSS:\s*(\d+)", status.read())[1]) / 1024


def moves(view, query):
    """Seconds of each answer, seconds of the solver in it, bytes of the last one."""
    cell = json.loads(json.dumps(CELL))
    answers, solves, size = [], [], 0
    for k in range(MOVES + 1):
        cell["cell"]["bulk"]["young_modulus_kPa"] = 4 * 1.02 ** (30 - abs(k % 60 - 30))  # to and fro
        status, content, seconds = view.ask(f"/api/state?stream=bench&{query}", cell)
        assert status == 200, content
        if k > 0:
            answers.append(seconds)
            solves.append(json.loads(content)["wall_time_s"])
        size = len(content)
    return answers, solves, size


def row(name, seconds):
    ordered = sorted(seconds)
    print(f"{name:<44} median {1e3 * statistics.median(ordered):6.1f} ms   95 % {1e3 * ordered[int(0.95 * len(ordered))]:6.1f} ms")


def main(arguments):
    view = View(arguments[0] if arguments else "build/rheocyte")
    try:
        for name, query in (("numbers and contour, 1e-3", "accuracy=1e-3"), ("with fields, 1e-3", "accuracy=1e-3&fields=1"),
                            ("with fields, 1e-4", "accuracy=1e-4&fields=1")):
            answers, solves, size = moves(view, query)
            row(name, answers)
            row("    of these the solver", solves)
            print(f"    answer of {size / 1e3:.0f} kB, program of {view.memory_MB():.0f} MB")
    finally:
        view.process.terminate()
        view.process.wait()


if __name__ == "__main__":
    main(sys.argv[1:])
