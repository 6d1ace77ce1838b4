"""Recordings and masks give in Python what dclab and the command line give; mistakes are told."""

import subprocess

import numpy as np
import pandas
import pytest

import rheocyte
from conftest import REFERENCE
from rheocyte import UserError

RECORDINGS = sorted((REFERENCE / "rtdc").glob("*.rtdc"))
needs_recordings = pytest.mark.skipif(not RECORDINGS, reason="the reference recordings are not beside this checkout")
KNOWN = {"channel_width_um": 20, "flow_rate_ul_s": 0.04, "medium": "CellCarrier", "temperature": 23}


@needs_recordings
def test_a_frame_holds_units_settings_and_the_numbers_of_the_command(program, tmp_path):
    file = REFERENCE / "rtdc" / "example.rtdc"
    shares = []
    frame = rheocyte.extract(file, progress=shares.append, pixel_size_um=0.34, **KNOWN)
    assert shares[-1] == 1 and frame.attrs["units"]["young_modulus_kPa"] == "kPa" and frame.attrs["settings"]
    assert frame["state"].isin(rheocyte.STATES).all()
    has = np.isfinite(frame["young_modulus_kPa"])
    assert (frame["state"].isin(["valid", "regularised"]) == has).all() and has.any()
    subprocess.run([program, "extract", file, "-o", tmp_path, "--quiet", "--pixel-size-um", "0.34", "--channel-width-um",
                    "20", "--flow-rate-ul-s", "0.04", "--medium", "CellCarrier", "--temperature", "23"], check=True)
    written = pandas.read_csv(tmp_path / "example_rheocyte.tsv", sep="\t", comment="#")
    assert np.allclose(written["young_modulus_kPa"], frame["young_modulus_kPa"], rtol=1e-6, equal_nan=True)  # 32 bits


@needs_recordings
def test_gates_shut_events_out():
    file = REFERENCE / "rtdc" / "example.rtdc"
    frame = rheocyte.extract(file, least={"area_um": 50}, greatest={"area_um": 100}, pixel_size_um=0.34, **KNOWN)
    inside = frame["area_um2"].between(50, 100)
    assert ((frame["state"] == "gated") == ~inside).all()
    corners = [(50, -1), (100, -1), (100, 2), (50, 2)]
    within = rheocyte.extract(file, polygons={("area_um", "deform"): corners}, pixel_size_um=0.34, **KNOWN)
    assert within["young_modulus_kPa"].equals(frame["young_modulus_kPa"])


@pytest.mark.parametrize("arguments, sentence", [
    ({"chanel_width_um": 20}, "no argument 'chanel_width_um'"),
    ({"channel_width_um": -20}, "channel"),
    ({"temperature": "warm"}, "warm"),
    ({"least": {"area_um": "x"}}, "area_um"),
    ({"polygons": {("area_um", "deform"): [1, 2, 3]}}, "pairs of numbers"),
    ({"polygons": {("area_um", "deform"): [(1, 2), (3, 4)]}}, "three corners"),
])
@needs_recordings
def test_wrong_arguments_are_value_errors(arguments, sentence):
    with pytest.raises(UserError, match=sentence):
        rheocyte.extract(REFERENCE / "rtdc" / "example.rtdc", **{**KNOWN, **arguments})


def test_a_file_that_is_none_or_damaged_is_named(tmp_path):
    with pytest.raises(UserError, match="nowhere.rtdc"):
        rheocyte.extract(tmp_path / "nowhere.rtdc")
    (tmp_path / "damaged.rtdc").write_bytes(b"\x89HDF\r\n\x1a\n" + b"\xff" * 2000)
    with pytest.raises(UserError, match="damaged.rtdc"):
        rheocyte.extract(tmp_path / "damaged.rtdc")
    with pytest.raises(UserError, match="no path"):
        rheocyte.extract(5)


def test_a_disc_of_pixels_has_the_features_of_a_disc():
    y, x = np.mgrid[:80, :250]
    masks = np.stack([np.hypot(x - 120, y - 40) <= 20, np.zeros((80, 250), bool)])
    found = rheocyte.features(masks, 0.34)
    assert found.loc[0, "area_um"] == pytest.approx(np.pi * (20 * 0.34) ** 2, rel=0.02)  # of 40 pixels across
    assert (found.loc[0, "pos_x"], found.loc[0, "pos_y"]) == pytest.approx((120 * 0.34, 40 * 0.34))
    assert found.loc[0, "inert_ratio_cvx"] == pytest.approx(1, abs=1e-12)
    assert found.loc[1].isna().all()
    for kind in ("i8", "u1", "i1"):
        assert rheocyte.features(masks.astype(kind), 0.34).equals(found)
    assert rheocyte.features(masks[0], 0.34).equals(found.iloc[:1])
    assert rheocyte.features(masks[:, :, ::-1][:, :, ::-1], 0.34).equals(found)


@pytest.mark.parametrize("masks, size", [
    (np.zeros((2, 3, 4)), 0.34), (np.zeros(5, bool), 0.34), (np.zeros((1, 0, 5), bool), 0.34), ("mask", 0.34),
    (np.zeros((2, 3, 4), bool), 0), (np.zeros((2, 3, 4), bool), "large"), (np.zeros((2, 3, 4), bool), np.nan)])
def test_what_is_no_mask_is_refused(masks, size):
    with pytest.raises(UserError):
        rheocyte.features(masks, size)


def test_the_analytical_model_is_that_of_the_command(program):
    import json

    cell = rheocyte.analytic(5, young_modulus_kPa=10)
    assert cell.deformation > 0 and cell.within_limits and cell.contour.shape[1] == 2
    softer = rheocyte.analytic(5, young_modulus_kPa=20)
    assert cell.deformation == pytest.approx(4 * softer.deformation, rel=0.02)  # second order in the strain
    said = subprocess.run([program, "analytic", "cell", "--radius-um", "5", "--young-modulus-kPa", "10", "--json"],
                          capture_output=True, check=True).stdout
    assert json.loads(said) == cell.to_dict()
    for wrong in ({}, {"young_modulus_kPa": -1}, {"young_modulus_kPa": 1, "cortex_modulus_mN_per_m": 1},
                  {"young_modulus_kPa": 1, "tension_ratio": 0.1}, {"young_modulus_kPa": "soft"}):
        with pytest.raises(UserError):
            rheocyte.analytic(5, **wrong)
    with pytest.raises(UserError, match="tube radius"):
        rheocyte.analytic(50, young_modulus_kPa=10)


CELLS = {"recording": {"cells": 300, "seed": 5}, "channel": {"width_um": 20},
         "flow": {"rate_ul_per_s": 0.04, "medium": "CellCarrier", "temperature_C": {"mean": 23, "sd": 0.3}},
         "cell": {"radius_um": {"mean": 5.5, "sd": 0.2},
                  "bulk": {"young_modulus_kPa": {"mean": 8, "sd": 0.5, "distribution": "lognormal"}}}}


def test_virtual_cells_come_back(tmp_path):
    """Their file is a recording; a file that is there is not replaced unasked."""
    file = tmp_path / "cells.rtdc"
    events = rheocyte.synth(CELLS, file)
    assert 0 < events <= 300
    frame = rheocyte.extract(file)
    assert len(frame) == events and frame["area_um2"].median() == pytest.approx(np.pi * 5.5**2, rel=0.05)
    with pytest.raises(UserError, match="is there already"):
        rheocyte.synth(CELLS, file)
    assert rheocyte.synth(CELLS, file, replace=True, recording__cells=50) <= 50
    with pytest.raises(UserError, match="cels"):
        rheocyte.synth({**CELLS, "recording": {"cels": 3}}, tmp_path / "other.rtdc")
    with pytest.raises(UserError, match=".rtdc"):
        rheocyte.synth(CELLS, tmp_path / "other.h5")


def test_moduli_of_bulk_and_cortex_need_their_table(tmp_path):
    file = tmp_path / "cells.rtdc"
    rheocyte.synth(CELLS, file)
    with pytest.raises(UserError, match="nowhere"):
        rheocyte.moduli(file, tmp_path / "nowhere")


ON_THEIR_WAY = {"recording": {"cells": 60, "width_px": 260, "places_um": [15, 55]}, "channel": {"width_um": 20},
                "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
                "cell": {"radius_um": {"mean": 6.5, "sd": 0.2}, "viscosity_mPas": 5000, "bulk": {"young_modulus_kPa": 8}},
                "shapes": {"table": "dynamic"}}


@pytest.fixture(scope="module")
def on_their_way(program, tmp_path_factory):
    """A folder with a dynamic table of few cells, and a recording of others, each seen twice."""
    folder = tmp_path_factory.mktemp("time-course")
    (folder / "dynamic.toml").write_text("""
[channel.profile]
x_um = [60.0, 100.0]
R_um = [21.88, 10.94]
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
density_kg_per_m3 = 0
[cell]
density_kg_per_m3 = 0
[time]
degree = 2
accuracy = 1e-3
[dynamic]
identifier = "small"
min_radius_um = 5.5
max_radius_um = 7.5
min_young_modulus_kPa = 6.0
max_young_modulus_kPa = 20.0
min_time_ms = 0.5
last_um = 60
radii = 2
moduli = 2
times = 2
places = 4
checks = 0
""")
    subprocess.run([program, "table", "dynamic.toml", "-o", "dynamic", "--quiet"], cwd=folder, check=True)
    spec = dict(ON_THEIR_WAY, shapes={"table": str(folder / "dynamic")})
    assert rheocyte.synth(spec, folder / "cells.rtdc") == 120
    return folder


def test_the_time_course_is_that_of_the_command(program, on_their_way):
    frame = rheocyte.time_course(on_their_way / "cells.rtdc", on_their_way / "dynamic", 0)
    subprocess.run([program, "time-course", "cells.rtdc", "--table", "dynamic", "--contraction-um", "0", "-o", "cells.tsv",
                    "--quiet"], cwd=on_their_way, check=True)
    written = pandas.read_csv(on_their_way / "cells.tsv", sep="\t", comment="#")
    pandas.testing.assert_frame_equal(frame.drop(columns="recording"), written.drop(columns="recording"))
    assert len(frame) == 60 and set(frame["events"]) == {2}
    held = (frame["viscosity_low_Pas"] <= 5) & (frame["viscosity_high_Pas"] >= 5)
    assert held.mean() > 0.7  # of 90 %; the standard deviation is 4 %
    assert frame.attrs["population"][1].startswith("population: Young's modulus")


def test_single_images_do_not_tell_a_viscosity(on_their_way, tmp_path):
    spec = dict(ON_THEIR_WAY, shapes={"table": str(on_their_way / "dynamic")},
                recording={"cells": 12, "width_px": 260, "places_um": [30]})
    rheocyte.synth(spec, tmp_path / "once.rtdc")
    with pytest.raises(UserError, match="One picture of a cell does not tell"):
        rheocyte.time_course(tmp_path / "once.rtdc", on_their_way / "dynamic", 0)
    with pytest.raises(UserError, match="contraction_um has 2 places for 1 recordings"):
        rheocyte.time_course(tmp_path / "once.rtdc", on_their_way / "dynamic", [0, 1])
