"""The cell in its duct: in space, along the flow, and the silhouettes, from the files of one result."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from rheocyte import body, colours, page
from rheocyte.duct_surface import front_view, images_of, refined, silhouettes, surface_faces, whole
from rheocyte.files import read_result
from rheocyte.page import WIDTH_IN
from rheocyte.result_text import deformation_with_error, failure_note, made_of, part
from rheocyte.vtu import read_vtu

SIDE_IN, GAP_IN, HEAD_IN, FOOT_IN = 0.06, 0.16, 0.2, 0.64
ANGLES_DEG = (-34, 17)  # azimuth and elevation of the eye
LENGTH = 1.5  # half the length of the channel shown, in lesser half widths
WALL = 0.14  # thickness of the drawn wall, in the same unit
PIXELS, SPACE_STEPS = 560, 20  # of the cell in space, and points along each edge of a face
WALL_FACE, LIQUID, CELL = "#d3d8dc", "#eef4f8", "#fdf0cf"
COLOURS = [colours.INK, "#c22f1d", "#2f6fa8"]  # of the silhouettes
STYLE = page.STYLE | {"font.size": 6.5}


@dataclass
class DuctStory:
    """All that the picture shows; lengths in um."""

    result: dict
    halves: tuple  # half the width and half the height
    faces: np.ndarray  # (m, p + 1, p + 1, 3), of the surface in the part that was computed
    silhouettes: dict  # "side", "diagonal", the camera's angle: (n, 2), x and place across the flow

    @property
    def images(self):
        return images_of(self.result["case"])

    @property
    def offset(self):
        """Place of the cell, (along the width, along the height): in time not that where it started."""
        width, height = self.result["case"]["cell"].get("offset_um") or (0, 0)
        place = self.result["offset_um"] if width or height else 0
        return (0, place) if height else (place, 0)


def read_story(folder):
    """Of a folder of `rheocyte solve`."""
    return story_of(read_result(Path(folder) / "result.json"), read_vtu(Path(folder) / "fields.vtu", ["region"]))


def story_of(result, fields):
    """Of a result and the fields of its mesh."""
    faces = surface_faces(fields)
    middle = (faces[..., 0].min() + faces[..., 0].max()) / 2
    faces = faces - [middle, 0, 0]
    channel = result["case"]["channel"]
    width = channel["width_um"] if "width_um" in channel else min(channel["profile"]["width_um"])  # behind a funnel
    halves = (width / 2, channel.get("height_um", width) / 2)
    return DuctStory(result, halves, faces, silhouettes(faces, images_of(result["case"]), channel.get("camera_degree")))


def draw(story):
    """The figure: channel in space to the left, along the flow and the silhouettes to the right."""
    note = failure_note(story.result)
    height = 2.54 + 0.1 * len(note) + 0.1 * bool(note)
    figure = page.new_figure(WIDTH_IN, height, STYLE)
    panel = 2.54 - HEAD_IN - FOOT_IN

    def place(left, width):
        return figure.add_axes([left / WIDTH_IN, FOOT_IN / height, width / WIDTH_IN, panel / height])

    left = SIDE_IN
    titles = []
    for title, width, paint in (("in its channel", 2.6, draw_in_space), ("along the flow", panel, draw_along_the_flow),
                                ("silhouettes", None, draw_silhouettes)):
        width = WIDTH_IN - SIDE_IN - left if width is None else width
        paint(place(left, width), story)
        titles.append((left + width / 2, title))
        left += width + GAP_IN
    for x, title in titles:
        figure.text(x / WIDTH_IN, (FOOT_IN + panel + 0.06) / height, title, ha="center", va="bottom", weight="bold")
    tell_numbers(figure, story.result, height)
    if note:
        band = (2.54) / height
        figure.add_artist(Rectangle((0, band), 1, 1 - band, facecolor=colours.ALARM, linewidth=0))
        figure.text(0.5, 1 - 0.05 / height, "\n".join(note), color="white", ha="center", va="top", weight="bold",
                    linespacing=1.15)
    return figure


def draw_in_space(axes, story):
    """The shaded cell between the edges of the channel; the walls behind it are filled."""
    (a, b), turn = story.halves, body.rotation(*np.radians(ANGLES_DEG))
    h = min(a, b)

    def seen(points):
        return (np.asarray(points, dtype=float) @ turn.T)[:, :2]

    length = LENGTH * h
    for wall in ([(-length, -a, -b), (length, -a, -b), (length, -a, b), (-length, -a, b)],
                 [(-length, -a, -b), (length, -a, -b), (length, a, -b), (-length, a, -b)]):
        axes.add_patch(Polygon(seen(wall), facecolor=LIQUID, edgecolor="none", zorder=0))
    for y in (-a, a):
        for z in (-b, b):
            near = z > 0 and y > 0
            axes.plot(*seen([(-length, y, z), (length, y, z)]).T, color=colours.INK, linewidth=0.7 if near else 0.4,
                      alpha=0.9 if near else 0.45, zorder=3 if z > 0 else 1)
    for x in (-length, length):
        section = [(x, -a, -b), (x, a, -b), (x, a, b), (x, -a, b), (x, -a, -b)]
        axes.plot(*seen(section).T, color=colours.INK, linewidth=0.5, alpha=0.6, zorder=1)
    edge = 1.15 * np.abs(story.faces).max()
    points, normals = (whole(part, story.images) for part in refined(story.faces, SPACE_STEPS, sum(story.offset)))
    image = body.image_of(points, normals, ANGLES_DEG, edge, PIXELS, colours.CELL)
    axes.imshow(image, origin="lower", extent=(-edge, edge, -edge, edge), interpolation="antialiased", zorder=2)
    corners = seen([(x, y, z) for x in (-length, length) for y in (-a, a) for z in (-b, b)])
    (left, low), (right, high) = corners.min(axis=0), corners.max(axis=0)
    axes.set(xlim=(left - 0.03 * h, right + 0.03 * h), ylim=(low - 0.16 * h, high + 0.03 * h), aspect="equal")
    start, end = seen([(0.25 * length, -a, b), (0.62 * length, -a, b)]) - (0, 0.13 * h)
    axes.annotate("", xy=end, xytext=start, zorder=4, arrowprops={"arrowstyle": "-|>,head_length=0.35,head_width=0.16",
                  "color": colours.INK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 10})
    axes.text(*(start - (0.06 * h, 0)), "flow", ha="right", va="center")
    axes.axis("off")


def draw_along_the_flow(axes, story):
    """The outline in the duct, and the directions of the cameras."""
    (a, b), wide = story.halves, max(story.halves)
    draw_section(axes, a, b)
    axes.fill(*front_view(story.faces, story.images).T, facecolor=CELL, edgecolor=colours.INK, linewidth=1.1, zorder=3)
    rest = story.result["case"]["cell"]["radius_um"]
    angle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(story.offset[0] + rest * np.cos(angle), story.offset[1] + rest * np.sin(angle), color=colours.INK, linewidth=0.6,
              linestyle=(0, (0.6, 2.2)), dash_capstyle="round", zorder=4)
    for colour, name in zip(COLOURS, story.silhouettes):
        turn = np.radians({"side": 0, "diagonal": 45}[name] if name in ("side", "diagonal") else float(name[:-1]))
        place = -np.array([np.sin(turn), np.cos(turn)])
        reach = 1 / max(abs(place[0]) / a, abs(place[1]) / b)
        far, near = place * 0.985 * reach, place * (0.62 * reach)
        axes.annotate("", xy=near, xytext=far, zorder=5, arrowprops={
            "arrowstyle": "-|>,head_length=0.3,head_width=0.14", "color": colour, "linewidth": 0.9, "shrinkA": 0,
            "shrinkB": 0, "mutation_scale": 9})
    axes.set(xlim=(-(1 + WALL) * wide, (1 + WALL) * wide), ylim=(-(1 + WALL) * wide, (1 + WALL) * wide), aspect="equal")
    axes.axis("off")


def draw_section(axes, a, b):
    """Liquid between four walls."""
    wall = WALL * min(a, b)
    axes.add_patch(Rectangle((-a - wall, -b - wall), 2 * (a + wall), 2 * (b + wall), facecolor=WALL_FACE, linewidth=0,
                             zorder=0))
    axes.add_patch(Rectangle((-a, -b), 2 * a, 2 * b, facecolor=LIQUID, edgecolor=colours.INK, linewidth=0.9, zorder=1))


def draw_silhouettes(axes, story):
    """Over each other between the walls of the side's view, and the sphere at rest."""
    h, side = story.halves["side" not in story.silhouettes], next(iter(story.silhouettes.values()))
    half = max(1.12 * np.abs(side[:, 0]).max(), 1.35 * h)
    axes.add_patch(Rectangle((-half, -h), 2 * half, 2 * h, facecolor=LIQUID, linewidth=0, zorder=0))
    for sign in (1, -1):
        axes.add_patch(Rectangle((-half, min(sign * h, sign * (1 + WALL) * h)), 2 * half, WALL * h, facecolor=WALL_FACE,
                                 linewidth=0, zorder=0))
        axes.plot([-half, half], [sign * h, sign * h], color=colours.INK, linewidth=0.9, zorder=1)
    axes.fill(*side.T, facecolor=CELL, zorder=2, linewidth=0)
    count = len(story.silhouettes)
    for place, ((name, outline), colour) in enumerate(zip(story.silhouettes.items(), COLOURS)):
        x = (2 * place + 1) / count - 1
        axes.plot(*outline.T, color=colour, linewidth=1.1, zorder=4, solid_joinstyle="round")
        number = story.result.get(f"deformation_{name}")
        if number is None and (name[-1] == "°" or count == 1):
            number = story.result.get("deformation")
        if number is not None:
            axes.text(x * half, (1 + WALL / 2) * h, f"{name} $d$ = {number:.4f}", color=colour, ha="center",
                      va="center_baseline", zorder=5)
    rest = story.result["case"]["cell"]["radius_um"]
    angle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(rest * np.cos(angle), rest * np.sin(angle), color=colours.INK, linewidth=0.6, linestyle=(0, (0.6, 2.2)),
              dash_capstyle="round", zorder=3)
    bar = next(length for length in (50, 20, 10, 5, 2, 1) if length <= 0.6 * half)
    axes.plot([half - 0.06 * h - bar, half - 0.06 * h], [-(1 + WALL / 2) * h] * 2, color=colours.INK, linewidth=1.8,
              solid_capstyle="butt", zorder=4)
    axes.text(half - 0.14 * h - bar, -(1 + WALL / 2) * h, f"{bar} µm", ha="right", va="center_baseline", zorder=4)
    axes.set(xlim=(-half, half), ylim=(-(1 + WALL) * h, (1 + WALL) * h), aspect="equal")
    axes.axis("off")


def tell_numbers(figure, result, total):
    """What came out, and what was asked."""
    channel = result["case"]["channel"]
    camera = f"{channel['camera_degree']:g}°" if "camera_degree" in channel else channel.get("camera", "side")
    found = [deformation_with_error(result), part("area {:.5g} µm²", result, "area_um2"), f"seen from: {camera}"]
    bodies = [part("volume {:.5g} µm³", result, "volume_um3"),
              part("by revolution of the image {:.5g} µm³", result, "volume_of_revolution_um3"),
              part("cell velocity {:.4g} m/s", result, "cell_velocity_m_per_s")]
    asked = made_of(result) + [part("r₀ = {:.4g} µm", result, "case", "cell", "radius_um"),
                               part("channel {:.4g} µm wide", result, "case", "channel", "width_um"),
                               part("{:.4g} µm high", result, "case", "channel", "height_um")]
    for height, parts, weight in ((0.41, found, "bold"), (0.25, asked, "normal"), (0.09, bodies, "normal")):
        figure.text(0.5, height / total, (" " * 6).join(filter(None, parts)), ha="center", va="baseline", weight=weight)
