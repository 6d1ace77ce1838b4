"""Paths that users give."""

import os

from rheocyte.errors import UserError


def path(value, name):
    """Its text; UserError for what is no path."""
    text = os.fspath(value) if isinstance(value, (str, os.PathLike)) else None
    if not isinstance(text, str) or "\0" in text:
        raise UserError(f"{name} is {value!r}, which is no path of a file or folder.")
    return text
