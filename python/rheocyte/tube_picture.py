"""The cell in its tube with flow and stress, from result.json, contour.csv and fields.vtu of one result."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path as Outline
from matplotlib.ticker import FuncFormatter, MaxNLocator

from rheocyte import colours, page
from rheocyte.contour import bridges, closed, convex_hull
from rheocyte.files import InputError, read_column, read_contour, read_result
from rheocyte.page import COLUMN_IN
from rheocyte.raster import PixelGrid, Raster, extended, mirrored, rasterise, stream_function
from rheocyte.result_text import deformation_with_error, elongated_by, failure_note, find, made_of, part
from rheocyte.vtu import read_vtu

COLUMNS = 720  # of pixels of the fields
SVG_DPI = COLUMNS / COLUMN_IN  # an SVG keeps the fields as they are
VIEW = 2.2  # half the length shown, in channel radii
WALL = 0.17  # thickness of the drawn wall, in channel radii
SIDE_IN = 0.06  # margin beside the channel
HEAD_IN = 0.032  # length of an arrow head on a streamline
FINE = 0.6  # line width of everything that is not the contour, in points
STYLE = page.STYLE | {"font.size": 6.5, "axes.linewidth": 0.5, "xtick.major.width": 0.5, "xtick.major.size": 2}


@dataclass
class Story:
    """All that the picture shows; lengths in um, pixels cover the half section r >= 0."""

    result: dict
    contour: np.ndarray
    radius: float  # of the channel
    grid: PixelGrid
    relative: np.ndarray  # (3, rows, columns): axial, radial, magnitude of the liquid's velocity seen from the cell
    stress_kPa: np.ndarray
    tension: np.ndarray | None  # meridional, along the contour, in mN/m; None where the cell has an elastic interior


def read_story(folder):
    """Reads the folder and puts its fields on pixels."""
    folder = Path(folder)
    result = read_result(folder / "result.json")
    contour = read_contour(folder / "contour.csv")
    fields = read_vtu(folder / "fields.vtu", ["velocity_relative", "stress", "region"])
    if fields.data["velocity_relative"].ndim != 2:
        raise InputError(f"{folder / 'fields.vtu'}: the field \"velocity_relative\" is not a vector.")
    shell = find(result, "case", "cell", "bulk", "law") == "none"
    tension = read_column(folder / "contour.csv", "tension_meridional_mN_per_m") if shell else None
    return story_of(result, contour, fields, tension)


def story_of(result, contour, fields, tension):
    """A result with its contour (n, 2), the fields of its mesh and, of a shell, the tension along the contour."""
    radius = float(fields.points[:, 1].max())
    length = min(VIEW * radius, *np.abs([fields.points[:, 0].min(), fields.points[:, 0].max()]))
    grid = PixelGrid(np.linspace(-length, length, COLUMNS), np.linspace(0, radius, COLUMNS // 4))
    return Story(result, contour, radius, grid, *pixels(fields, grid), tension)


def pixels(fields, grid):
    """Relative velocity of the liquid (axial, radial, magnitude) in m/s and stress of the cell in kPa."""
    x, r = fields.points[fields.elements, 0], fields.points[fields.elements, 1]
    cell = fields.at_nodes("region")[:, 0, 0] > 0.5
    shown = (x.max(axis=(1, 2)) >= grid.x[0]) & (x.min(axis=(1, 2)) <= grid.x[-1])
    liquid, cell = shown & ~cell, shown & cell
    velocity = [fields.at_nodes("velocity_relative", k)[liquid] for k in (0, 1)]
    axial, radial = rasterise(x[liquid], r[liquid], velocity, grid)
    (stress,) = rasterise(x[cell], r[cell], [fields.at_nodes("stress")[cell] / 1000], grid)
    return np.stack([axial, radial, np.hypot(axial, radial)]), stress


def draw(story):
    """The figure."""
    height = 2 * (1 + WALL) * story.radius
    length = story.grid.x[-1] - story.grid.x[0]
    channel_in = (COLUMN_IN - 2 * SIDE_IN) * height / length
    note = failure_note(story.result)
    note_in = 0.1 * len(note) + 0.1 * bool(note)
    legend_in = 1.0
    total = channel_in + legend_in + note_in + SIDE_IN
    figure = page.new_figure(COLUMN_IN, total, STYLE)
    axes = figure.add_axes([SIDE_IN / COLUMN_IN, legend_in / total, 1 - 2 * SIDE_IN / COLUMN_IN, channel_in / total])
    axes.set(xlim=story.grid.x[[0, -1]], ylim=(-height / 2, height / 2), aspect="equal")
    axes.axis("off")
    speed, stress = draw_fields(axes, story)
    draw_streamlines(axes, story)
    draw_walls(axes, story)
    tension = draw_outlines(axes, story)
    draw_scale_and_flow(axes, story)
    draw_colour_bar(figure, speed, [0.05, 0.68 / total, 0.41, 0.07 / total], "speed relative to the cell (m/s)")
    place = [0.54, 0.68 / total, 0.41, 0.07 / total]
    if tension is None:
        draw_colour_bar(figure, stress, place, "elastic stress in the cell (kPa)")
    else:
        draw_colour_bar(figure, tension, place, "tension along the cortex (mN/m)")
    draw_numbers(figure, story.result, total)
    if note:
        band = (0, 1 - note_in / total)
        figure.add_artist(Rectangle(band, 1, note_in / total, facecolor=colours.ALARM, linewidth=0))
        figure.text(0.5, 1 - 0.05 / total, "\n".join(note), color="white", ha="center", va="top", weight="bold",
                    linespacing=1.15)
    return figure


def draw_fields(axes, story):
    """Liquid and cell as pixels that the exact contour clips; returns their scales."""
    dx, dr = story.grid.x[1] - story.grid.x[0], story.grid.r[1] - story.grid.r[0]
    extent = (story.grid.x[0] - dx / 2, story.grid.x[-1] + dx / 2, -story.radius - dr / 2, story.radius + dr / 2)
    scales = []
    for field, colormap, layer in ((story.relative[2], colours.LIQUID, 1), (story.stress_kPa, colours.CELL, 2)):
        seen = field[np.isfinite(field)]
        greatest = np.percentile(seen, 99.8) if seen.size else 1
        scale = ScalarMappable(Normalize(0, greatest or 1), colormap)
        scale.set_array(seen)
        pixels = axes.add_artist(Raster(mirrored(scale.to_rgba(extended(field, 4), bytes=True)), extent, layer))
        scales.append(scale)
    pixels.set_clip_path(PathPatch(Outline(closed(story.contour)), transform=axes.transData))
    return scales


def draw_streamlines(axes, story):
    """Level lines of the stream function in the frame of the cell, evenly spaced far upstream, with arrow heads."""
    grid = story.grid
    axial = extended(story.relative[0], 2)
    psi = stream_function(np.where(np.isfinite(axial), axial, 0), grid.r)
    psi[~np.isfinite(extended(story.relative[2], 1))] = np.nan
    levels = streamline_levels(psi[:, 0], grid.r)
    r = np.concatenate([-grid.r[:0:-1], grid.r])
    lines = axes.contour(grid.x, r, mirrored(psi), levels=levels, colors=colours.INK, linewidths=0.45, alpha=0.55,
                         linestyles="solid", zorder=1.5)
    heads = [head for level in lines.allsegs for line in level if len(line) > 40 for head in arrow_heads(line, story)]
    axes.add_collection(PolyCollection(heads, facecolor=colours.INK, linewidth=0, zorder=1.6))


def streamline_levels(psi, r):
    """Values of psi at evenly spaced radii of one column: where the liquid overtakes the cell, and next to the wall.

    Lines that overtake the cell turn back before it; psi < 0 near the wall marks the liquid that passes the cell.
    """
    peak = int(np.argmax(psi))
    passing = r[psi < 0]
    starts = (np.arange(6) + 0.5) / 6 * r[peak]
    if passing.size:
        starts = np.append(starts, passing[0] + np.array([0.3, 0.8]) * (r[-1] - passing[0]))
    return np.unique(np.interp(starts, r, psi))


def arrow_heads(line, story):
    """Triangles (3, 2), one where a line crosses the middle of the left and of the right half of the view."""
    size = HEAD_IN / (COLUMN_IN - 2 * SIDE_IN) * (story.grid.x[-1] - story.grid.x[0])
    for station in (-0.72, 0.72):
        place = station * story.grid.x[-1]
        for k in np.flatnonzero(np.diff(np.sign(line[:, 0] - place)) != 0):
            if abs(line[k, 1]) > 0.97 * story.radius:
                continue
            column, row = story.grid.coordinates(line[k, 0], abs(line[k, 1]))
            axial = story.relative[0][int(np.clip(round(row), 0, story.grid.shape[0] - 1)), int(round(column))]
            step = line[k + 1] - line[k]
            step = step if step[0] * axial > 0 else -step
            along = size * step / np.linalg.norm(step)
            across = 0.4 * along[::-1] * (-1, 1)
            yield np.array([line[k] + along / 2, line[k] - along / 2 + across, line[k] - along / 2 - across])


def draw_walls(axes, story):
    """Hatched bands above and below, and the axis of symmetry."""
    left, right = story.grid.x[[0, -1]]
    thickness = WALL * story.radius
    for lower in (story.radius, -story.radius - thickness):
        axes.add_patch(Rectangle((left, lower), right - left, thickness, facecolor="#e4e6e8", edgecolor="#9aa3ab",
                                 hatch="//////", linewidth=0, zorder=3))
    x, radii = wall_line(story)
    for side in (1, -1):
        axes.fill_between(x, side * radii, side * story.radius, facecolor="#e4e6e8", edgecolor="#9aa3ab", hatch="//////",
                          linewidth=0, zorder=3)
        axes.plot(x, side * radii, color=colours.INK, linewidth=0.9, zorder=3.1, solid_capstyle="butt")


def wall_line(story):
    """Places and radii of the wall: where the liquid's pixels end, smoothed over a few of them; or of a straight one."""
    x, r = story.grid.x, story.grid.r
    liquid = np.isfinite(story.relative[2])
    radii = r[len(r) - 1 - np.argmax(liquid[::-1], axis=0)]
    if not liquid.any(axis=0).all() or radii.min() > 0.98 * story.radius:
        return x[[0, -1]], np.full(2, story.radius)
    width = 15
    padded = np.pad(radii, width // 2, mode="edge")
    return x, np.convolve(padded, np.full(width, 1 / width), mode="valid")


def draw_outlines(axes, story):
    """Contour (a shell's in the colours of its tension, which are returned), chords of its hull, sphere at rest."""
    outline = closed(story.contour)
    axes.plot(*outline.T, color=colours.INK, linewidth=1.3 if story.tension is None else 2.6, zorder=5,
              solid_joinstyle="round")
    band = None if story.tension is None else draw_tension(axes, story)
    for chord in bridges(outline, convex_hull(outline), least_depth=2e-3 * story.radius):
        axes.plot(*chord.T, color=colours.INK, linewidth=0.9, dashes=(3, 1.6), zorder=5.1)
    rest = find(story.result, "case", "cell", "radius_um")
    if rest is not None:
        angle = np.linspace(0, 2 * np.pi, 361)
        axes.plot(rest * np.cos(angle), rest * np.sin(angle), color=colours.INK, linewidth=FINE, zorder=4,
                  linestyle=(0, (0.6, 2.2)), dash_capstyle="round")
    return band


def draw_tension(axes, story):
    """The tension along both halves of the meridian, inside a dark rim."""
    halves = [story.contour * (1, sign) for sign in (1, -1)]
    segments = np.concatenate([np.stack([half[:-1], half[1:]], axis=1) for half in halves])
    values = np.tile((story.tension[:-1] + story.tension[1:]) / 2, 2)
    lines = LineCollection(segments, array=values, cmap=colours.CELL, linewidths=1.8, zorder=5.2, capstyle="round")
    lines.autoscale()
    return axes.add_collection(lines)


def draw_scale_and_flow(axes, story):
    """Scale bar in the lower wall, flow direction in the upper one."""
    left, right = story.grid.x[[0, -1]]
    thickness = WALL * story.radius
    length = next(bar for bar in (100, 50, 20, 10, 5, 2, 1, 0.5, 0.1) if bar <= 0.25 * (right - left) or bar == 0.1)
    plate = {"facecolor": "white", "linewidth": 0, "zorder": 3.5}
    pad = 0.25 * thickness
    level = story.radius + thickness / 2
    text_width = 0.115 * (right - left)
    axes.add_patch(Rectangle((right - length - text_width - 2 * pad, -level - thickness / 2),
                             length + text_width + 2 * pad, thickness, **plate))
    axes.plot([right - length - pad, right - pad], [-level, -level], color=colours.INK, linewidth=1.8, zorder=4,
              solid_capstyle="butt")
    axes.text(right - length - 1.8 * pad, -level, f"{length:g} µm", ha="right", va="center_baseline", zorder=4)
    arrow = 0.13 * (right - left)
    axes.add_patch(Rectangle((left, level - thickness / 2), arrow + text_width * 0.85, thickness, **plate))
    axes.text(left + pad, level, "flow", ha="left", va="center_baseline", zorder=4)
    axes.annotate("", xy=(left + arrow + 0.7 * text_width, level), xytext=(left + 0.75 * text_width, level), zorder=4,
                  arrowprops={"arrowstyle": "-|>,head_length=0.35,head_width=0.16", "color": colours.INK,
                              "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 10})


def draw_colour_bar(figure, image, place, label):
    """A thin horizontal bar with its label above."""
    axes = figure.add_axes(place)
    beyond = np.max(np.asarray(image.get_array()), initial=0) > 1.001 * image.get_clim()[1]
    bar = figure.colorbar(image, cax=axes, orientation="horizontal", extend="max" if beyond else "neither")
    bar.outline.set_linewidth(0.4)
    bar.locator = MaxNLocator(4)
    bar.formatter = FuncFormatter(lambda value, _: f"{value:g}")
    bar.update_ticks()
    axes.tick_params(pad=1.5)
    axes.set_title(label, fontsize=6.5, pad=3)


def draw_numbers(figure, result, total):
    """What came out, and what was asked."""
    found = [deformation_with_error(result), part("area {:.5g} µm²", result, "area_um2")]
    asked = made_of(result)
    moved = [part("r₀ = {:.4g} µm", result, "case", "cell", "radius_um"), *elongated_by(result),
             part("cell velocity {:.4g} m/s", result, "cell_velocity_m_per_s"),
             part("pressure drop {:.4g} Pa", result, "pressure_drop_Pa")]
    for height, parts, weight in ((0.34, found, "bold"), (0.205, asked, "normal"), (0.075, moved, "normal")):
        parts = list(filter(None, parts))
        gap, size = (" " * 6, 6.5) if len(parts) < 5 else (" " * 3, 5.4)
        line = figure.text(0.5, height / total, gap.join(parts), ha="center", va="baseline", weight=weight, fontsize=size)
        width = line.get_window_extent().width / figure.bbox.width
        line.set_fontsize(size * min(1, 0.96 / width))
