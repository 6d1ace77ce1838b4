"""The workflow brings a folder of recordings to moduli, pictures and a report, and does nothing twice."""

import subprocess
import sys

import pandas
import pytest

import rheocyte
from conftest import TOP

pytest.importorskip("snakemake", reason="Snakemake is not installed", exc_type=ImportError)

CELLS = {"recording": {"cells": 200, "seed": 3}, "channel": {"width_um": 20},
         "flow": {"rate_ul_per_s": 0.04, "medium": "CellCarrier", "temperature_C": {"mean": 23, "sd": 0.3}},
         "cell": {"radius_um": {"mean": 5.5, "sd": 0.2}, "bulk": {"young_modulus_kPa": {"mean": 1.2, "sd": 0.1}}}}


def workflow(program, folder, *more):
    return subprocess.run([sys.executable, "-m", "snakemake", "-s", TOP / "examples/workflow/Snakefile", "--cores", "1",
                           "--config", "recordings=in", "results=out", f"rheocyte={program}", *more],
                          cwd=folder, capture_output=True, text=True, check=False)


def test_a_folder_of_recordings_becomes_a_report(program, tmp_path):
    (tmp_path / "in/day 1").mkdir(parents=True)
    for name, modulus in (("a", 1.0), ("day 1/b", 1.5)):
        rheocyte.synth(CELLS, tmp_path / f"in/{name}.rtdc", cell__bulk__young_modulus_kPa=modulus)
    ended = workflow(program, tmp_path)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    report = pandas.read_csv(tmp_path / "out/report.tsv", sep="\t")
    assert list(report["recording"]) == ["a", "day 1/b"]
    assert ((report["deformation_median_kPa"] - [1.0, 1.5]).abs() < 5 * report["deformation_median_kPa_error"]).all()
    for place, (_, line) in zip(("out", "out/day 1"), report.iterrows()):
        summary = pandas.read_csv(tmp_path / place / "rheocyte_summary.tsv", sep="\t").iloc[0]
        recommended = [name for name in summary.index if name.startswith("recommended_")]
        assert len(recommended) >= 5 and report.columns[0] == "recording"
        assert all(name.startswith("recommended_") for name in report.columns[1:6])
        for name in recommended:  # an empty text and no number are both NaN here
            same = line[name] == summary[name] if name in report else pandas.isna(summary[name])
            assert same or pandas.isna(line[name]) and pandas.isna(summary[name]), name
    for made in ("report.png", "a_rheocyte.png", "day 1/b_rheocyte.rtdc"):
        assert (tmp_path / "out" / made).stat().st_size > 0
    again = workflow(program, tmp_path)
    assert again.returncode == 0 and "Nothing to be done" in again.stdout + again.stderr


def test_recordings_without_moduli_are_lines_of_the_report(program, tmp_path):
    """Of the reservoir, damaged, or all events outside the table: with the reason, and the others are not stopped."""
    h5py = pytest.importorskip("h5py")
    (tmp_path / "in").mkdir()
    of_any_size = {"shapes__model": "analytical"}  # tables have no cells that are smaller than they can measure
    for name, radius in (("cells", 5.5), ("reservoir", 5.5), ("tiny", 2.5)):
        rheocyte.synth(CELLS, tmp_path / f"in/{name}.rtdc", cell__radius_um__mean=radius, cell__radius_um__sd=0.1,
                       **of_any_size if name == "tiny" else {})
    with h5py.File(tmp_path / "in/reservoir.rtdc", "r+") as file:
        file.attrs["setup:chip region"] = "reservoir"
    (tmp_path / "in/damaged.rtdc").write_bytes((tmp_path / "in/cells.rtdc").read_bytes()[:3000])
    ended = workflow(program, tmp_path)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    report = pandas.read_csv(tmp_path / "out/report.tsv", sep="\t", index_col="recording")
    assert list(report.index) == ["cells", "damaged", "reservoir", "tiny"]
    with_modulus = report["with_modulus_from_deformation"]
    assert with_modulus["cells"] > 0 and (with_modulus.iloc[1:] == 0).all()
    assert report["recommended_text"].notna().all()
    assert report["recommended_young_modulus_median_kPa"].iloc[1:].isna().all()
    reason = report["without_moduli_because"]
    assert pandas.isna(reason["cells"]) and reason["reservoir"].startswith("was recorded in the reservoir")
    assert "damaged" in reason["damaged"] and reason["tiny"] == f"{report.loc['tiny', 'events']} too_small"
    for name in report.index:
        assert (tmp_path / f"out/{name}_rheocyte.png").stat().st_size > 0


def test_the_report_has_the_number_that_extract_recommends(program, tmp_path):
    """Of elongated cells E from deformation is a quarter too low; it stands in the report by its name."""
    (tmp_path / "in").mkdir()
    rheocyte.synth(CELLS, tmp_path / "in/a.rtdc", cell__radius_um__mean=6.5, cell__bulk__young_modulus_kPa=4, flow__rate_ul_per_s=0.06,
                   flow__axial_tension_Pa=400)
    ended = workflow(program, tmp_path)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    line = pandas.read_csv(tmp_path / "out/report.tsv", sep="\t").iloc[0]
    recommended = rheocyte.extract(tmp_path / "in/a.rtdc").attrs["recommended"]
    assert line["recommended_modulus"] == recommended["modulus"] == "elongated"
    assert line["recommended_young_modulus_median_kPa"] == recommended["young_modulus_median_kPa"]
    assert line["recommended_text"] == recommended["text"]
    assert line["deformation_median_kPa"] < 0.85 * line["recommended_young_modulus_median_kPa"]


def test_a_wrong_option_stops_the_workflow(program, tmp_path):
    (tmp_path / "in").mkdir()
    rheocyte.synth(CELLS, tmp_path / "in/a.rtdc", recording__cells=20)
    ended = workflow(program, tmp_path, "measuring=--medum water")
    assert ended.returncode != 0 and "--medum" in ended.stdout + ended.stderr
    assert not (tmp_path / "out/report.tsv").exists()


def test_a_folder_without_recordings_is_named(program, tmp_path):
    ended = workflow(program, tmp_path)
    assert ended.returncode != 0 and "there is no recording" in ended.stdout + ended.stderr
