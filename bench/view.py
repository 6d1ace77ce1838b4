#!/usr/bin/env python3
"""Times of the view's interface, as a slider meets them.

    bench/view.py [PROGRAM]           200 moves of Young's modulus by 2 %, with contour and fields, warm
    bench/view.py square [PROGRAM]    the first answer in a square channel, as the page asks for it (accuracy 3e-2): cells
                                      of several sizes, each from nothing and after a move of 3 %
    bench/view.py cancel [PROGRAM]    how long the program works on after its client has left in the middle of a solve
"""
import http.client
import json
import os
import random
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

    def ask_and_leave(self, path, body, after):
        """Seconds that the program works on once a client has left without its answer; none if it was there before."""
        connection = http.client.HTTPConnection(self.connection.host, self.connection.port)
        connection.request("POST", path, json.dumps(body), self.head)
        time.sleep(after)
        connection.sock.close()
        left = time.perf_counter()
        worked, idle_since = self.processor_seconds(), left
        while time.perf_counter() - idle_since < 0.1:
            time.sleep(0.002)
            if self.processor_seconds() > worked:
                worked, idle_since = self.processor_seconds(), time.perf_counter()
        return idle_since - left

    def processor_seconds(self):
        with open(f"/proc/{self.process.pid}/stat") as stat:
            fields = stat.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

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


NEWTONIAN = {"rate_ul_per_s": 0.04, "viscosity_mPas": 15}
POWER_LAW = {"rate_ul_per_s": 0.04, "law": "power-law", "consistency_Pa_sn": 0.179, "exponent": 0.677}


def square(view):
    """Prints the seconds of first answers, the solver's part and the answer's size."""
    for liquid, flow in (("Newtonian", NEWTONIAN), ("power law", POWER_LAW)):
        series = {"from nothing": ([], []), "after a move": ([], [])}
        for radius, modulus in ((4, 1.5), (5, 2), (6, 2.5), (6, 4), (7, 4), (7.5, 6)):
            for move, name in ((1, "from nothing"), (1.03, "after a move")):
                cell = {"channel": {"section": "square", "width_um": 20}, "flow": flow,
                        "cell": {"radius_um": radius, "bulk": {"young_modulus_kPa": modulus * move}}}
                path = f"/api/state?stream=square-{liquid[0]}-{radius}-{modulus}&accuracy=3e-2&fields=1"
                status, content, seconds = view.ask(path, cell)
                assert status == 200, content
                series[name][0].append(seconds)
                series[name][1].append(json.loads(content)["wall_time_s"])
        for name, (answers, solves) in series.items():
            row(f"square, {liquid}, {name}", answers)
            row("    of these the solver", solves)
    print(f"    program of {view.memory_MB():.0f} MB")


def cancel(view):
    """Prints how long cases of several kinds are worked on after their clients have left, at random times."""
    rates = random.Random(1)
    tube, duct = {"width_um": 20}, {"section": "square", "width_um": 20}
    in_time = {"end_us": 2000, "output_every_us": 20}
    cases = (("tube, 1e-6", "state", tube, 7, 4, 1e-6, None, 0.2), ("tube, far too soft", "state", tube, 7, 0.2, 1e-4, None, 0.2),
             ("square, 3e-2", "state", duct, 6, 2.5, 3e-2, None, 0.4), ("square, 1e-3", "state", duct, 6, 2.5, 1e-3, None, 2),
             ("square, r0/h = 0.9, 1e-3", "state", duct, 9, 25, 1e-3, None, 4), ("in time", "evolve", tube, 7, 4, 1e-3, in_time, 1))
    for name, route, channel, radius, modulus, accuracy, way, longest in cases:
        seconds = []
        for k in range(15):
            cell = {"channel": channel, "flow": NEWTONIAN, "numerics": {"accuracy": accuracy},
                    "cell": {"radius_um": radius, "bulk": {"young_modulus_kPa": modulus * (1 + 0.01 * k)}}}
            if way:
                cell["time"], cell["cell"]["viscosity_mPas"] = way, 15
            seconds.append(view.ask_and_leave(f"/api/{route}?stream=cancel-{route}-{k}", cell, rates.uniform(0.02, longest)))
        row(f"after the client has left: {name}", seconds)


def row(name, seconds):
    ordered = sorted(seconds)
    print(f"{name:<44} median {1e3 * statistics.median(ordered):6.1f} ms   95 % {1e3 * ordered[int(0.95 * len(ordered))]:6.1f} ms")


def main(arguments):
    named = {"square": square, "cancel": cancel}
    measure = named.get(arguments[0]) if arguments else None
    programs = arguments[1:] if measure else arguments
    view = View(programs[0] if programs else "build/rheocyte")
    try:
        if measure:
            return measure(view)
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
