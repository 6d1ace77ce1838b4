"""Solving the cases of a figure with the program, several at a time, and using again what was solved before."""

import json
import os
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

from rheocyte.files import InputError, read_contour, read_result, reason, write_text

USER_ERROR, NUMERICAL = 2, 3  # exit codes of the program
POLL_S = 0.02
GRACE_S = 10  # for a program that was asked to stop


@dataclass(frozen=True)
class Solution:
    """One cell that was solved, or the reason why it was not."""

    name: str
    folder: Path
    result: dict  # result.json; without numbers if there is no result

    @property
    def converged(self):
        return self.result["status"] == "converged"

    @property
    def trouble(self):
        """Why there is nothing to draw; empty if there is."""
        if self.converged:
            return ""
        return ": ".join(filter(None, [str(self.result["status"]), str(self.result.get("message") or "")]))

    def __getitem__(self, key):
        """A number of result.json, of a converged state only: no other may reach a figure."""
        if not self.converged:
            raise KeyError(f"{self.name} has not converged")
        value = self.result.get(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise InputError(f"{self.folder / 'result.json'} holds no number under \"{key}\".")
        return value

    def contour(self):
        """The meridian (n, 2) in um, from the front pole to the rear pole."""
        return read_contour(self.folder / "contour.csv")


@dataclass
class Laboratory:
    """Where cells are solved: the program, the folder `cases` that keeps the results, and what went wrong so far."""

    program: str
    folder: Path
    processors: int = field(default_factory=lambda: len(os.sched_getaffinity(0)))
    tell: object = print
    failures: list = field(default_factory=list)  # of Solution
    recordings: list = field(default_factory=list)  # paths of .rtdc files, for the figures that draw them
    options: list = field(default_factory=list)  # of `rheocyte extract` and `moduli`, for them
    table: str = ""  # combined, by which their median outlines are fitted

    def solve(self, cases):
        """Solutions of a dictionary name -> case (keys as in `rheocyte help case`), under the same names."""
        solutions, missing = {}, {}
        for name, case in cases.items():
            make_folder(self.folder)
            file = self.folder / f"{name}.toml"
            write_text(file, toml(case))
            identity = self.identity(file)
            kept = self.kept(name, identity)
            if kept:
                solutions[name] = kept
            else:
                missing[name] = (file, identity)
        if solutions:
            self.tell(f"{len(solutions)} of {len(cases)} results exist already")
        solutions.update(self.run(missing))
        ordered = {name: solutions[name] for name in cases}
        self.failures += [solution for solution in ordered.values() if not solution.converged]
        return ordered

    def identity(self, file):
        """(version, case_hash) that a result of the case will carry."""
        ended = self.call("solve", file, "--check", "--json")
        if ended.returncode != 0:
            raise InputError(last_line(ended.stderr) or f"{self.program} cannot check {file}.")
        try:
            answer = json.loads(ended.stdout)
            return answer["version"], answer["case_hash"]
        except (json.JSONDecodeError, KeyError, TypeError) as error:
            raise InputError(f"{self.program} is not the program of this version: it prints no case_hash.") from error

    def call(self, *arguments):
        """A short call of the program, finished."""
        try:
            return subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False,
                                  stdin=subprocess.DEVNULL)
        except OSError as error:
            raise InputError(f"{self.program} cannot be started: {reason(error)}.") from error

    def kept(self, name, identity):
        """The converged result of exactly this case and version, None if there is none."""
        folder = self.folder / name
        try:
            result = read_result(folder / "result.json")
            read_contour(folder / "contour.csv")
        except InputError:
            return None
        same = (result.get("version"), result.get("case_hash")) == identity
        return Solution(name, folder, result) if same and result["status"] == "converged" else None

    def run(self, missing):
        """Solves name -> (file, identity), as many at a time as there are processors; stops them if interrupted."""
        waiting, running, solutions = list(missing.items()), {}, {}
        try:
            while waiting or running:
                while waiting and len(running) < self.processors:
                    name, (file, identity) = waiting.pop(0)
                    running[self.start(name, file)] = (name, identity, time.monotonic())
                time.sleep(POLL_S)
                for process in [process for process in running if process.poll() is not None]:
                    name, identity, start = running.pop(process)
                    solutions[name] = self.finished(name, identity, process)
                    self.report(solutions[name], len(solutions), len(missing), time.monotonic() - start)
        finally:
            stop(running)
        return solutions

    def start(self, name, file):
        """The program on one case, in a session of its own: signals reach it only from here."""
        arguments = [self.program, "solve", str(file), "-o", str(self.folder / name), "--quiet", "--no-picture",
                     "--no-output-fields", "--threads", "1"]
        try:
            return subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, text=True, start_new_session=True)
        except OSError as error:
            raise InputError(f"{self.program} cannot be started: {reason(error)}.") from error

    def finished(self, name, identity, process):
        """What a process that has ended left in the folder of its case."""
        said = last_line(process.stderr.read())
        process.stderr.close()
        if process.returncode == USER_ERROR:
            raise InputError(said or f"{self.program} refuses the case {name}.")
        folder = self.folder / name
        if process.returncode in (0, NUMERICAL):
            result = read_result(folder / "result.json")
            if (result.get("version"), result.get("case_hash")) == identity:
                return Solution(name, folder, result)
            said = "the result is that of another case"
        return Solution(name, folder, {"status": "failed", "message": said or "the program ended without a word"})

    def report(self, solution, count, total, seconds):
        """One line of progress."""
        outcome = f"d = {solution['deformation']:.6f}" if solution.converged else solution.trouble
        self.tell(f"[{count:>{len(str(total))}}/{total}] {solution.name}: {outcome} ({seconds:.1f} s)")

    def analytic(self, name, case):
        """The analytical model of small deformations for a solid or shell of paper.py; takes milliseconds, is not kept."""
        folder = self.folder / name
        make_folder(folder)
        ended = self.call("analytic", "cell", *analytic_options(case), "--json", "-o", folder / "contour.csv")
        try:
            result = {**json.loads(ended.stdout), "status": "converged"} if ended.returncode == 0 else None
        except (json.JSONDecodeError, TypeError):
            result = None
        solution = Solution(name, folder, result or {"status": "failed", "message": last_line(ended.stderr)})
        self.failures += [] if solution.converged else [solution]
        return solution


def stop(processes):
    """Ends processes that still run: kindly, then for good."""
    alive = [process for process in processes if process.poll() is None]
    for process in alive:
        process.terminate()
    end = time.monotonic() + GRACE_S
    for process in alive:
        try:
            process.wait(max(0, end - time.monotonic()))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def make_folder(folder):
    """Makes a folder with its parents."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder} cannot be made: {reason(error)}.") from error


def toml(case):
    """A case file from the dictionary of its keys."""
    sections = {}
    for key, value in case.items():
        section, _, name = key.rpartition(".")
        sections.setdefault(section, []).append(f"{name} = {json.dumps(value)}\n")
    return "\n".join(f"[{section}]\n{''.join(lines)}" for section, lines in sections.items())


def analytic_options(case):
    """Options of `rheocyte analytic cell`. The model has no inertia and one elastic law: those keys do not count."""
    names = {"cell.radius_um": "--radius-um", "channel.radius_um": "--tube-radius-um",
             "flow.rate_ul_per_s": "--flow-rate-ul-s", "flow.viscosity_mPas": "--viscosity-mPas",
             "cell.bulk.young_modulus_kPa": "--young-modulus-kPa",
             "cell.cortex.modulus_mN_per_m": "--cortex-modulus-mN-m", "cell.cortex.tension_ratio": "--tension-ratio"}
    return [text for key, option in names.items() if key in case for text in (option, repr(case[key]))]


def last_line(text):
    """The last line that says something."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1].removeprefix("rheocyte: ") if lines else ""
