"""python -m rheocyte.picture DIR: the picture that fits the result in DIR.

Writes DIR/picture.png and DIR/picture.svg, and of a result in time also what time_picture.py draws. Exit code 2 and one
sentence on stderr if a file is missing or damaged.
"""

import sys
from pathlib import Path

from rheocyte import tube_picture
from rheocyte.files import InputError, read_result, run, save_figure
from rheocyte.result_text import find


def is_in_duct(result):
    """Whether the channel of a result (a dictionary) is the square or rectangular one in three dimensions."""
    return find(result, "case", "channel", "section") in ("square", "rectangle")


def draw_folder(folder):
    """Draws the result in a folder; what few results need is loaded for them only."""
    if is_in_duct(read_result(folder / "result.json")):
        from rheocyte import duct_picture

        save_figure(duct_picture.draw(duct_picture.read_story(folder)), folder / "picture")
        return
    save_figure(tube_picture.draw(tube_picture.read_story(folder)), folder / "picture", svg_dpi=tube_picture.SVG_DPI)
    if (folder / "history.csv").exists():
        from rheocyte import time_picture

        time_picture.draw_folder(folder)


def main():
    """Command line."""
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        raise InputError("give the folder of one result: python -m rheocyte.picture DIR.")
    draw_folder(Path(sys.argv[1]))


if __name__ == "__main__":
    run(main)
