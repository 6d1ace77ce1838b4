"""What all pictures share: the widths of a journal's page, fonts, lines and inks."""

import matplotlib
from matplotlib.figure import Figure

from rheocyte import colours

COLUMN_IN, WIDTH_IN = 3.504, 7.087  # 89 mm, one column; 180 mm, both
STYLE = {"font.size": 7, "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "axes.linewidth": 0.6,
         "axes.spines.top": False, "axes.spines.right": False, "text.color": colours.INK, "axes.edgecolor": colours.INK,
         "axes.labelcolor": colours.INK, "xtick.color": colours.INK, "ytick.color": colours.INK,
         "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
         "hatch.linewidth": 0.35, "svg.hashsalt": "rheocyte", "mathtext.default": "regular"}


def new_figure(width, height, style=STYLE, **options):
    """An empty figure; sizes in inches. The style holds for what is drawn and written until the next call."""
    matplotlib.rcParams.update(style)
    return Figure(figsize=(width, height), **options)


def thousands(value):
    """A whole number with thin spaces."""
    return f"{value:,.0f}".replace(",", "\u2009")
