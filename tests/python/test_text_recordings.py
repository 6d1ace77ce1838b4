"""Tables of events, as text, frames and Parquet, give the numbers of the recordings that they were written from."""

import hdf5plugin  # noqa: F401 - the filter by which recordings are compressed
import h5py
import numpy as np
import pandas
import pytest

import rheocyte
from conftest import CELLS
from rheocyte import UserError


def same_frames(a, b):
    pandas.testing.assert_frame_equal(a, b, check_exact=True)


def write_text(frame, metadata, file, **options):
    with open(file, "w", encoding="utf-8-sig") as text:
        for key, value in metadata.items():
            text.write(f"# {key} = {' '.join(str(value).split())}\n")
        frame.to_csv(text, index=False, **options)
    return file


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """A recording without pictures, its columns and its metadata."""
    folder = tmp_path_factory.mktemp("recording")
    rheocyte.synth(CELLS, folder / "cells.rtdc", cell__radius_um__mean=6.8, cell__bulk__young_modulus_kPa__mean=3)
    file = folder / "numbers.rtdc"
    with h5py.File(folder / "cells.rtdc") as whole, h5py.File(file, "w") as numbers:
        columns = {name: whole["events"][name][:] for name in whole["events"] if np.ndim(whole["events"][name]) == 1}
        for name, values in columns.items():
            numbers[f"events/{name}"] = values
        metadata = {key: value for key, value in whole.attrs.items() if np.ndim(value) == 0}
        numbers.attrs.update(metadata)
    return file, pandas.DataFrame(columns).astype(float), metadata


def test_text_and_frame_give_the_numbers_of_the_recording(recording, tmp_path):
    file, frame, metadata = recording
    expected = rheocyte.extract(file)
    assert np.isfinite(expected["young_modulus_kPa"]).any()
    for name, options in (("a.csv", {}), ("a.tsv", {"sep": "\t", "lineterminator": "\r\n"}), ("a.txt", {"sep": ";", "quoting": 2})):
        same_frames(rheocyte.extract(write_text(frame, metadata, tmp_path / name, **options)), expected)
    frame.attrs = metadata
    found = rheocyte.extract(frame.assign(drug="none"))
    same_frames(found, expected)
    assert found.attrs["warnings"][-1] == "columns that are left out, because they contain no numbers: drug."


def test_populations_take_tables(recording, tmp_path):
    file, frame, metadata = recording
    text = write_text(frame, metadata, tmp_path / "numbers.csv")
    frame.attrs = metadata
    found = [rheocyte.population({"a": [each]}, by="deformation").recordings for each in (file, text, frame)]
    assert np.isfinite(found[0]["young_modulus_median_kPa"]).all(), found[0]["failure"][0]
    for other in found[1:]:
        same_frames(other.drop(columns="recording"), found[0].drop(columns="recording"))
    assert [each["recording"][0] for each in found] == [str(file), str(text), "the table"]
    with pytest.raises(UserError, match="contains the same events"):
        rheocyte.population({"a": [file], "b": [text]}, by="deformation")


def test_parquet_is_a_table(recording, tmp_path):
    pytest.importorskip("pyarrow")
    file, frame, metadata = recording
    frame = frame.copy()
    frame.attrs = {}
    frame.to_parquet(tmp_path / "a.parquet")
    plain = {key: value if isinstance(value, str) else value.item() for key, value in metadata.items()}
    sections = [[f"{key.split(':')[1]!r} = {value!r}" for key, value in plain.items() if key.startswith(section)]
                for section in ("setup:", "imaging:")]
    (tmp_path / "a.toml").write_text("\n".join(["[setup]", *sections[0], "[imaging]", *sections[1], ""]))
    same_frames(rheocyte.extract(tmp_path / "a.parquet", viscosity_mPas=5), rheocyte.extract(file, viscosity_mPas=5))


def test_what_a_frame_lacks_is_named(recording):
    _, frame, metadata = recording
    bare = frame[["area_um", "deform"]].copy()
    bare.attrs = {}
    with pytest.raises(UserError, match=r"the table: the set-up is incomplete: setup:channel width \(channel_width_um\), .*temp"):
        rheocyte.extract(bare)
    frame.attrs = metadata
    with pytest.raises(UserError, match="the table: has no column deform; its columns are area_um"):
        rheocyte.extract(frame[["area_um"]])
    twice = pandas.concat([frame[["area_um", "deform"]]] * 2, axis=1)
    with pytest.raises(UserError, match="the table: line .*names the column area_um twice"):
        rheocyte.extract(twice)


def test_parquet_that_is_none_is_named(tmp_path):
    (tmp_path / "a.parquet").write_bytes(b"PAR1")
    with pytest.raises(UserError, match="a.parquet: "):
        rheocyte.extract(tmp_path / "a.parquet")
