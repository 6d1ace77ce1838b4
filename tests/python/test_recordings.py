"""Recordings and masks give in Python what dclab and the command line give; mistakes are reported."""

import json
import subprocess
import sys

import numpy as np
import pandas
import pytest

import rheocyte
from conftest import CELLS, REFERENCE
from rheocyte import UserError

RECORDINGS = sorted((REFERENCE / "rtdc").glob("*.rtdc"))
needs_recordings = pytest.mark.skipif(not RECORDINGS, reason="the reference recordings are not beside this checkout")
KNOWN = {"channel_width_um": 20, "flow_rate_ul_s": 0.04, "medium": "CellCarrier", "temperature": 23}


@needs_recordings
def test_a_frame_holds_units_settings_and_the_numbers_of_the_command(program, tmp_path):
    file = REFERENCE / "rtdc" / "example.rtdc"
    fractions = []
    frame = rheocyte.extract(file, progress=fractions.append, pixel_size_um=0.34, **KNOWN)
    assert fractions[-1] == 1 and frame.attrs["units"]["young_modulus_kPa"] == "kPa" and frame.attrs["settings"]
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
    frame = rheocyte.extract(file, min={"area_um": 50}, max={"area_um": 100}, pixel_size_um=0.34, **KNOWN)
    inside = frame["area_um2"].between(50, 100)
    assert ((frame["state"] == "gated") == ~inside).all()
    corners = [(50, -1), (100, -1), (100, 2), (50, 2)]
    within = rheocyte.extract(file, polygon={("area_um", "deform"): corners}, pixel_size_um=0.34, **KNOWN)
    assert within["young_modulus_kPa"].equals(frame["young_modulus_kPa"])


@pytest.mark.parametrize("arguments, sentence", [
    ({"chanel_width_um": 20}, "no argument 'chanel_width_um'"),
    ({"channel_width_um": -20}, "channel"),
    ({"temperature": "warm"}, "warm"),
    ({"min": {"area_um": "x"}}, "area_um"),
    ({"section": "tube", "table": "LE-2D-26"}, "table and section contradict each other"),
    ({"polygon": {("area_um", "deform"): [1, 2, 3]}}, "pairs of numbers"),
    ({"polygon": {("area_um", "deform"): [(1, 2), (3, 4)]}}, "three corners"),
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
    for wrong in (5, None, b"a.rtdc", "a\0b", "", tmp_path):
        with pytest.raises(UserError, match="not a path|is not a file"):
            rheocyte.extract(wrong)


@pytest.mark.parametrize("call", [
    lambda file: rheocyte.extract(file, table=5), lambda file: rheocyte.extract(file, min=5),
    lambda file: rheocyte.extract(file, min={"area_um": None}), lambda file: rheocyte.extract(file, section="round"),
    lambda file: rheocyte.extract(file, progress=5), lambda file: rheocyte.extract(file, no_pixelation="no"),
    lambda file: rheocyte.extract(file, medium="a\udcff"), lambda file: rheocyte.extract(file, temperature="a\udcff"),
    lambda file: rheocyte.moduli(file, file, fit_tension="no"), lambda file: rheocyte.synth("a\0b", file),
    lambda file: rheocyte.synth("a\nb", file), lambda file: rheocyte.synth({}, file, replace="no"),
    lambda file: rheocyte.analytic(None, young_modulus_kPa=1),
    lambda file: rheocyte.analytic(5, young_modulus_kPa=1, square_duct="no"), lambda file: rheocyte.moduli(file, None),
    lambda file: rheocyte.moduli(file, file, section="round"),
    lambda file: rheocyte.time_course(file, None, 0), lambda file: rheocyte.time_course(file, file, "x"),
    lambda file: rheocyte.time_course([], contraction_um=0), lambda file: rheocyte.population({}),
    lambda file: rheocyte.synth({}, 5), lambda file: rheocyte.table({}, 5), lambda file: rheocyte.table({}, file, jobs=-1),
    lambda file: rheocyte.solve(radius_um=5, progress=5), lambda file: rheocyte.Session("large"),
    lambda file: rheocyte.features([[True], [True, False]], 0.34), lambda file: rheocyte.features(None, 0.34)])
def test_arguments_of_the_wrong_kind_are_value_errors(call, tmp_path):
    (tmp_path / "a.rtdc").write_bytes(b"")
    with pytest.raises(UserError) as caught:
        call(tmp_path / "a.rtdc")
    assert "\n" not in str(caught.value)


def test_no_damaged_file_takes_the_interpreter_along(tmp_path):
    """HDF5 breaks down on some of them; that is a UserError, too, and the next file is read as if nothing had been."""
    sound = tmp_path / "cells.rtdc"
    rheocyte.synth(CELLS, sound, recording__cells=40)
    content = bytearray(sound.read_bytes())
    rng = np.random.default_rng(6)
    ends = {"read": 0, "refused": 0}
    for _ in range(60):
        damaged = content.copy()
        for place in rng.integers(0, 4000, 12):  # where the structure lies
            damaged[place] = rng.integers(256)
        (tmp_path / "damaged.rtdc").write_bytes(damaged)
        try:
            rheocyte.extract(tmp_path / "damaged.rtdc")
            ends["read"] += 1
        except UserError as error:
            assert "\n" not in str(error)
            ends["refused"] += 1
    assert ends["refused"] > 0 and len(rheocyte.extract(sound)) == 40


@pytest.mark.parametrize("work", ["extract", "synth", "features", "modulus", "table"])
def test_ctrl_c_ends_long_work_and_python_goes_on(work, tmp_path):
    """The signal comes with the first word of progress, or once the work has begun."""
    code = """
import os, signal, sys, threading, numpy as np, rheocyte
signal.signal(signal.SIGINT, signal.default_int_handler)  # shells start what runs in the background without it
work, spec = sys.argv[1], eval(sys.argv[2])
def interrupt(*_):
    if not sent:
        sent.append(1)
        os.kill(os.getpid(), signal.SIGINT)
sent = []
def extract():
    sent.append(1)
    rheocyte.synth(spec, "cells.rtdc", recording__cells=3000)
    sent.clear()
    rheocyte.extract("cells.rtdc", progress=interrupt)
def synth(): rheocyte.synth(spec, "more.rtdc", recording__cells=100000, progress=interrupt)
def features():
    masks = np.zeros((100000, 80, 250), bool)
    masks[:, 30:50, 100:140] = True
    threading.Timer(0.2, interrupt).start()
    while True: rheocyte.features(masks, 0.34)
SMOOTH = {"channel_width_um": 20, "flow_rate_ul_s": 0.04, "viscosity_mPas": 15, "pixel_size_um": 0}
def modulus():
    table, area = rheocyte.Table("LE-2D-26"), np.full(10**7, 80.0)
    threading.Timer(0.2, interrupt).start()
    while True: table.modulus(area, np.full(10**7, 0.02), **SMOOTH)
def table():
    threading.Timer(0.5, interrupt).start()
    rheocyte.table({"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
                    "cell": {"bulk": {"law": "linear"}}, "table": {"identifier": "LONG"}}, "LONG", jobs=1)
try:
    globals()[work]()
except KeyboardInterrupt:
    print("interrupted")
print(float(rheocyte.Table("LE-2D-26").modulus(80, 0.02, **SMOOTH)[0]) > 0)
"""
    said = subprocess.run([sys.executable, "-B", "-c", code, work, repr(CELLS)], capture_output=True, text=True, cwd=tmp_path,
                          check=False)
    assert (said.stdout.split(), said.stderr) == (["interrupted", "True"], "")
    assert not (tmp_path / "more.rtdc").exists()


def test_a_disc_of_pixels_has_the_features_of_a_disc():
    y, x = np.mgrid[:80, :250]
    masks = np.stack([np.hypot(x - 120, y - 40) <= 20, np.zeros((80, 250), bool)])
    found = rheocyte.features(masks, 0.34)
    assert found.loc[0, "area_um"] == pytest.approx(np.pi * (20 * 0.34) ** 2, rel=0.02)  # of 40 pixels across
    assert (found.loc[0, "pos_x"], found.loc[0, "pos_y"]) == pytest.approx((120 * 0.34, 40 * 0.34))
    assert found.loc[0, "inert_ratio_cvx"] == pytest.approx(1, abs=1e-12)
    for tilt in ("sine_mode_2", "sine_mode_3", "sine_mode_4", "flank_slope"):
        assert found.loc[0, tilt] == pytest.approx(0, abs=1e-12)
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


def test_virtual_cells_come_back(tmp_path):
    """Their file is a recording; a file that is there is not replaced unasked."""
    file = tmp_path / "cells.rtdc"
    events = rheocyte.synth(CELLS, file)
    assert 0 < events <= 300
    frame = rheocyte.extract(file)
    assert len(frame) == events and frame["area_um2"].median() == pytest.approx(np.pi * 5.5**2, rel=0.05)
    with pytest.raises(UserError, match="already exists"):
        rheocyte.synth(CELLS, file)
    assert rheocyte.synth(CELLS, file, replace=True, recording__cells=50) <= 50
    with pytest.raises(UserError, match="cels"):
        rheocyte.synth({**CELLS, "recording": {"cels": 3}}, tmp_path / "other.rtdc")
    with pytest.raises(UserError, match=".rtdc"):
        rheocyte.synth(CELLS, tmp_path / "other.h5")


def test_a_temperature_fills_what_is_missing(tmp_path):
    """Of single events whose own is 0, and of a recording without any."""
    h5py = pytest.importorskip("h5py")
    file = tmp_path / "cells.rtdc"
    rheocyte.synth(CELLS, file, recording__cells=40)
    at_30 = rheocyte.extract(file, temperature=30)["viscosity_mPas"]
    with h5py.File(file, "r+") as recording:
        del recording["events/temp"]
        recording["events/temp"] = np.repeat([0.0, 23.0], [5, len(at_30) - 5])
        recording.attrs.pop("setup:temperature", None)
    without = rheocyte.extract(file)
    filled = rheocyte.extract(file, temperature_if_missing=30)
    assert without[["viscosity_mPas", "young_modulus_kPa"]][:5].isna().all(axis=None)
    assert np.allclose(filled["viscosity_mPas"][:5], at_30[:5], rtol=1e-3)  # the exponent is that of the median
    assert filled["viscosity_mPas"][5:].equals(without["viscosity_mPas"][5:])
    with h5py.File(file, "r+") as recording:
        del recording["events/temp"]
    with pytest.raises(UserError, match=r"Give it in degrees Celsius \(temperature_if_missing\), or the viscosity \(viscosity_mPas\)."):
        rheocyte.extract(file)
    assert np.allclose(rheocyte.extract(file, temperature_if_missing=30)["viscosity_mPas"], at_30)


@pytest.mark.parametrize("arguments, sentence", [
    ({"viscosity_mPas": 5, "medium": "water"}, "viscosity_mPas and medium contradict"),
    ({"temperature": 296}, "temperature 296"), ({"min": {"bright": 1}}, "for which min gives a limit"),
    ({"polygon": {("a", "b"): [(1, 2)]}}, r"at least three corners\.$"), ({"polygon": "filters.txt"}, "not a file of polygon"),
    ({"polygon": "all.so2"}, "of a session of DCscope there as .poly"),
    ({"polygon": "nowhere.poly"}, "nowhere.poly: cannot be read")])
def test_what_is_said_names_arguments_not_options(arguments, sentence, tmp_path):
    rheocyte.synth(CELLS, tmp_path / "cells.rtdc", recording__cells=20)
    with pytest.raises(UserError, match=sentence) as caught:
        rheocyte.extract(tmp_path / "cells.rtdc", **arguments)
    assert "--" not in str(caught.value)


def test_warnings_name_arguments_too(tmp_path):
    rheocyte.synth(CELLS, tmp_path / "cells.rtdc", recording__cells=20)
    said = rheocyte.extract(tmp_path / "cells.rtdc", temperature=25).attrs["warnings"]
    assert any(line.startswith("temperature 25 replaces") and "temperature_if_missing" in line for line in said)


def test_moduli_of_bulk_and_cortex_need_their_table(tmp_path):
    file = tmp_path / "cells.rtdc"
    rheocyte.synth(CELLS, file)
    with pytest.raises(UserError, match="nowhere"):
        rheocyte.moduli(file, tmp_path / "nowhere")


BULK_AND_CORTEX = {"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
                   "cell": {"bulk": {"law": "neo-hookean"},
                            "cortex": {"law": "neo-hookean", "tension_ratio": 0.1, "bending_kBT": 3e4}},
                   "table": {"identifier": "SMALL-HC", "cortex_fraction": [0.2, 0.5, 0.8], "min_area_um2": 115,
                             "max_area_um2": 150, "min_deformation": 8e-3, "max_deformation": 0.035, "radii": 3,
                             "accuracy": 2e-2}}


def test_moduli_of_bulk_and_cortex_come_back(program, tmp_path):
    """From virtual cells of a small combined table; in Python the numbers of the command."""
    folder = rheocyte.table(BULK_AND_CORTEX, tmp_path / "combined")
    spec = {"recording": {"cells": 60, "seed": 2}, "channel": {"width_um": 20},
            "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
            "cell": {"kind": "combined", "radius_um": {"mean": 6.5, "sd": 0.05},
                     "bulk": {"young_modulus_kPa": {"mean": 2, "sd": 0.1}},
                     "cortex": {"modulus_mN_per_m": {"mean": 10, "sd": 0.5}}},
            "shapes": {"table": str(folder)}}
    assert rheocyte.synth(spec, tmp_path / "cells.rtdc") > 50
    fractions = []
    frame = rheocyte.moduli(tmp_path / "cells.rtdc", folder, progress=fractions.append)
    assert fractions[-1] == 1 and f"settings hash: {frame.attrs['settings_hash']}" in frame.attrs["settings"]
    assert any("the channel is that of the table" in line for line in frame.attrs["warnings"])
    subprocess.run([program, "moduli", "cells.rtdc", "--table", "combined", "--section", "tube", "--quiet"], cwd=tmp_path, check=True)
    written = pandas.read_csv(tmp_path / "cells_moduli.tsv", sep="\t", comment="#").drop(columns="event")
    assert [*frame] == [*written] and (frame["status"] == written["status"]).all()
    assert frame.attrs["units"]["cortex_modulus_mN_per_m_error"] == "mN/m"
    numbers = frame.drop(columns="status")
    pandas.testing.assert_frame_equal(numbers, written[[*numbers]], check_dtype=False, rtol=5.1e-3)  # three digits or six
    # Of 60 cells with 10 % each; the sum is what the deformation gives.
    bulk, cortex = frame["young_modulus_kPa"].median(), frame["cortex_modulus_mN_per_m"].median()
    assert bulk + cortex / 6.5 == pytest.approx(2 + 10 / 6.5, rel=0.05)
    assert bulk == pytest.approx(2, rel=0.2) and cortex == pytest.approx(10, rel=0.2)


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
    frame = rheocyte.time_course(on_their_way / "cells.rtdc", on_their_way / "dynamic", 0, section="tube")
    subprocess.run([program, "time-course", "cells.rtdc", "--table", "dynamic", "--contraction-um", "0", "-o", "cells.tsv",
                    "--section", "tube", "--quiet"], cwd=on_their_way, check=True)
    written = pandas.read_csv(on_their_way / "cells.tsv", sep="\t", comment="#")
    assert [*frame] == [*written] and (frame[["status", "event_numbers"]] == written[["status", "event_numbers"]]).all(axis=None)
    numbers = frame.select_dtypes("number")
    pandas.testing.assert_frame_equal(numbers, written[[*numbers]], check_dtype=False, rtol=5.1e-2)  # two digits, and more
    assert len(frame) == 60 and set(frame["events"]) == {2}
    held = (frame["viscosity_Pas_low"] <= 5) & (frame["viscosity_Pas_high"] >= 5)
    assert held.mean() > 0.7  # of 90 %; the standard deviation is 4 %
    assert frame.attrs["population"][1].startswith("population: Young's modulus")


def test_single_images_do_not_tell_a_viscosity(on_their_way, tmp_path):
    spec = dict(ON_THEIR_WAY, shapes={"table": str(on_their_way / "dynamic")},
                recording={"cells": 12, "width_px": 260, "places_um": [30]})
    rheocyte.synth(spec, tmp_path / "once.rtdc")
    with pytest.raises(UserError, match="One picture does not distinguish"):
        rheocyte.time_course(tmp_path / "once.rtdc", on_their_way / "dynamic", 0)
    with pytest.raises(UserError, match="contraction_um has 2 places for 1 recordings"):
        rheocyte.time_course(tmp_path / "once.rtdc", on_their_way / "dynamic", [0, 1])
