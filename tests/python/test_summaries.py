"""What is said of a whole recording is the same wherever it stands."""

import json
import subprocess

import pandas
import pytest

import rheocyte
from conftest import CELLS


def test_what_is_recommended_is_the_same_wherever_it_stands(program, tmp_path):
    """In the summary, below the events, in the companion and in Python; of cells that an axial tension draws out it is not
    the modulus from deformation, which is more than 10 % lower."""
    h5py = pytest.importorskip("h5py")
    file = tmp_path / "cells.rtdc"
    rheocyte.synth(CELLS, file, flow__axial_tension_Pa=400, cell__bulk__young_modulus_kPa__mean=3)
    events = rheocyte.extract(file)
    recommended = events.attrs["recommended"]
    subprocess.run([program, "extract", file, "-o", tmp_path / "out", "--quiet"], check=True)
    summary = pandas.read_csv(tmp_path / "out/rheocyte_summary.tsv", sep="\t").iloc[0]
    told = {name.removeprefix("recommended_"): value for name, value in summary.items() if name.startswith("recommended_")}
    assert recommended == {name: None if pandas.isna(value) else value for name, value in told.items()}
    with h5py.File(tmp_path / "out/cells_rheocyte.rtdc") as companion:
        assert json.loads(companion.attrs["user:rheocyte recommended"]) == recommended
    lines = (tmp_path / "out/cells_rheocyte.tsv").read_text(encoding="utf-8").splitlines()
    last = dict(line.removeprefix("# recommended_").split(": ", 1) for line in lines if line.startswith("# recommended_"))
    assert set(last) == {name for name, value in recommended.items() if value is not None}
    assert all(recommended[name] in (text, float(text) if isinstance(recommended[name], float) else text) for name, text in last.items())
    assert recommended["modulus"] == "elongated"
    assert events["young_modulus_kPa"].median() < 0.9 * recommended["young_modulus_median_kPa"]


def test_results_of_the_same_settings_have_one_hash(program, tmp_path):
    """In the frame, the summary, the table of events and the log of the companion; not that of another table, viscosity or gate."""
    pytest.importorskip("hdf5plugin")
    h5py = pytest.importorskip("h5py")
    for seed in (1, 2):
        rheocyte.synth(CELLS, tmp_path / f"{seed}.rtdc", recording__seed=seed)
    one, other = (rheocyte.extract(tmp_path / f"{seed}.rtdc").attrs["settings_hash"] for seed in (1, 2))
    assert one == other and len(one) == 16
    subprocess.run([program, "extract", "1.rtdc", "-o", "out", "--quiet"], cwd=tmp_path, check=True)
    assert pandas.read_csv(tmp_path / "out/rheocyte_summary.tsv", sep="\t", dtype=str)["settings_hash"].tolist() == [one]
    assert f"\n# settings hash: {one}\n" in (tmp_path / "out/1_rheocyte.tsv").read_text(encoding="utf-8")
    with h5py.File(tmp_path / "out/1_rheocyte.rtdc") as companion:
        assert f"settings hash: {one}" in [line.decode() for line in companion["logs/rheocyte-extract"]]
    hashes = {rheocyte.extract(tmp_path / "1.rtdc", **settings).attrs["settings_hash"]
              for settings in ({}, {"viscosity_mPas": 6}, {"table": "LE-2D-26"}, {"min": {"area_um": 50}}, {"min": {"area_um": 51}},
                               {"no_asymmetry": True})}
    assert one in hashes and len(hashes) == 6
