"""The real dclab and rheocyte in one process: the same numbers from published tables, features and viscosities."""

import subprocess

import numpy as np
import pytest

import rheocyte
from conftest import REFERENCE

dclab = pytest.importorskip("dclab", reason="dclab is not installed", exc_type=ImportError)
emodulus = pytest.importorskip("dclab.features.emodulus")
ndimage = pytest.importorskip("scipy.ndimage")

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
    assert np.isfinite(theirs).any() and np.isnan(ours.standard_error_kPa).all()


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


def plugin_file(folder):
    from rheocyte import dclab_plugin

    target = folder / "rheocyte_modulus.py"
    with open(dclab_plugin.__file__, encoding="utf-8") as source:
        target.write_text(source.read())
    return target


def invented(medium="CellCarrier", region="channel"):
    rng = np.random.default_rng(2)
    dataset = dclab.new_dataset({"area_um": rng.uniform(40, 200, 500), "deform": rng.uniform(0.005, 0.1, 500)})
    dataset.config["setup"].update({"channel width": 20, "flow rate": 0.04, "medium": medium, "temperature": 23.5,
                                    "chip region": region})
    dataset.config["imaging"]["pixel size"] = 0.34
    return dataset


@pytest.fixture
def plugin(tmp_path):
    from dclab.rtdc_dataset.feat_anc_plugin import plugin_feature

    loaded = dclab.load_plugin_feature(plugin_file(tmp_path))
    yield
    for feature in loaded:
        plugin_feature.remove_plugin_feature(feature)


def test_the_plugin_gives_dclab_the_moduli_of_the_table(plugin):
    dataset = invented()
    table = rheocyte.Table.for_medium("CellCarrier", temperature_C=23.5)
    expected = table.modulus(dataset["area_um"], dataset["deform"], channel_width_um=20, flow_rate_ul_s=0.04,
                             medium="CellCarrier", temperature_C=23.5, pixel_size_um=0.34)
    same(dataset["rheocyte_modulus"], expected.young_modulus_kPa)
    same(dataset["rheocyte_modulus_error"], expected.standard_error_kPa)
    assert np.array_equal(dataset["rheocyte_state"], expected.state)


def test_the_command_prints_the_plugin(program, tmp_path):
    said = subprocess.run([program, "dclab-plugin"], capture_output=True, check=True).stdout
    assert said == plugin_file(tmp_path).read_bytes()


@pytest.mark.parametrize("dataset", [{"medium": "other"}, {"region": "reservoir"}])
def test_the_plugin_offers_nothing_where_it_has_nothing(plugin, dataset):
    assert "rheocyte_modulus" not in invented(**dataset)


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


MEASURED = ({"width": 20, "rate": 0.04, "mPas": 15}, {"width": 20, "rate": 0.12, "mPas": 5.7},
            {"width": 30, "rate": 0.16, "mPas": 3.5}, {"width": 15, "rate": 0.032, "mPas": 10},
            {"width": 40, "rate": 1.2, "mPas": 1.1}, {"width": 20, "rate": 0.06, "medium": "CellCarrier", "degC": 23},
            {"width": 30, "rate": 0.24, "medium": "CellCarrierB", "degC": 24.5},
            {"width": 20, "rate": 0.06, "medium": "CellCarrier", "degC": 22, "model": "herold-2017"},
            {"width": 15, "rate": 0.016, "medium": "CellCarrierB", "degC": 21, "model": "herold-2017"},
            {"width": 20, "rate": 0.04, "medium": "water", "degC": 25})


def their_moduli(path, table, width, rate, mPas=None, medium=None, degC=None, model="buyukurganci-2022"):
    with dclab.new_dataset(path) as dataset:
        area, deform = np.array(dataset["area_um"]), np.array(dataset["deform"])
        pixel = dataset.config["imaging"].get("pixel size", 0.34)
    model = None if mPas else "kestin-1978" if medium == "water" else model
    return emodulus.get_emodulus(area_um=area, deform=deform, medium=mPas or medium, channel_width=width,
                                 flow_rate=rate, px_um=pixel, temperature=degC, lut_data=table, visc_model=model)


def our_moduli(path, table, width, rate, mPas=None, medium=None, degC=None, model=None):
    return rheocyte.extract(path, table=table, channel_width_um=width, flow_rate_ul_s=rate, viscosity_mPas=mPas,
                            medium=medium, temperature=degC, viscosity_model=model)["young_modulus_kPa"].to_numpy()


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("table", ["LE-2D-FEM-19", "HE-2D-FEM-22", "HE-3D-FEM-22"])
@pytest.mark.parametrize("path", WITH_EVENTS)
def test_moduli_of_recordings_are_those_of_dclab(path, table):
    """Ten ways to measure, by published tables: the same events without a modulus, the others equal to 1e-6."""
    with dclab.new_dataset(path) as dataset:
        if "area_um" not in dataset or "deform" not in dataset:
            pytest.skip(f"{path.name} holds no area or deformation")
    for measured in MEASURED:
        same(our_moduli(path, table, **measured), their_moduli(path, table, **measured))
