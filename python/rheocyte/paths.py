"""Paths and words that users give."""

import os

from rheocyte.errors import UserError


def word(value, name):
    """A text; UserError for what is none."""
    if not isinstance(value, str) or not value.isprintable():
        raise UserError(f"{name} is {value!r}; give a text.")
    return value


def path(value, name):
    """Its text; UserError for what is not a path."""
    text = os.fspath(value) if isinstance(value, (str, os.PathLike)) else None
    if not isinstance(text, str) or "\0" in text:
        raise UserError(f"{name} is {value!r}, which is not a path of a file or folder.")
    return text
