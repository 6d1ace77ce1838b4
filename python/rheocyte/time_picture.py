"""python -m rheocyte.time_picture DIR: the way of a cell, from result.json, history.csv and contours.csv in DIR.

Writes DIR/time.png and DIR/time.svg, the deformation over time with some contours above it, and DIR/time.gif, the cell
in its channel. Exit code 2 and one sentence on stderr if a file is missing or damaged.
"""

import io
import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from rheocyte import page
from rheocyte.contour import closed
from rheocyte.files import InputError, check_picture, number, read_result, read_table, run, save_figure, write_file
from rheocyte.result_text import find, made_of
from rheocyte.tube_picture import STYLE

SHOWN = 5  # contours above the curve
GREATEST_FRAMES = 120  # of the animation
FRAME_MS, FRAME_COLOURS = 80, 64
FILL, EDGE = "#fbc873", "#9c1f3a"


def read_contours(path):
    """Times in us and contours (n, 2) in um."""
    rows = read_table(path, ["t_us", "x_um", "r_um"])
    table = np.array([[number(row, name, path) for name in ("t_us", "x_um", "r_um")] for row in rows])
    if len(table) < 3:
        raise InputError(f"{path} holds no contour.")
    starts = np.flatnonzero(np.diff(table[:, 0], prepend=np.nan) != 0)
    return table[starts, 0], [part[:, 1:] for part in np.split(table, starts[1:])]


def read_history(path):
    """Time in us and deformation."""
    rows = read_table(path, ["t_us", "deformation"])
    if not rows:
        raise InputError(f"{path} holds no step.")
    return tuple(np.array([number(row, name, path) for row in rows]) for name in ("t_us", "deformation"))


def draw(result, history, contours):
    """d(t), and above it the cell at equal steps of its deformation."""
    times, shapes = contours
    t, d = history
    figure = page.new_figure(page.COLUMN_IN, 2.6, STYLE)
    axes = figure.add_axes([0.16, 0.15, 0.8, 0.55])
    axes.plot(t, d, color=EDGE, linewidth=1)
    axes.set(xlim=(0, t[-1] or 1), xlabel="time (µs)", ylabel="deformation")
    axes.set_ylim(bottom=0)
    above = figure.add_axes([0.16, 0.72, 0.8, 0.2])
    above.axis("off")
    size = 1.15 * max(np.ptp(shape[:, 0]) for shape in shapes)
    chosen = chosen_frames(times, t, d)
    for place, k in enumerate(chosen):
        outline = closed(shapes[k]) + [size * place, 0]
        above.fill(*outline.T, facecolor=FILL, edgecolor=EDGE, linewidth=0.7)
        above.text(size * place, -0.62 * size, f"{times[k]:.4g} µs", ha="center", va="top", fontsize=5.4)
        axes.plot(times[k], np.interp(times[k], t, d), "o", color=EDGE, markersize=2.2)
    above.set(xlim=(-0.6 * size, (SHOWN - 0.4) * size), ylim=(-0.6 * size, 0.6 * size), aspect="equal")
    figure.text(0.5, 0.985, "   ".join(filter(None, made_of(result))), ha="center", va="top", weight="bold")
    return figure


def chosen_frames(times, t, d):
    """Frames at equal steps of the deformation, up or down, the first and the last among them."""
    way = np.concatenate([[0], np.cumsum(np.abs(np.diff(np.interp(times, t, d))))])
    wanted = np.linspace(0, way[-1], SHOWN)
    return sorted({int(np.argmin(np.abs(way - value))) for value in wanted} | {0, len(times) - 1})[:SHOWN + 1]


def read_wall(folder):
    """Wall of a channel that is not straight and the way of the cell: (x, radius), (time, position); None if straight."""
    if not (folder / "channel.csv").exists():
        return None
    tables = []
    for name, columns in (("channel.csv", ("x_um", "R_um")), ("history.csv", ("t_us", "position_um"))):
        rows = read_table(folder / name, list(columns))
        tables.append([np.array([number(row, column, folder / name) for row in rows]) for column in columns])
    return tables


def seen_walls(result, folder):
    """The wall that the camera sees, and the half width of the channel there, the least one if it varies (um)."""
    channel = find(result, "case", "channel") or {}
    wall, radius = read_wall(folder), find(result, "tube_radius_um")
    if wall is not None and find(channel, "camera_degree") == 90:  # the height does not vary
        wall = None
        radius = (find(channel, "height_um") or min(find(channel, "profile", "width_um"))) / 2
    if wall is not None:
        radius = min(wall[0][1])
    return wall, radius or find(channel, "width_um") and channel["width_um"] / 2


def wall_round_cell(wall, radius, time):
    """Places from the cell's centre and the wall's radii there."""
    reach = 2.5 * radius
    if wall is None:
        return np.array([-reach, reach]), np.array([radius, radius])
    (x, radii), way = wall
    here = np.interp(time, *way)
    places = np.linspace(-reach, reach, 200)
    return places, np.interp(places + here, x, radii)


def animation(history, contours, wall, radius):
    """The cell between the walls, as a film: the content of a GIF file."""
    times, shapes = contours
    steps = np.unique(np.linspace(0, len(times) - 1, min(len(times), GREATEST_FRAMES)).round().astype(int))
    radius = radius or 1.2 * max(shape[:, 1].max() for shape in shapes)
    widest = radius if wall is None else max(wall_round_cell(wall, radius, t)[1].max() for t in times)
    height = 1.18 * widest
    figure = page.new_figure(4.4, 4.4 * height / (2 * radius), STYLE, dpi=110)
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set(xlim=(-2 * radius, 2 * radius), ylim=(-height, height), aspect="equal")
    axes.axis("off")
    walls = [axes.fill([0], [0], color="#9aa5ad")[0] for _ in range(2)]
    (cell,) = axes.fill(*closed(shapes[0]).T, facecolor=FILL, edgecolor=EDGE, linewidth=1.2)
    label = axes.text(-1.9 * radius, 0.82 * height, "", va="top", fontsize=9)

    def show(k):
        x, radii = wall_round_cell(wall, radius, times[k])
        for side, drawn in zip((-1, 1), walls):
            drawn.set_xy(np.column_stack([np.concatenate([x, x[::-1]]),
                                          side * np.concatenate([radii, np.full(len(x), 3 * widest)])]))
        cell.set_xy(closed(shapes[k]))
        label.set_text(f"{times[k]:.4g} µs\nd = {np.interp(times[k], *history):.4f}")

    canvas, frames = FigureCanvasAgg(figure), []
    for k in steps:
        show(k)
        canvas.draw()
        image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
        frames.append(image.quantize(FRAME_COLOURS, Image.Quantize.FASTOCTREE, dither=0))
    film = io.BytesIO()
    frames[0].save(film, "GIF", save_all=True, append_images=frames[1:], duration=FRAME_MS, loop=0, comment="rheocyte")
    return film.getvalue()


def draw_folder(folder):
    """All pictures of a result in time."""
    result = read_result(folder / "result.json")
    history, contours = read_history(folder / "history.csv"), read_contours(folder / "contours.csv")
    save_figure(draw(result, history, contours), folder / "time")
    check_picture(folder / "time.gif")
    write_file(folder / "time.gif", animation(history, contours, *seen_walls(result, folder)))


def main():
    """Command line."""
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        raise InputError("give the folder of one result in time: python -m rheocyte.time_picture DIR.")
    draw_folder(Path(sys.argv[1]))


if __name__ == "__main__":
    run(main)
