"""Tables of events that are no text, frames of pandas and Parquet: written as text for the time of the work."""

import os
import shutil
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from rheocyte.errors import UserError, reason
from rheocyte.paths import path


def is_frame(given):
    """Whether it is a DataFrame of pandas, which is not imported for that."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(given, pandas.DataFrame)


def is_parquet(given):
    """Whether it is the path of a Parquet file."""
    return isinstance(given, (str, os.PathLike)) and str(given).lower().endswith(".parquet")


@contextmanager
def as_text(given):
    """The place of the table as text, the name of the table, and warnings."""
    place = Path(path(given, "the recording")) if is_parquet(given) else Path("table")
    frame = _read(place) if is_parquet(given) else given
    with tempfile.TemporaryDirectory(prefix="rheocyte-") as folder:
        text = Path(folder) / f"{place.stem}.csv"
        set_up = place.with_suffix(".toml")
        if is_parquet(given) and set_up.is_file():
            shutil.copy(set_up, folder)
        left_out = _write(frame, text)
        yield str(text), str(place) if is_parquet(given) else "the table", left_out


def _read(place):
    import pandas

    if not place.is_file():
        raise UserError(f"{place}: there is no such file.")
    try:
        return pandas.read_parquet(place)
    except ImportError:
        raise UserError(f"{place}: tables in Parquet need pyarrow; install it (pip install pyarrow), or save the table as "
                        "CSV.") from None
    except (OSError, ValueError) as error:
        raise UserError(f"{place}: cannot be read as Parquet: {reason(error).rstrip('.')}.") from None


def _write(frame, text):
    """Writes the columns of numbers, and attrs named "section:key" as metadata; returns a warning about other columns."""
    import pandas
    from pandas.api import types

    columns = [frame.iloc[:, place] for place in range(frame.shape[1])]
    numbers = [column for column in columns if types.is_numeric_dtype(column)]
    with open(text, "w", encoding="utf-8", newline="\n") as file:
        for key, value in frame.attrs.items():
            if isinstance(key, str) and ":" in key and isinstance(value, (str, int, float, np.number)):
                file.write(f"# {key} = {' '.join(str(value).split())}\n")
        values = {place: column.to_numpy(float, na_value=np.nan) for place, column in enumerate(numbers)}
        pandas.DataFrame(values).to_csv(file, index=False, header=[str(column.name) for column in numbers])
    others = [str(column.name) for column in columns if not types.is_numeric_dtype(column)]
    return [f"columns that are left out, because they contain no numbers: {', '.join(others)}."] if others else []
