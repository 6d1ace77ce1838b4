"""Tables give moduli of arrays without copies, by the same numbers as the command line, and refuse what does not fit."""

import os

import numpy as np
import pytest

import rheocyte
from rheocyte import Table, UserError

SETTING = {"channel_width_um": 20, "flow_rate_ul_s": 0.04}
WATERY = {**SETTING, "viscosity_mPas": 15}
EVEN = {**SETTING, "pixel_size_um": 0}
SMOOTH = {**WATERY, "pixel_size_um": 0}


@pytest.fixture(scope="module")
def table():
    return Table("LE-2D-26")


def test_a_solved_cell_has_its_modulus_in_the_table(table):
    """The table is one of linear solids in a Newtonian liquid without inertia."""
    state = rheocyte.solve(radius_um=7, young_modulus_kPa=2, cell__bulk__law="linear", channel_width_um=20,
                           flow_rate_ul_s=0.04, viscosity_mPas=15, flow__density_kg_per_m3=0)
    found = table.modulus(state.area_um2, state.deformation, **SMOOTH)
    assert found.young_modulus_kPa == pytest.approx(2, rel=2e-3)  # the table interpolates to some parts in a thousand
    assert found.young_modulus_kPa_error < 0.02 and rheocyte.STATES[int(found.state)] == "valid"


def test_shapes_are_kept_and_inputs_stay(table):
    area, deform = np.linspace(60, 200, 12).reshape(3, 4)[0], np.full(4, 0.03)
    before = area.copy(), deform.copy()
    found = table.modulus(area, deform, **SMOOTH)
    assert all(column.shape == (4,) for column in found) and found.state.dtype == np.int8
    assert (area == before[0]).all() and (deform == before[1]).all()
    assert table.modulus(100, 0.03, **SMOOTH).young_modulus_kPa.shape == ()
    assert [len(column) for column in table.modulus([], [], **SMOOTH)] == [0, 0, 0]


def test_views_lists_and_narrow_numbers_give_the_same(table):
    area, deform = np.linspace(60, 200, 1000), np.linspace(0.01, 0.06, 1000)
    whole = table.modulus(area, deform, **SMOOTH).young_modulus_kPa
    assert np.array_equal(table.modulus(area[::2], deform[::2], **SMOOTH).young_modulus_kPa, whole[::2], equal_nan=True)
    assert np.array_equal(table.modulus(area.tolist(), deform.tolist(), **SMOOTH)[0], whole, equal_nan=True)
    narrow = table.modulus(area.astype("f4"), deform.astype("f4"), **SMOOTH).young_modulus_kPa
    assert np.allclose(narrow, whole, rtol=1e-5, equal_nan=True)  # single precision, amplified by the table's slopes


def test_an_array_that_fits_is_not_copied():
    from rheocyte.arrays import numbers

    values = np.linspace(0, 1, 10)
    assert np.shares_memory(numbers(values, "values"), values)


def test_numbers_of_any_kind_are_taken(table):
    area, deform = np.array([80.0, 120.0]), np.array([0.01, 0.03])
    plain = table.modulus(area, deform, **SMOOTH).young_modulus_kPa
    frozen = area.copy()
    frozen.flags.writeable = False
    for other in (area.astype(">f8"), area.astype(np.longdouble), np.ma.array(area), frozen, area[::-1][::-1]):
        assert np.array_equal(table.modulus(other, deform, **SMOOTH).young_modulus_kPa, plain)


def test_events_of_impossible_temperature_have_no_modulus(table):
    found = table.modulus([80] * 4, [0.02] * 4, medium="CellCarrier", temperature_C=[23, -1, 296, np.nan], **EVEN)
    assert [rheocyte.STATES[k] for k in found.state] == ["valid"] + ["no data"] * 3


def test_what_a_mask_hides_is_no_measurement(table):
    """A masked event has no modulus; its hidden number is not taken for one."""
    found = table.modulus(np.ma.array([80.0, 80.0], mask=[False, True]), [0.02, 0.02], **SMOOTH)
    assert [rheocyte.STATES[k] for k in found.state] == ["valid", "no data"]
    with pytest.raises(UserError, match="one finite number"):
        table.modulus(80, 0.02, **{**SMOOTH, "channel_width_um": np.ma.array(20.0, mask=True)})


def test_blocks_do_not_show(table):
    """One call on many events gives what calls on single events give."""
    rng = np.random.default_rng(5)
    area, deform = rng.uniform(20, 300, 9001), rng.uniform(0, 0.2, 9001)
    viscosity = rng.uniform(3, 20, 9001)
    whole = table.modulus(area, deform, viscosity_mPas=viscosity, pixel_size_um=0.34, **SETTING)
    for i in (0, 511, 512, 4095, 4096, 9000):
        one = table.modulus(area[i], deform[i], viscosity_mPas=viscosity[i], pixel_size_um=0.34, **SETTING)
        # vector instructions on whole blocks and on remainders round differently
        assert np.allclose([float(c) for c in one], [c[i] for c in whole], rtol=1e-12, equal_nan=True)
    assert set(np.unique(whole.state)) > {0}


def test_states_tell_why_there_is_no_modulus(table):
    found = table.modulus([np.nan, 1, 1e4, 100, 100], [0.03, 0.03, 0.03, 1e-9, 0.9], **SMOOTH)
    assert [rheocyte.STATES[k] for k in found.state[:4]] == ["no data", "too small", "too large", "too stiff"]
    assert np.isnan(found.young_modulus_kPa).all()


def test_temperatures_of_events_are_viscosities_of_events(table):
    celsius = np.array([20.0, 23.0, 26.0])
    mPas = rheocyte.viscosity("CellCarrier", temperature_C=celsius, **SETTING)
    assert (np.diff(mPas) < 0).all() and mPas[1] == rheocyte.viscosity("CellCarrier", temperature_C=23, **SETTING)
    by_celsius = table.modulus([100] * 3, [0.03] * 3, medium="CellCarrier", temperature_C=celsius, **EVEN)
    by_mPas = table.modulus([100] * 3, [0.03] * 3, viscosity_mPas=mPas, **EVEN)
    assert np.array_equal(by_celsius.young_modulus_kPa, by_mPas.young_modulus_kPa)


def test_the_table_of_a_medium_thins_as_it_does():
    assert Table.for_medium("CellCarrier").identifier == "HE-3D-MC049-26"
    assert Table.for_medium("water").identifier == "HE-3D-26"
    assert set(rheocyte.table_names()) >= {"LE-2D-26", "LE-2D-MC049-26", "LE-2D-MC059-26", "LE-2D-MC083-26"}


def test_lines_are_where_the_modulus_is_constant(table):
    for modulus, points in table.lines([1, 2, 4], pixel_size_um=0):
        again = table.modulus(*points[1:-1].T, **SMOOTH).young_modulus_kPa
        assert np.allclose(again, modulus, rtol=1e-6)  # the line is found to eight digits
    for modulus, points in table.lines(count=5, channel_width_um=30, flow_rate_ul_s=0.16, viscosity_mPas=6,
                                       pixel_size_um=0.34):
        again = table.modulus(*points[2:-2].T, channel_width_um=30, flow_rate_ul_s=0.16, viscosity_mPas=6,
                              pixel_size_um=0.34).young_modulus_kPa
        assert np.nanmax(np.abs(again / modulus - 1)) < 1e-2  # the pixels are added by an iteration
    border = table.support(pixel_size_um=0)
    assert border.shape[1] == 2 and len(border) > 10


def test_shapes_of_solved_cells_are_those_of_the_table(table):
    """The excess of a longer cell is what it has more; published tables know no shapes."""
    state = rheocyte.solve(radius_um=7, young_modulus_kPa=2, cell__bulk__law="linear", flow__density_kg_per_m3=0, **WATERY)
    at = {"channel_width_um": 20, "pixel_size_um": 0}
    same = table.shapes(state.area_um2, state.deformation, state.inertia_ratio, **at)
    assert same.expected == pytest.approx(state.inertia_ratio, rel=2e-3)  # as far as the table interpolates
    assert same.excess == pytest.approx(0, abs=3e-3) and same.standard_error == 0
    seen = {**at, "pixel_size_um": 0.34}
    longer = table.shapes([state.area_um2], [state.deformation], [state.inertia_ratio + 0.1], **seen)
    assert longer.excess.shape == (1,) and longer.excess[0] > 0.05 and longer.standard_error[0] > 0
    assert np.isnan(table.shapes(100, 0.02, np.nan, **at).excess)
    with pytest.raises(UserError, match="inertia_ratio 2"):
        table.shapes([80], [0.02], [1, 2], **at)
    with pytest.raises(UserError, match="does not know the shapes"):
        Table(table.texts().table).shapes(80, 0.02, 1, **at)


@pytest.mark.parametrize("name", rheocyte.table_names())
def test_texts_are_made_of_tables(name):
    """Other programs interpolate linearly between their rows: that is 1e-3 off where cells are little deformed."""
    own = Table(name)
    files = own.texts()
    text = Table(files.table)
    assert text.identifier == own.identifier == name and not text.is_own
    rng = np.random.default_rng(8)
    greatest = min(0.04, 0.9 * np.loadtxt(files.table)[:, 1].max())  # triangles along the border are long
    area, deform = rng.uniform(45, 180, 2000), rng.uniform(0.003, greatest, 2000)
    ours, theirs = own.modulus(area, deform, **SMOOTH), text.modulus(area, deform, **SMOOTH)
    has = np.isfinite(ours.young_modulus_kPa) & np.isfinite(theirs.young_modulus_kPa)
    assert has.mean() > 0.9
    assert np.abs(theirs.young_modulus_kPa[has] / ours.young_modulus_kPa[has] - 1).max() < 2e-3
    rows = np.loadtxt(files.lines)
    on_line = own.modulus(rows[:, 0], rows[:, 1], **{**SMOOTH, "viscosity_mPas": own.origin["viscosity_mPas"]})
    inside = np.isfinite(on_line.young_modulus_kPa)
    assert inside.mean() > 0.95 and np.allclose(on_line.young_modulus_kPa[inside], rows[inside, 2], rtol=1e-6)


@pytest.mark.parametrize("call", [
    lambda table: table.modulus(60, 0.02, **WATERY), lambda table: table.shapes(60, 0.02, 1.1, channel_width_um=20),
    lambda table: table.lines([1, 2]), lambda table: table.support()])
def test_without_pixels_is_said_on_purpose(call, table):
    """What pixels do is 20 % of a modulus: no one leaves it out by forgetting a word."""
    with pytest.raises(TypeError, match="pixel_size_um"):
        call(table)


def test_texts_go_where_they_are_wanted(table, tmp_path):
    """Twice, because our own files are replaced; those of others are not."""
    folder = tmp_path / "new" / "folder"
    for _ in range(2):
        files = table.texts(folder)
    assert sorted(folder.iterdir()) == sorted(files)
    assert files.table.read_bytes() == table.texts().table.read_bytes()
    files.table.write_text("mine")
    with pytest.raises(UserError, match="lut_LE-2D-26.txt"):
        table.texts(folder)
    with pytest.raises(UserError, match="is not a path"):
        table.texts(3)
    with pytest.raises(UserError, match="is a text table"):
        Table(table.texts().table).texts(folder)


@pytest.mark.parametrize("area, deform, setting, sentence", [
    ([1, 2], [0.1], SMOOTH, "not equally long: area_um2 2, deform 1"),
    ([[1, 2]], [[1, 2]], SMOOTH, "one number per event"),
    (["a"], [0.1], SMOOTH, "area_um2 is not an array of numbers"),
    ([1j], [0.1], SMOOTH, "area_um2 is not an array of numbers"),
    (None, [0.1], SMOOTH, "area_um2 is not an array of numbers"),
    ([[1], [2, 3]], [0.1], SMOOTH, "area_um2 is not an array of numbers"),
    ([1], [0.1], EVEN, "viscosity is missing"),
    ([1], [0.1], {**SMOOTH, "medium": "water"}, "exclude each other"),
    ([1], [0.1], {**EVEN, "medium": "honey", "temperature_C": 23}, "honey"),
    ([1], [0.1], {**EVEN, "medium": "water", "temperature_C": 23, "viscosity_model": "mine"}, None),
    ([1], [0.1], {**SMOOTH, "channel_width_um": -1}, "channel_width_um is -1"),
    ([1], [0.1], {**SMOOTH, "channel_width_um": "20"}, "channel_width_um is '20'; it must be one finite number"),
    ([1], [0.1], {**SMOOTH, "channel_width_um": True}, "channel_width_um is True; it must be one finite number"),
    ([1], [0.1], {**SMOOTH, "flow_rate_ul_s": np.nan}, "flow_rate_ul_s"),
    ([1], [0.1], {**SMOOTH, "pixel_size_um": -0.3}, "pixel_size_um"),
    ([1, 2], [0.1, 0.1], {**EVEN, "viscosity_mPas": [1, 2, 3]}, "viscosity_mPas 3"),
    ([1, 2], [0.1, 0.1], {**EVEN, "medium": "water", "temperature_C": [1, 2, 3]}, "temperature_C 3"),
    ([1], [0.1], {**EVEN, "medium": "water", "temperature_C": 296}, "temperature_C is 296.0; a buffer"),
    ([1], [0.1], {**EVEN, "viscosity_mPas": -1}, "viscosity_mPas holds -1"),
    ([1], [0.1], {**EVEN, "viscosity_mPas": object()}, "viscosity_mPas is not an array of numbers"),
    (np.zeros(1, dtype=[("a", float)]), [0.1], SMOOTH, "area_um2 is not an array of numbers"),
    (np.array(["2020"], dtype="M8[D]"), [0.1], SMOOTH, "area_um2 is not an array of numbers"),
])
def test_what_does_not_fit_is_a_value_error(table, area, deform, setting, sentence):
    with pytest.raises(UserError, match=sentence):
        table.modulus(area, deform, **setting)


def test_a_table_that_is_not_there_or_damaged_is_named(tmp_path):
    with pytest.raises(UserError, match="LE-2D-27.*did you mean.*LE-2D-26"):
        Table("LE-2D-27")
    for wrong in (5, None, "a\0b"):
        with pytest.raises(UserError, match="the table is .* not a path"):
            Table(wrong)
    with pytest.raises(UserError, match="there is no such file"):
        Table("x" * 5000)
    for count in (0, "x", np.nan):
        with pytest.raises(UserError, match="count"):
            Table("LE-2D-26").lines(count=count, pixel_size_um=0)
    file = tmp_path / "grid_mine.cbor"
    file.write_bytes(b"\x00" * 100)
    with pytest.raises(UserError, match="grid_mine.cbor"):
        Table(file)


def test_names_of_files_need_not_be_unicode(table, tmp_path):
    """Those of older systems come as Python's surrogates; messages spell their bytes."""
    file = tmp_path / os.fsdecode(b"lut_M\xe4use.txt")
    file.write_bytes(table.texts().table.read_bytes())
    again = Table(file).modulus(80, 0.02, **SMOOTH).young_modulus_kPa
    assert again == pytest.approx(table.modulus(80, 0.02, **SMOOTH).young_modulus_kPa, rel=2e-3)  # straight between rows
    file.unlink()
    with pytest.raises(UserError, match=r"lut_M\\xe4use.txt"):
        Table(file)


@pytest.mark.parametrize("call", [
    lambda table: table.modulus(80, 0.02, correct_area="no", **SMOOTH),
    lambda table: table.modulus(80, 0.02, correct_area=np.ones(2, bool), **SMOOTH),
    lambda table: table.modulus(80, 0.02, medium="a\udcff", temperature_C=23, **EVEN),
    lambda table: table.modulus(np.ones((2, 3)), np.ones((2, 3)), **SMOOTH),
    lambda table: table.modulus(80, 0.02, **{**SMOOTH, "channel_width_um": np.ones((2, 3))}),
    lambda table: table.lines(np.zeros((2, 3)), pixel_size_um=0)])
def test_what_is_no_switch_no_text_no_number_is_refused_in_a_line(call, table):
    with pytest.raises(UserError) as caught:
        call(table)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 1100


SMALL = {"channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
         "cell": {"bulk": {"law": "linear"}},
         "table": {"identifier": "SMALL", "min_area_um2": 60, "max_area_um2": 120, "max_deformation": 0.01, "radii": 5,
                   "rows_per_radius": 20, "accuracy": 1e-3}}


def test_a_table_is_computed_in_a_folder(tmp_path):
    """Its moduli are those of direct solves; a second call goes on, here: has nothing left to do."""
    fractions = []
    made = rheocyte.table(SMALL, tmp_path / "small", progress=fractions.append)
    assert made.identifier == "SMALL" and fractions[-1] == 1
    state = rheocyte.solve(radius_um=5.3, young_modulus_kPa=6, cell__bulk__law="linear", **WATERY)
    found = made.modulus(state.area_um2, state.deformation, **SMOOTH)
    assert found.young_modulus_kPa == pytest.approx(6, rel=5e-3)
    fractions.clear()
    again = rheocyte.table(SMALL, tmp_path / "small", progress=fractions.append)
    assert set(fractions) == {1} and again.modulus(80, 0.005, **SMOOTH) == made.modulus(80, 0.005, **SMOOTH)
    with pytest.raises(UserError, match="was begun as"):
        rheocyte.table(SMALL, tmp_path / "small", table__radii=6)


@pytest.mark.parametrize("spec, words", [
    ({**SMALL, "table": {**SMALL["table"], "radius": 3}}, "table.radius"), ("nowhere.toml", "nowhere.toml"), (5, "not a spec"),
    ({**SMALL, "table": {**SMALL["table"], "radii": float("nan")}}, "nan"), ({"table": {"radii": object()}}, "object")])
def test_what_is_no_spec_is_refused(spec, words, tmp_path):
    with pytest.raises(UserError, match=words):
        rheocyte.table(spec, tmp_path / "table")
    assert not (tmp_path / "table").exists()
