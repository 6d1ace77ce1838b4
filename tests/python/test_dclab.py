"""The real dclab and rheocyte in one process: the same numbers from published tables, features and viscosities."""

import os
import subprocess

import numpy as np
import pytest

import rheocyte
from conftest import REFERENCE

dclab = pytest.importorskip("dclab", reason="dclab is not installed", exc_type=ImportError)
emodulus = pytest.importorskip("dclab.features.emodulus")
ndimage = pytest.importorskip("scipy.ndimage")
dclab_parity = pytest.importorskip("dclab_parity")

WITH_EVENTS = []
for path in sorted((REFERENCE / "rtdc").glob("*.rtdc")):
    WITH_EVENTS.append(pytest.param(path, id=path.name))


def same(a, b):
    """Both NaN, or equal to 1e-6, the parity that is promised."""
    assert np.array_equal(np.isnan(a), np.isnan(b))
    assert np.allclose(a, b, rtol=1e-6, atol=0, equal_nan=True)


@pytest.mark.parametrize("name, width, rate, mPas, pixel", [
    ("LE-2D-FEM-19", 20, 0.04, 15, 0), ("LE-2D-FEM-19", 30, 0.16, 3.5, 0.34), ("HE-2D-FEM-22", 15, 0.02, 6, 0.34)])
def test_published_tables_give_what_dclab_gives(name, width, rate, mPas, pixel):
    rng = np.random.default_rng(19)
    scale = (width / 20) ** 2
    area, deform = rng.uniform(10, 300, 5000) * scale, rng.uniform(-0.01, 0.25, 5000)
    theirs = emodulus.get_emodulus(area_um=area, deform=deform, medium=mPas, channel_width=width, flow_rate=rate,
                                   px_um=pixel, temperature=None, lut_data=name)
    ours = rheocyte.Table(name).modulus(area, deform, channel_width_um=width, flow_rate_ul_s=rate, viscosity_mPas=mPas,
                                        pixel_size_um=pixel)
    same(ours.young_modulus_kPa, theirs)
    assert np.isfinite(theirs).any() and np.isnan(ours.young_modulus_kPa_error).all()


@pytest.mark.parametrize("medium", ["CellCarrier", "CellCarrierB", "water"])
def test_viscosities_are_those_of_dclab(medium):
    celsius = np.linspace(20, 30, 11)
    theirs = emodulus.viscosity.get_viscosity(medium=medium, channel_width=20, flow_rate=0.06, temperature=celsius,
                                              model="buyukurganci-2022" if medium != "water" else "kestin-1978")
    ours = rheocyte.viscosity(medium, channel_width_um=20, flow_rate_ul_s=0.06, temperature_C=celsius)
    same(ours, theirs)


@pytest.mark.parametrize("path", WITH_EVENTS)
def test_features_of_masks_are_those_of_dclab(path):
    """Of masks of one group of pixels: which of several outlines is the longest is counted in different ways."""
    with dclab.new_dataset(path) as dataset:
        if "mask" not in dataset.features_innate:
            pytest.skip(f"{path.name} holds no masks")
        masks = [np.asarray(dataset["mask"][i], dtype=bool) for i in range(len(dataset["mask"]))]
    masks = np.array([mask for mask in masks if ndimage.label(mask, np.ones((3, 3)))[1] == 1])
    if not len(masks):
        pytest.skip(f"{path.name} holds no mask of one group")
    ours = rheocyte.features(masks, 0.34)
    contours = list(dclab.features.contour.get_contour(masks))
    theirs = dclab.features.inert_ratio
    same(ours["inert_ratio_cvx"].to_numpy(), np.array(theirs.get_inert_ratio_cvx(contours)))
    same(ours["inert_ratio_raw"].to_numpy(), np.array(theirs.get_inert_ratio_raw(contours)))
    same(ours["inert_ratio_prnc"].to_numpy(), np.array(theirs.get_inert_ratio_prnc(contours)))
    volume = dclab.features.volume.get_volume(contours, ours["pos_x"].to_numpy(), ours["pos_y"].to_numpy(), 0.34)
    same(ours["volume"].to_numpy(), volume)


SHAPES = ("area_cvx", "area_msd", "area_ratio", "area_um", "area_um_raw", "aspect", "circ", "deform", "deform_raw",
          "eccentr_prnc", "inert_ratio_cvx", "inert_ratio_prnc", "inert_ratio_raw", "per_ratio", "per_um_raw", "pos_x",
          "pos_y", "size_x", "size_y", "tilt", "volume")


@pytest.mark.parametrize("path", WITH_EVENTS)
def test_features_from_masks_are_those_that_recordings_store(program, path, tmp_path):
    """In single precision, as far as recordings store them; dclab finds nothing to complain of in the companion."""
    with dclab.new_dataset(path) as dataset:
        masks = dataset["mask"][:len(dataset)] if "mask" in dataset.features_innate else []
        one_group = [ndimage.label(np.asarray(mask, dtype=bool), np.ones((3, 3)))[1] == 1 for mask in masks]
        stored = {name: np.array(dataset[name]) for name in SHAPES if name in dataset.features_innate}
    if not any(one_group):
        pytest.skip(f"{path.name} holds no mask of one group")
    subprocess.run([program, "features", path, "-o", tmp_path, "--quiet"], check=True)
    companion = tmp_path / f"{path.stem}_features_rheocyte.rtdc"
    with dclab.new_dataset(companion) as dataset:
        for name, values in stored.items():
            assert np.allclose(np.array(dataset[name])[one_group], values[one_group], rtol=1e-6, atol=1e-6), name
        assert set(SHAPES) <= set(dataset.features_innate)
    complaints = [dclab.rtdc_dataset.check.check_dataset(file)[:2] for file in (path, companion)]
    for before, after in zip(*complaints):
        assert set(after) <= set(before)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """Virtual cells, smaller and larger than the tables, stiffer and softer."""
    file = tmp_path_factory.mktemp("recorded") / "cells.rtdc"
    rheocyte.synth({"recording": {"cells": 300, "seed": 11}, "channel": {"width_um": 20},
                    "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
                    "cell": {"radius_um": {"mean": 6, "sd": 1.5}, "bulk": {"young_modulus_kPa": {"mean": 5, "sd": 2}}}}, file)
    return file


@pytest.fixture(scope="module")
def pooled(recorded):
    """Recordings by the size of their pixels: dclab triangulates a table again in each call, but asks each event on its own."""
    by_pixel = {}
    for path in [recorded, *(value for parameter in WITH_EVENTS for value in parameter.values)]:
        if dclab_parity.has_events(path):
            by_pixel.setdefault(dclab_parity.pixel_size(path), []).append(path)
    return by_pixel


def ways_to_measure(number, at_once):
    """`at_once` of the ten in turns, all with --all."""
    ways = dclab_parity.MEASURED
    return ways if "RHEOCYTE_ALL" in os.environ else [ways[(at_once * number + i) % len(ways)] for i in range(at_once)]


def same_moduli(table, paths, pixel, ways):
    area, deform = (np.concatenate(columns) for columns in zip(*map(dclab_parity.events, paths)))
    for measured in ways:
        ours = [dclab_parity.our_moduli(path, table, **measured) for path in paths]
        same(np.concatenate(ours), dclab_parity.their_moduli(area, deform, pixel, table, **measured))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("table", dclab_parity.PUBLISHED)
def test_moduli_of_recordings_are_those_of_dclab(table, pooled):
    """By published tables the same events without a modulus, the others equal to 1e-6. Every recording is measured in all
    ten ways by some table. dclab_parity.py does the same with any recordings."""
    for number, (pixel, paths) in enumerate(pooled.items()):
        turn = len(dclab_parity.PUBLISHED) * number + dclab_parity.PUBLISHED.index(table)
        same_moduli(table, paths, pixel, ways_to_measure(turn, 4))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("number, table", enumerate(rheocyte.table_names()))
def test_moduli_by_texts_of_our_tables_are_those_of_dclab(number, table, recorded):
    """The same for virtual cells by the texts of our own; every five tables are asked in all ten ways."""
    pixel = dclab_parity.pixel_size(recorded)
    same_moduli(dclab_parity.tables()[table], [recorded], pixel, ways_to_measure(number, 2))


@pytest.mark.parametrize("name", rheocyte.table_names())
def test_dclab_takes_the_texts_of_our_tables(name):
    """Registered under their names, they give our moduli as far as straight lines between their rows do."""
    files = rheocyte.Table(name).texts()
    emodulus.load.register_lut(files.table)
    rng = np.random.default_rng(4)
    greatest = min(0.04, 0.9 * np.loadtxt(files.table)[:, 1].max())  # triangles along the border are long
    area, deform = rng.uniform(50, 150, 500), rng.uniform(0.005, greatest, 500)
    theirs = emodulus.get_emodulus(area_um=area, deform=deform, medium=15, channel_width=20, flow_rate=0.04, px_um=0,
                                   temperature=None, lut_data=name)
    ours = rheocyte.Table(name).modulus(area, deform, channel_width_um=20, flow_rate_ul_s=0.04, viscosity_mPas=15,
                                        pixel_size_um=0)
    has = np.isfinite(ours.young_modulus_kPa) & np.isfinite(theirs)
    assert has.mean() > 0.9
    assert np.abs(theirs[has] / ours.young_modulus_kPa[has] - 1).max() < 2e-3
    lines = dclab.isoelastics.Isoelastics([files.lines])
    shown = lines.get(col1="area_um", col2="deform", channel_width=20, method=None, lut_identifier=name)
    assert len(shown) > 5 and all(len(line) > 1 for line in shown)


def test_companions_and_recordings_of_ours_are_in_order_for_dclab(program, recorded, tmp_path):
    """No new complaint of any level; the companion shows what it computed and, by its basin, what was recorded."""
    before = dclab.rtdc_dataset.check.check_dataset(recorded)
    subprocess.run([program, "extract", recorded, "-o", tmp_path, "--quiet"], check=True)
    companion = tmp_path / "cells_rheocyte.rtdc"
    for old, new in zip(before, dclab.rtdc_dataset.check.check_dataset(companion)):
        assert set(new) <= set(old)
    frame = rheocyte.extract(recorded)
    with dclab.new_dataset(companion) as dataset:
        same(np.array(dataset["emodulus"]), frame["young_modulus_kPa"].to_numpy())
        assert len(dataset["mask"]) == len(dataset) == len(frame)


def test_a_companion_is_complete_without_its_recording(program, recorded, tmp_path):
    moved = tmp_path / "cells.rtdc"
    moved.write_bytes(recorded.read_bytes())
    subprocess.run([program, "extract", moved, "-o", tmp_path, "--quiet"], check=True)
    with dclab.new_dataset(moved) as dataset:
        features = rheocyte.features(np.array(dataset["mask"][:len(dataset)]), dataset.config["imaging"]["pixel size"])
    moved.unlink()
    with dclab.new_dataset(tmp_path / "cells_rheocyte.rtdc") as dataset:
        named = dataset.config["user"]["rheocyte young_modulus_kPa_error"]
        assert {"emodulus", "area_um", "deform", named} <= set(dataset.features_innate)
        for name in ("volume", "inert_ratio_cvx", "inert_ratio_prnc", "inert_ratio_raw"):
            same(np.array(dataset[name]), features[name].to_numpy())


@pytest.fixture(scope="module")
def in_a_buffer(tmp_path_factory):
    """Virtual cells with masks in a medium whose viscosity depends on the temperature."""
    file = tmp_path_factory.mktemp("in-a-buffer") / "cells.rtdc"
    rheocyte.synth({"recording": {"cells": 80, "seed": 7}, "channel": {"width_um": 20},
                    "flow": {"rate_ul_per_s": 0.04, "medium": "CellCarrier", "temperature_C": {"mean": 23, "sd": 0.3}},
                    "cell": {"radius_um": {"mean": 5.8, "sd": 0.4}, "bulk": {"young_modulus_kPa": {"mean": 1.2, "sd": 0.2}}}},
                   file)
    return file


def child_of(dataset, **ranges):
    for feature, ends in ranges.items():
        for end, value in zip(("min", "max"), ends):
            dataset.config["filtering"][f"{feature} {end}"] = value
    dataset.apply_filter()
    return dclab.new_dataset(dataset)


def same_frames(a, b):
    pytest.importorskip("pandas").testing.assert_frame_equal(a.reset_index(drop=True), b.reset_index(drop=True))


def test_an_open_dataset_is_read_as_its_file(in_a_buffer):
    whole = rheocyte.extract(in_a_buffer)
    with dclab.new_dataset(in_a_buffer) as dataset:
        frame = rheocyte.extract(dataset)
    same_frames(frame, whole)
    assert frame.attrs == whole.attrs


def test_the_rows_of_a_child_are_its_events(in_a_buffer):
    """Also of a child of a child; with the outlines of these events, not of others."""
    whole = rheocyte.extract(in_a_buffer)
    with dclab.new_dataset(in_a_buffer) as dataset:
        child = child_of(dataset, area_um=(90, 120))
        inside = whole["area_um2"].between(90, 120)
        assert 0 < len(child) == inside.sum() < len(whole)
        frame = rheocyte.extract(child)
        same_frames(frame, whole[inside])
        assert np.isfinite(frame["mode_3"]).all() and "dataset.rtdc" not in str(frame.attrs)
        grandchild = child_of(child, deform=(float(np.median(child["deform"])), 1))
        same_frames(rheocyte.extract(grandchild), whole[inside & (whole["deformation"] >= np.median(child["deform"]))])
        with pytest.raises(rheocyte.UserError, match="no events"):
            rheocyte.extract(child_of(child, deform=(0.9, 1)))


def test_metadata_that_were_corrected_in_memory_count(in_a_buffer):
    with dclab.new_dataset(in_a_buffer) as dataset:
        dataset.config["setup"]["medium"] = "water"
        same_frames(rheocyte.extract(dataset), rheocyte.extract(in_a_buffer, medium="water"))
        child = child_of(dataset, area_um=(100, 1000))
        whole = rheocyte.extract(in_a_buffer, medium="water")
        same_frames(rheocyte.extract(child), whole[whole["area_um2"] >= 100])
        dataset.config["setup"].pop("flow rate")
        with pytest.raises(rheocyte.UserError, match="cells.rtdc: setup:flow rate is missing; give it with flow_rate_ul_s"):
            rheocyte.extract(dataset)
        assert len(rheocyte.extract(dataset, flow_rate_ul_s=0.04)) == len(whole)


def test_features_in_memory_may_be_gated(in_a_buffer):
    with dclab.new_dataset(in_a_buffer) as dataset:
        dclab.register_temporary_feature("my_choice")
        chosen = np.arange(len(dataset)) % 3
        dclab.set_temporary_feature(dataset, "my_choice", chosen)
        frame = rheocyte.extract(dataset, min={"my_choice": 2})
    assert ((frame["state"] == "gated") == (chosen < 2)).all()


def test_a_dataset_without_a_file_is_read_from_memory(in_a_buffer):
    """Of a dictionary, whole or filtered: as the file from which its features and metadata come."""
    whole = rheocyte.extract(in_a_buffer)
    with dclab.new_dataset(in_a_buffer) as dataset:
        features = {name: np.array(dataset[name]) for name in ("area_um", "deform", "temp")}
        from_memory = dclab.new_dataset({**features, "mask": np.array(dataset["mask"][:], dtype=bool)})
        for section in ("setup", "imaging"):
            from_memory.config[section].update(dataset.config[section])
    frame = rheocyte.extract(from_memory)
    same_frames(frame[list(whole)], whole)
    inside = whole["area_um2"] >= 100
    same_frames(rheocyte.extract(child_of(from_memory, area_um=(100, 1000))), frame[inside])
    from_memory.config["setup"].pop("channel width")
    with pytest.raises(rheocyte.UserError, match=r"the dataset .*: setup:channel width is missing"):
        rheocyte.extract(from_memory)


def test_polygon_filters_of_dclab_take_the_events_that_dclab_takes(program, in_a_buffer, tmp_path):
    """Two of them, one inverted, in one file, by the package and by the program."""
    dclab.PolygonFilter.clear_all_filters()
    corners = [[[80, 0], [130, 0], [130, 1], [105, 0.02], [80, 1]], [[0, 0.012], [105, 0.012], [105, 0.03], [0, 0.03]]]
    for points, inverted in zip(corners, (False, True)):
        dclab.PolygonFilter(axes=("area_um", "deform"), points=points, inverted=inverted)
    dclab.PolygonFilter.save_all(tmp_path / "two.poly")
    with dclab.new_dataset(in_a_buffer) as dataset:
        for each in dclab.PolygonFilter.instances:
            dataset.polygon_filter_add(each)
        dataset.apply_filter()
        inside = dataset.filter.all.copy()
    dclab.PolygonFilter.clear_all_filters()
    frame = rheocyte.extract(in_a_buffer, polygon=tmp_path / "two.poly")
    assert ((frame["state"] != "gated") == inside).all() and 0 < inside.sum() < len(inside)
    subprocess.run([program, "extract", in_a_buffer, "-o", tmp_path, "--quiet", "--polygon", tmp_path / "two.poly"], check=True)
    written = pytest.importorskip("pandas").read_csv(tmp_path / "cells_rheocyte.tsv", sep="\t", comment="#")
    assert list(written["state"] != "gated") == list(inside)


def test_a_dataset_whose_title_has_quotes_has_a_population():
    """The title stands in what is returned as it is; nothing is read from text."""
    rng = np.random.default_rng(4)
    with dclab.new_dataset({"area_um": 120 + 10 * rng.normal(size=60), "deform": 0.02 + 0.003 * rng.normal(size=60)}) as dataset:
        dataset.title = 'the "soft" \\ ones'
        dataset.config["setup"].update({"channel width": 20, "flow rate": 0.04, "chip region": "channel"})
        dataset.config["imaging"]["pixel size"] = 0.34
        found = rheocyte.population({"a": dataset}, by="deformation", viscosity_mPas=15)
    assert found.recordings["recording"].tolist() == [found.record["recordings"][0]["recording"]] == [f"the dataset {dataset.title}"]
