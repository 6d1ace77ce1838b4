"""Numbers of users as arrays for the compiled module."""

import numpy as np

from rheocyte.errors import UserError


def numbers(values, name):
    """An array of 64-bit numbers; the values themselves, not a copy, if they are such an array already. Those that a
    numpy mask hides are NaN."""
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "fiub":
            raise TypeError(f"its type is {array.dtype}")
        found = np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)
    except (TypeError, ValueError, RuntimeError) as error:  # the last one from arrays of other libraries
        raise UserError(f"{name} is not an array of numbers: {error}.") from error
    return np.where(np.ma.getmaskarray(values), np.nan, found) if np.ma.isMaskedArray(values) else found


def equally_long(**arrays):
    """One-dimensional arrays of one length; UserError naming those that differ."""
    lengths = {name: array.shape for name, array in arrays.items()}
    for name, shape in lengths.items():
        if len(shape) != 1:
            raise UserError(f"{name} has the shape {shape}; it must have one number per event.")
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} {shape[0]}" for name, shape in lengths.items())
        raise UserError(f"the arrays are not equally long: {told}.")


def number(value, name):
    """One finite number; a text or True, which numpy would take for one, is none."""
    array = np.empty(0) if isinstance(value, (str, bool, np.bool_)) else numbers(value, name)
    if array.size != 1 or not np.isfinite(array).all():
        raise UserError(f"{name} is {value!r}; it must be one finite number.")
    return float(array.reshape(())) if array.ndim else float(array)


def truth(value, name):
    """True or False; a text, which Python would take for True, is neither."""
    if not isinstance(value, (bool, np.bool_)):
        raise UserError(f"{name} is {value!r}; give True or False.")
    return bool(value)


def positive(value, name):
    """One finite number above 0."""
    found = number(value, name)
    if not found > 0:
        raise UserError(f"{name} is {found:g}; it must be above 0.")
    return found
