"""python -m rheocyte.figure --program PATH N DIR [RECORDINGS]: figure N of Mokbel et al. 2017, solving what is missing.

Writes DIR/figure-N.png, .svg and .csv and keeps the results in DIR/cases and DIR/tables. Exit code 2 and one sentence on stderr for
the user's errors, 1 if a cell could not be solved (the figure says so at its place), 128 + number after a signal.
"""

import argparse
import importlib
import pkgutil
import signal
import sys
import time
from pathlib import Path

from rheocyte import figures
from rheocyte.files import InputError, check_figure, run, save_figure, save_table

DPI = 300


class Stopped(BaseException):
    """A signal that ends the program."""

    def __init__(self, number):
        super().__init__(number)
        self.number = number


class Parser(argparse.ArgumentParser):
    """Errors as one sentence."""

    def error(self, message):
        raise InputError(f"{message} (see `rheocyte figure --help`)")


def available():
    """Numbers of the figures for which there is a module, then the names of those that are not in the paper."""
    names = [module.name.removeprefix("figure").removeprefix("_").replace("_", "-")
             for module in pkgutil.iter_modules(figures.__path__) if module.name.startswith("figure")]
    return sorted(filter(str.isdecimal, names), key=int) + sorted(name for name in names if not name.isdecimal())


def chosen(text):
    """The number or name of an available figure."""
    numbers = available()
    if text in numbers:
        return text
    listed = " and ".join(filter(None, [", ".join(numbers[:-1]), numbers[-1]]))
    raise InputError(f"there is no figure {text[:40]!r} here; available are {listed}, for example `rheocyte figure "
                     f"{numbers[0]}`.")


def drawing(number):
    """The module of a figure."""
    name = f"figure{number}" if number.isdecimal() else f"figure_{number.replace('-', '_')}"
    return importlib.import_module(f"rheocyte.figures.{name}")


def make(number, folder, program, recordings=(), options=(), table=""):
    """Solves, draws and writes; returns the cells that could not be solved."""
    from rheocyte.figures.cases import Laboratory, make_folder

    start = time.monotonic()
    if recordings and number != "real-cells":
        raise InputError(f"figure {number} draws no recordings ({recordings[0][:60]}); real-cells does.")
    if not recordings and number == "real-cells":
        raise InputError("figure real-cells draws recordings; give them behind its name, for example "
                         "`rheocyte figure real-cells *.rtdc`.")
    make_folder(folder)
    stem = folder / f"figure-{number}"
    check_figure(stem)
    laboratory = Laboratory(program, folder / "cases", tell=lambda line: print(line, file=sys.stderr, flush=True),
                            recordings=list(recordings), options=list(options), table=table)
    figure, rows = drawing(number).make(laboratory)
    save_figure(figure, stem, DPI, palette=True, svg_dpi=180)
    save_table(stem.with_suffix(".csv"), rows)
    print(f"{stem}.png, .svg and .csv are drawn, after {time.monotonic() - start:.1f} s")
    return laboratory.failures


def raise_stopped(number, _):
    """Signal handler."""
    signal.signal(number, signal.SIG_DFL)
    raise Stopped(number)


def main():
    """Command line."""
    parser = Parser(prog="rheocyte figure", description=__doc__.splitlines()[0])
    parser.add_argument("number", metavar="N")
    parser.add_argument("folder", metavar="DIR", type=Path)
    parser.add_argument("recordings", metavar="FILE", nargs="*")
    parser.add_argument("--viscosity-mPas", help="viscosity of the liquid (mPa s), for recordings without a known medium")
    parser.add_argument("--temperature-if-missing", help="temperature (degC), for recordings without one")
    parser.add_argument("--table", default="", help="folder of a combined table of elongated cells")
    parser.add_argument("--program", required=True, help="the program rheocyte that solves")
    arguments = parser.parse_args()
    number = chosen(arguments.number)
    for name in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(name, raise_stopped)
    try:
        given = {"--viscosity-mPas": arguments.viscosity_mPas,
                 "--temperature-if-missing": arguments.temperature_if_missing}
        options = [part for name, text in given.items() if text for part in (name, text)]
        failures = make(number, arguments.folder, arguments.program, arguments.recordings, options,
                        arguments.table)
    except Stopped as stopped:
        print(f"rheocyte: stopped; what was solved is kept in {arguments.folder}, the same command continues "
              "from there.", file=sys.stderr)
        sys.exit(128 + stopped.number)
    if failures:
        names = ", ".join(solution.name for solution in failures[:3])
        more = f" and {len(failures) - 3} more" if len(failures) > 3 else ""
        print(f"rheocyte: not solved, and marked in the figure: {names}{more} ({failures[0].trouble.rstrip('.')}).",
              file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    run(main)
