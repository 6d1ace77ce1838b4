#!/usr/bin/env python3
"""Time until the program answers without solving: help, and each of the bad cases of the tests.

    bench/answers.py [--program build/rheocyte]

Prints median and longest time of whole processes in milliseconds; 100 ms are promised.
"""
import argparse
import statistics
import subprocess
import time
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent


def milliseconds(*command):
    start = time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return 1e3 * (time.perf_counter() - start)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=TOP / "build" / "rheocyte")
    program = str(parser.parse_args().program)
    bad = sorted((TOP / "tests" / "robustness" / "bad_cases").glob("*.toml"))
    times = {"--help": [milliseconds(program, "--help") for _ in range(20)],
             "help case": [milliseconds(program, "help", "case") for _ in range(20)],
             "bad cases": [milliseconds(program, "solve", "--check", str(case)) for case in bad]}
    print("| answer | median (ms) | longest (ms) |\n|---|---|---|")
    for name, values in times.items():
        print(f"| {name} | {statistics.median(values):.1f} | {max(values):.1f} |")


if __name__ == "__main__":
    main()
