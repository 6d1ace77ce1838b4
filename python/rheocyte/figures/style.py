"""What the paper's figures share: width, fonts, colours of the models, notes in place of what could not be solved."""

import textwrap

from rheocyte import colours

WIDTH_IN = 7.087  # 180 mm, a journal's full width
ANALYTICAL, LINEAR, NEO_HOOKEAN = "#2f6fa8", "#c22f1d", colours.INK
SECOND = "#3d7a4a"
STYLE = {"font.size": 7, "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "axes.linewidth": 0.6,
         "axes.titlesize": 7.5, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.spines.top": False,
         "axes.spines.right": False, "text.color": colours.INK, "axes.edgecolor": colours.INK,
         "axes.labelcolor": colours.INK, "xtick.color": colours.INK, "ytick.color": colours.INK,
         "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
         "hatch.linewidth": 0.35, "svg.hashsalt": "rheocyte", "mathtext.default": "regular"}


def note(axes, text, x=0.5, y=0.5, width=44):
    """A sentence in the colour of alarm, in the axes' own coordinates, where something is missing."""
    axes.text(x, y, "\n".join(textwrap.wrap(text, width)[:6]), transform=axes.transAxes, ha="center", va="center",
              color=colours.ALARM, fontsize=6, zorder=9,
              bbox={"facecolor": "white", "edgecolor": colours.ALARM, "linewidth": 0.5, "pad": 2})


def percent(change):
    """A relative change with its sign, to three significant digits at most."""
    return f"{100 * change:+.{2 if abs(change) < 0.01 else 1}f} %".replace("-", "\u2212")


def thousands(value):
    """A whole number with thin spaces."""
    return f"{value:,.0f}".replace(",", "\u2009")
