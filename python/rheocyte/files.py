"""Reading a result folder and writing figures without ever leaving half a file."""

import csv
import io
import json
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image  # matplotlib needs it, too
from PIL.PngImagePlugin import PngInfo

from rheocyte.errors import InputError, reason

MARKS = (b"Software\0rheocyte", b"<dc:title>rheocyte</dc:title>", b"!\xfe\x08rheocyte")  # of PNG, SVG and GIF
HEAD = 2000  # bytes, behind which a PNG has its pixels, an SVG its drawing, a GIF its frames
COMPRESSION = 3  # of PNG files, of 9: twice as fast as the usual 6 for a fifth more bytes


def read_result(path):
    """The dictionary of a result.json."""
    try:
        result = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    except json.JSONDecodeError as error:
        raise InputError(f"{path} is not valid JSON: {error}.") from error
    if not isinstance(result, dict) or "status" not in result:
        raise InputError(f"{path} is not a result of rheocyte: it has no key \"status\".")
    return result


def read_table(path, columns, delimiter=","):
    """Rows of a text table as dictionaries of strings; `columns` are the names that must be in its header."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file, delimiter=delimiter)
            rows, names = list(reader), reader.fieldnames or []
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    missing = [name for name in columns if name not in names]
    if missing:
        raise InputError(f"{path} has no column \"{missing[0]}\"; it needs {', '.join(columns)}.")
    return rows


def number(row, column, path):
    """The finite number in a column of a row of read_table."""
    try:
        value = float(row[column])
    except (TypeError, ValueError):
        value = np.nan
    if not np.isfinite(value):
        raise InputError(f"{path} holds \"{row[column]}\" in column {column} where a number is expected.")
    return value


def read_contour(path):
    """The meridian as an array (n, 2) of x and r >= 0 in um, from the front pole to the rear pole."""
    rows = read_table(path, ["x_um", "r_um"])
    if len(rows) < 3:
        raise InputError(f"{path} holds {len(rows)} points; a contour needs at least 3.")
    return np.array([[number(row, "x_um", path), number(row, "r_um", path)] for row in rows])


def read_column(path, column):
    """One column of a CSV file as an array of finite numbers."""
    return np.array([number(row, column, path) for row in read_table(path, [column])])


def check_picture(path):
    """A picture that this program has not drawn is not replaced."""
    try:
        with open(path, "rb") as file:
            head = file.read(HEAD)
    except FileNotFoundError:
        return
    except OSError as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    if not any(mark in head for mark in MARKS):
        raise InputError(f"{path} already exists and was not drawn by rheocyte; move it away, or give another place.")


def check_figure(stem):
    """Both files of a figure, before one of them is written."""
    for ending in (".png", ".svg"):
        check_picture(stem.with_name(stem.name + ending))


def save_figure(figure, stem, dpi=400, palette=False, svg_dpi=300):
    """Writes `stem`.png and `stem`.svg.

    A palette of 256 colours makes the PNG of a drawing some three times smaller; `svg_dpi` is that of images inside
    the SVG. While the PNG is packed, which another thread does, the SVG is drawn.
    """
    stem = Path(stem)
    check_figure(stem)
    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(dpi)
    canvas.draw()
    image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    with ThreadPoolExecutor(1) as other:
        png = other.submit(packed, image, dpi, palette)
        svg = io.BytesIO()
        figure.savefig(svg, format="svg", dpi=svg_dpi, metadata={"Date": None, "Creator": "rheocyte"})
        write_file(stem.with_name(stem.name + ".png"), png.result())
    write_file(stem.with_name(stem.name + ".svg"), svg.getvalue())


def packed(image, dpi, palette):
    """A PNG file of an image; with a palette without dithering."""
    if palette:
        image = image.quantize(256, Image.Quantize.MEDIANCUT, dither=0)
    file, origin = io.BytesIO(), PngInfo()
    origin.add_text("Software", "rheocyte")
    image.save(file, format="PNG", optimize=palette, compress_level=COMPRESSION, dpi=(dpi, dpi), pnginfo=origin)
    return file.getvalue()


def write_text(path, text):
    """Writes a text file; one that holds this text already is left alone."""
    try:
        if Path(path).is_file() and Path(path).read_text(encoding="utf-8", errors="replace") == text:
            return
    except OSError as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    write_file(path, text.encode())


def write_file(path, content):
    """Writes a file: first beside the target, then renamed, so that no reader sees half of it."""
    path, temporary = Path(path), None
    try:
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
        with open(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o666 & ~current_umask())
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {reason(error)}.") from error
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)


def save_table(path, rows):
    """A CSV file from dictionaries with the same keys, in the place of none or of one with these columns."""
    check_table(path, list(rows[0]))
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())


def check_table(path, columns):
    """A file with other columns is that of others."""
    if Path(path).exists():
        with open(path, newline="", encoding="utf-8", errors="replace") as file:
            if next(csv.reader(file), None) != columns:
                raise InputError(f"{path} already exists and was not written by rheocyte; move it away, or give another place.")


def current_umask():
    """The process's file mode mask, which mkstemp does not apply."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def run(program):
    """Runs a command's function; the user's errors become one sentence on stderr and exit code 2."""
    try:
        program()
    except InputError as error:
        print(f"rheocyte: {error}", file=sys.stderr)
        sys.exit(2)
