"""Reading a result folder and writing figures without ever leaving half a file."""

import csv
import io
import json
import os
import sys
import tempfile
from pathlib import Path

import numpy as np


class InputError(Exception):
    """The user's file is missing or damaged; the text is one sentence that names it."""


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


def read_table(path, columns):
    """Rows of a CSV file as dictionaries of strings; `columns` are the names that must be in its header."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            rows, names = list(reader), reader.fieldnames or []
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    missing = [name for name in columns if name not in names]
    if missing:
        raise InputError(f"{path} has no column \"{missing[0]}\"; wanted are {', '.join(columns)}.")
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


def reason(error):
    """What the operating system or a parser said, without the path that stands before it already."""
    return getattr(error, "strerror", None) or str(error)


def save_figure(figure, stem, dpi, palette=False, svg_dpi=300):
    """Writes `stem`.png and `stem`.svg: first beside the target, then renamed, so that no reader sees half a file.

    A palette of 256 colours makes the PNG of a drawing some three times smaller; `svg_dpi` is that of images inside
    the SVG.
    """
    stem = Path(stem)
    for suffix, options in ((".png", {"dpi": dpi}), (".svg", {"dpi": svg_dpi, "metadata": {"Date": None}})):
        temporary = None
        try:
            handle, temporary = tempfile.mkstemp(prefix=f".{stem.name}-", suffix=suffix, dir=stem.parent)
            os.close(handle)
            figure.savefig(temporary, format=suffix[1:], **options)
            if palette and suffix == ".png":
                reduce_colours(temporary)
            os.chmod(temporary, 0o666 & ~current_umask())
            os.replace(temporary, stem.with_name(stem.name + suffix))
        except OSError as error:
            raise InputError(f"{stem}{suffix} cannot be written: {reason(error)}.") from error
        finally:
            if temporary and os.path.exists(temporary):
                os.unlink(temporary)


def reduce_colours(path):
    """Replaces a PNG file by one with a palette, without dithering."""
    from PIL import Image  # matplotlib needs it, too

    with Image.open(path) as image:
        dpi, reduced = image.info.get("dpi"), image.convert("RGB").quantize(256, Image.Quantize.MEDIANCUT, dither=0)
    reduced.save(path, format="PNG", optimize=True, dpi=dpi)


def write_text(path, text):
    """Writes a text file, first beside the target, then renamed; a file that holds this text already is left alone."""
    path, temporary = Path(path), None
    try:
        if path.is_file() and path.read_text(encoding="utf-8", errors="replace") == text:
            return
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
        with open(handle, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(temporary, 0o666 & ~current_umask())
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {reason(error)}.") from error
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)


def save_table(path, rows):
    """A CSV file from dictionaries with the same keys."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())


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
