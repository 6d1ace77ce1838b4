"""python -m rheocyte.convergence TABLE.csv OUT: error of the deformation against the number of unknowns.

The table has the columns series,degree,unknowns,deformation,error; one line is drawn for each series, its points are
labelled with the degree where this changes. Rows without an error (the reference itself) are left out.
Writes OUT.png and OUT.svg.
"""

import sys
from pathlib import Path

from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from rheocyte import page
from rheocyte.files import InputError, number, read_table, run, save_figure

COLUMNS = ["series", "degree", "unknowns", "deformation", "error"]
MARKS = [("#12406f", "o"), ("#c8501e", "s"), ("#3d7a4a", "^"), ("#7a4b8f", "D"), ("#8a6d1d", "v"), ("#4a5a66", "P")]


def read_series(path):
    """Name -> list of (unknowns, error, degree), ascending in the unknowns."""
    series = {}
    for row in read_table(path, COLUMNS):
        if (row["error"] or "").strip() in ("", "0"):
            continue
        unknowns, error, degree = (number(row, name, path) for name in ("unknowns", "error", "degree"))
        if unknowns > 0 and error != 0:
            series.setdefault(row["series"], []).append((unknowns, abs(error), degree))
    if not series:
        raise InputError(f"{path} holds no row with an error.")
    return {name: sorted(points) for name, points in series.items()}


def draw(series):
    """The figure, one journal column wide."""
    figure = page.new_figure(page.COLUMN_IN, 2.7, layout="constrained")
    axes = figure.subplots()
    for index, (name, points) in enumerate(series.items()):
        colour, marker = MARKS[index % len(MARKS)]
        unknowns, errors, degrees = zip(*points)
        axes.loglog(unknowns, errors, color=colour, marker=marker, markersize=3.4, linewidth=1, label=name,
                    markeredgecolor="white", markeredgewidth=0.4)
        if len(set(degrees)) > 1:
            for x, y, degree in points:
                axes.annotate(f"{degree:g}", (x, y), xytext=(3.5, 2.5), textcoords="offset points", fontsize=5.5,
                              color=colour)
    axes.set(xlabel="unknowns", ylabel="relative error of the deformation")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}".replace(",", "\u2009")))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(which="major", linewidth=0.35, color="#d5dade")
    axes.set_axisbelow(True)
    axes.legend(frameon=False, handlelength=1.8, borderaxespad=0.2)
    return figure


def main():
    """Command line."""
    if len(sys.argv) != 3:
        raise InputError("give a table and the name of the figure: python -m rheocyte.convergence TABLE.csv OUT.")
    stem = Path(sys.argv[2])
    save_figure(draw(read_series(sys.argv[1])), stem.with_suffix("") if stem.suffix in (".png", ".svg") else stem, 600)


if __name__ == "__main__":
    run(main)
