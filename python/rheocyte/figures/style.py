"""What the paper's figures share: width, fonts, colours of the models, notes in place of what could not be solved."""

import textwrap

from rheocyte import colours, page

WIDTH_IN = page.WIDTH_IN
ANALYTICAL, LINEAR, NEO_HOOKEAN = "#2f6fa8", "#c22f1d", colours.INK
SECOND = "#3d7a4a"
STYLE = page.STYLE | {"axes.titlesize": 7.5, "axes.titleweight": "bold", "axes.titlelocation": "left"}


def new_figure(height, **options):
    """An empty figure over the full width."""
    return page.new_figure(WIDTH_IN, height, STYLE, **options)


def note(axes, text, x=0.5, y=0.5, width=44):
    """A sentence in the colour of alarm, in the axes' own coordinates, where something is missing."""
    axes.text(x, y, "\n".join(textwrap.wrap(text, width)[:6]), transform=axes.transAxes, ha="center", va="center",
              color=colours.ALARM, fontsize=6, zorder=9,
              bbox={"facecolor": "white", "edgecolor": colours.ALARM, "linewidth": 0.5, "pad": 2})


def percent(change):
    """A relative change with its sign, to three significant digits at most."""
    return f"{100 * change:+.{2 if abs(change) < 0.01 else 1}f} %".replace("-", "\u2212")
