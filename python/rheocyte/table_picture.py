"""python -m rheocyte.table_picture DIR: pictures of a look-up table from table_*.csv and end-of-branch.csv in DIR.

Writes, as PNG and SVG: lines (lines of equal stiffness, the end of the smooth branches, the regularised region),
coverage (the rows) and error (the estimated error of the stiffness). Exit code 2 and one sentence if a file is missing
or damaged.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from rheocyte import colours, page
from rheocyte.files import InputError, number, read_table, run, save_figure

UNITS = {"young_modulus_kPa": "kPa", "cortex_modulus_mN_per_m": "mN/m"}
NAMES = {"young_modulus_kPa": "Young's modulus", "cortex_modulus_mN_per_m": "modulus of the cortex"}
COLUMNS = ["radius_um", "area_um2", "deformation", "deformation_error", "stiffness_error", "regularised",
           "end_of_branch"]
LINE_COUNT = 11
LINE, REGULARISED = "#12406f", "#e5703a"


@dataclass
class Grid:
    """States at the deformations that all radii share: arrays (radii, deformations), NaN where there is none."""

    area: np.ndarray  # without gaps
    deformation: np.ndarray  # without gaps
    stiffness: np.ndarray
    error: np.ndarray  # relative, of the stiffness


@dataclass
class Table:
    """Columns of all rows, the name of the stiffness, and the ends of branches: area and deformation, (n, 2)."""

    name: str
    stiffness_name: str
    column: dict
    end: np.ndarray  # where the bare surface loses its stability
    end_radius: np.ndarray  # of the spheres (n)
    other_end: np.ndarray  # where branches end for other reasons

    @property
    def unit(self):
        """Of the stiffness."""
        return UNITS[self.stiffness_name]

    @property
    def regularised(self):
        """Rows whose surface is stabilised by bending stiffness."""
        return self.column["regularised"] > 0


def read_folder(folder):
    """The table of a folder."""
    folder = Path(folder)
    files = sorted(folder.glob("table_*.csv"))
    if len(files) != 1:
        raise InputError(f"{folder} contains {len(files)} files table_*.csv; it needs one, from rheocyte table.")
    rows = read_table(files[0], COLUMNS)
    stiffness = next((name for name in UNITS if rows and name in rows[0]), None)
    if stiffness is None:
        raise InputError(f"{files[0]} contains no rows with a stiffness; it needs a column {' or '.join(UNITS)}.")
    column = {name: np.array([number(row, name, files[0]) for row in rows]) for name in COLUMNS + [stiffness]}
    path = folder / "end-of-branch.csv"
    ends = read_table(path, ["radius_um", "area_um2", "deformation", "status"])
    place = np.array([[number(row, name, path) for name in ("area_um2", "deformation", "radius_um")]
                      for row in ends]).reshape(-1, 3)
    unstable = np.array([row["status"] == "surface-unstable" for row in ends], dtype=bool)
    return Table(files[0].stem.removeprefix("table_"), stiffness, column, place[unstable, :2], place[unstable, 2],
                 place[~unstable, :2])


def grid_of(table):
    """The rows as arrays by radius and deformation; ends of branches, which lie between, are left out."""
    column = {name: values[table.column["end_of_branch"] == 0] for name, values in table.column.items()}
    radii, row = np.unique(column["radius_um"], return_inverse=True)
    levels, place = np.unique(column["deformation"], return_inverse=True)
    gap = np.full((len(radii), len(levels)), np.nan)
    area, stiffness, error = gap.copy(), gap.copy(), gap.copy()
    area[row, place] = column["area_um2"]
    stiffness[row, place] = column[table.stiffness_name]
    error[row, place] = column["stiffness_error"]
    for line in area:
        known = np.isfinite(line)
        line[~known] = np.interp(levels[~known], levels[known], line[known])
    return Grid(area, np.tile(levels, (len(radii), 1)), stiffness, error)


def line_levels(grid):
    """Stiffnesses whose lines fill the plane: equal steps of stiffness^(-1/2), two digits."""
    deformed = grid.stiffness[:, grid.deformation[0] >= 0.1 * grid.deformation[0, -1]]
    deformed = deformed[np.isfinite(deformed).any(axis=1)]
    soft = grid.stiffness[len(grid.stiffness) // 10:]
    soft = soft[np.isfinite(soft).any(axis=1)]
    first = np.nanmax(deformed[-1] if len(deformed) else grid.stiffness) ** -0.5
    last = np.nanmin(soft[0]) ** -0.5
    roots = first + (last - first) * np.arange(LINE_COUNT) / (LINE_COUNT - 0.5)
    return sorted({float(f"{root**-2:.2g}") for root in roots})


def regularised_outline(table):
    """Polygon (n, 2) round the regularised rows: each radius from its first to its last one."""
    radius = table.column["radius_um"]
    points = np.stack([table.column["area_um2"], table.column["deformation"]], axis=1)
    lower, upper = [], []
    for r in np.unique(radius[table.regularised]):
        rows = points[(radius == r) & (table.regularised | (table.column["end_of_branch"] > 0))]
        lower.append(rows[0])
        upper.append(rows[-1])
    return np.array(lower + upper[::-1]).reshape(-1, 2)


def new_axes(table, logarithmic):
    """One journal column; area against deformation."""
    figure = page.new_figure(page.COLUMN_IN, 2.8, layout="constrained")
    axes = figure.subplots()
    axes.set(xlabel="area in µm²", ylabel="deformation")
    top = table.column["deformation"].max()
    if logarithmic:
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.yaxis.set_minor_formatter(NullFormatter())
    else:
        axes.set_ylim(0, 1.03 * top)
    axes.set_xlim(min(0.97 * table.column["area_um2"].min(), 25), 1.01 * table.column["area_um2"].max())
    return figure, axes


def inside_table(table, points):
    """Which of the points (n, 2) lie in the table's ranges of area and deformation."""
    area, top = table.column["area_um2"], 1.001 * table.column["deformation"].max()
    return (points[:, 0] >= area.min()) & (points[:, 0] <= area.max()) & (points[:, 1] <= top)


def curve_of_ends(table):
    """The end of the smooth branches (n, 2), with gaps (NaN) where a radius between two has no such end."""
    inside = inside_table(table, table.end)
    place = np.searchsorted(np.unique(table.column["radius_um"]), table.end_radius[inside])
    gaps = np.flatnonzero(np.diff(place) > 1) + 1
    return np.insert(table.end[inside], gaps, np.nan, axis=0)


def draw_end(axes, table):
    """The curve behind which the bare surface is unstable, inside the table's range, and other ends of branches."""
    handles, curve = [], curve_of_ends(table)
    if len(curve):
        handles += axes.plot(*curve.T, color=colours.ALARM, linewidth=1.1, zorder=4,
                             label="end of the smooth branches")
    other = table.other_end[inside_table(table, table.other_end)]
    if len(other):
        handles += axes.plot(*other.T, color=colours.ALARM, linestyle="", marker="x", markersize=3, zorder=4,
                             label="other ends")
    return handles


def label_lines(axes, drawn, levels, unit):
    """The stiffness of each line near its upper end, where no other label stands."""
    taken = np.empty((0, 2))
    for level, segments in zip(levels, drawn.allsegs):
        points = max(segments, key=len, default=np.empty((0, 2)))
        if len(points) < 3:
            continue
        points = points if points[-1, 1] < points[0, 1] else points[::-1]
        shown = axes.transData.transform(points)
        distance = np.hypot(*(shown - shown[0]).T)
        places = [np.abs(distance - wanted).argmin() for wanted in range(16, 120, 8) if wanted < distance.max()]
        free = [k for k in places if len(taken) == 0 or np.hypot(*(taken - shown[k]).T).min() > 24]
        if not free:
            continue
        k = free[0]
        taken = np.vstack([taken, shown[k]])
        direction = shown[k] - shown[min(k + 3, len(shown) - 1)]
        angle = (np.degrees(np.arctan2(direction[1], direction[0])) + 90) % 180 - 90
        axes.annotate(f"{level:g} {unit}" if level == levels[-1] else f"{level:g}", points[k], rotation=angle,
                      fontsize=5.5, ha="center", va="center", color=LINE, zorder=5,
                      bbox={"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none"})


def add_legend(axes, handles):
    """Below the axes, where it hides nothing."""
    if handles:
        axes.legend(handles=handles, frameon=False, loc="upper center", bbox_to_anchor=(0.46, -0.17), fontsize=6,
                    ncols=min(2, len(handles)), borderaxespad=0.1, columnspacing=1.2, handlelength=1.5, handletextpad=0.5)


def draw_lines(table, grid):
    """Lines of equal stiffness with their values."""
    figure, axes = new_axes(table, logarithmic=False)
    handles = []
    outline = regularised_outline(table)
    if len(outline):
        axes.fill(*outline.T, facecolor=REGULARISED, alpha=0.16, linewidth=0, zorder=1)
        handles.append(Patch(facecolor=REGULARISED, alpha=0.16, label="surface stabilised by bending"))
    levels = line_levels(grid)
    drawn = axes.contour(grid.area, grid.deformation, np.ma.masked_invalid(np.log(grid.stiffness)), np.log(levels),
                         colors=LINE, linewidths=0.9, linestyles="solid", zorder=3)
    handles = draw_end(axes, table) + handles
    axes.set_title(f"{table.name}: lines of equal {NAMES[table.stiffness_name]}", fontsize=7, loc="left")
    add_legend(axes, handles)
    figure.draw_without_rendering()  # the labels need to know where the axes are
    label_lines(axes, drawn, levels, table.unit)
    return figure


def draw_coverage(table):
    """Each row is a point."""
    figure, axes = new_axes(table, logarithmic=True)
    handles = []
    area, deformation = table.column["area_um2"], table.column["deformation"]
    for rows, colour, label in ((~table.regularised, LINE, "bare surface"),
                                (table.regularised, REGULARISED, "surface stabilised by bending")):
        if rows.any():
            axes.plot(area[rows], deformation[rows], ".", color=colour, markersize=1.3, markeredgewidth=0,
                      rasterized=True)
            handles.append(Line2D([], [], color=colour, marker=".", linestyle="", label=f"{label} ({rows.sum()})"))
    handles += draw_end(axes, table)
    axes.set_title(f"{table.name}: rows", fontsize=7, loc="left")
    add_legend(axes, handles)
    return figure


def corners(centres):
    """Corners (n + 1, m + 1) of the cells round points (n, m)."""
    for axis in (0, 1):
        moved = np.moveaxis(centres, axis, 0)
        inner = (moved[1:] + moved[:-1]) / 2
        moved = np.concatenate([2 * moved[:1] - inner[:1], inner, 2 * moved[-1:] - inner[-1:]])
        centres = np.moveaxis(moved, 0, axis)
    return centres


def draw_error(table, grid):
    """The estimated relative error of the stiffness as colour."""
    figure, axes = new_axes(table, logarithmic=True)
    percent = 100 * grid.error
    ticks = np.array([digit * 10.0**power for power in range(-8, 5) for digit in (1, 2, 5)])
    positive = percent[percent > 0]
    least, greatest = (positive.min(), positive.max()) if positive.size else (0.01, 0.1)
    norm = LogNorm(ticks[ticks <= least].max(initial=ticks[0]), ticks[ticks > greatest].min(initial=ticks[-1]))
    mesh = axes.pcolormesh(corners(grid.area), np.exp(corners(np.log(grid.deformation))), np.ma.masked_invalid(percent),
                           cmap=colours.LIQUID, norm=norm, rasterized=True)
    handles = draw_end(axes, table)
    bar = figure.colorbar(mesh, ax=axes, pad=0.02, aspect=30)
    bar.set_label(f"estimated error of the {NAMES[table.stiffness_name]} in %")
    bar.ax.yaxis.set_major_locator(FixedLocator(ticks[(ticks >= norm.vmin) & (ticks <= norm.vmax)]))
    bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    bar.ax.yaxis.set_minor_formatter(NullFormatter())
    axes.set_title(f"{table.name}: estimated error", fontsize=7, loc="left")
    add_legend(axes, handles)
    return figure


def main():
    """Command line."""
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        raise InputError("give the folder of one table: python -m rheocyte.table_picture DIR.")
    folder = Path(sys.argv[1])
    table = read_folder(folder)
    grid = grid_of(table)
    for name, figure in (("lines", draw_lines(table, grid)), ("coverage", draw_coverage(table)),
                         ("error", draw_error(table, grid))):
        save_figure(figure, folder / name)


if __name__ == "__main__":
    run(main)
