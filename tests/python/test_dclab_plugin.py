"""The plugin file for dclab and DCscope, where rheocyte is not installed: the moduli of `rheocyte extract`."""

import os
import subprocess
import sys

import numpy as np
import pytest

import rheocyte
from conftest import TOP

dclab = pytest.importorskip("dclab", reason="dclab is not installed", exc_type=ImportError)
CASES = TOP.parent / "shared" / "cases"
FEATURES = ["rheocyte_modulus", "rheocyte_modulus_error", "rheocyte_state", "rheocyte_shape_excess", "rheocyte_recommended"]

# Put before a script: as if rheocyte were not installed.
ALONE = """
import sys

class Missing:
    def find_spec(self, name, *rest):
        if name.split(".")[0] == "rheocyte":
            raise ModuleNotFoundError(f"No module named {name!r}")

sys.meta_path.insert(0, Missing())
"""


@pytest.fixture(scope="module")
def plugin_file(program, tmp_path_factory):
    file = tmp_path_factory.mktemp("plugin") / "rheocyte_modulus.py"
    file.write_bytes(subprocess.run([program, "dclab-plugin"], capture_output=True, check=True).stdout)
    return file


@pytest.fixture(scope="module")
def plugin(plugin_file):
    """The module of the plugin, which dclab has loaded."""
    from dclab.rtdc_dataset.feat_anc_plugin import plugin_feature

    searched = sys.path.copy()
    loaded = dclab.load_plugin_feature(plugin_file)
    sys.path[:] = searched  # of which dclab takes the first one away
    yield sys.modules[plugin_file.stem]
    for feature in loaded:
        plugin_feature.remove_plugin_feature(feature)


def recording(file, *, medium="CellCarrier", width=20, rate=0.04, temperature=None, user=None, events=3000):
    """Areas and deformations all over the tables and beyond, temperatures of each event unless one is given."""
    rng = np.random.default_rng(7)
    area = np.exp(rng.uniform(np.log(20), np.log(400), events)) * (width / 20) ** 2
    deformation = np.exp(rng.uniform(np.log(1e-3), np.log(0.12), events))
    deformation[::50] *= -1
    area[5] = deformation[6] = np.nan
    metadata = {"experiment": {"event count": events, "sample": "made", "run index": 1, "date": "2026-11-25",
                               "time": "12:00:00"},
                "setup": {"channel width": width, "flow rate": rate, "medium": medium, "chip region": "channel"},
                "imaging": {"pixel size": 0.34}, "user": user or {}}
    if temperature:
        metadata["setup"]["temperature"] = temperature
    with dclab.RTDCWriter(file, mode="reset") as writer:
        writer.store_metadata(metadata)
        writer.store_feature("area_um", area)
        writer.store_feature("deform", deformation)
        writer.store_feature("inert_ratio_cvx", rng.uniform(0.9, 1.6, events))
        if not temperature:  # where the sensor fails it says 0
            writer.store_feature("temp", np.where(rng.uniform(size=events) < 0.02, 0, rng.normal(24, 1, events)))
    return file


def extracted(file, **options):
    """What `rheocyte extract` says, in the order of the features."""
    frame = rheocyte.extract(file, **options)
    states = np.array([rheocyte.STATES.index(str(state).replace("_", " ")) for state in frame["state"]])
    return [frame["young_modulus_kPa"].to_numpy(), frame["young_modulus_kPa_error"].to_numpy(), states,
            frame["shape_excess"].to_numpy()]


def same(dataset, expected):
    """The same events without a modulus. Tables in single precision leave 1e-6 of the modulus and, as the slope of the
    table's error is not smooth, 1e-4 of the standard error."""
    modulus, error, state, excess = (np.array(dataset[name]) for name in FEATURES[:4])
    assert np.array_equal(state, expected[2])
    assert np.allclose(modulus, expected[0], rtol=1e-5, atol=0, equal_nan=True)
    assert np.allclose(error, expected[1], rtol=1e-3, atol=0, equal_nan=True)
    assert np.allclose(excess, expected[3], rtol=0, atol=1e-5, equal_nan=True)


def test_the_file_works_where_rheocyte_is_not_installed(plugin_file, tmp_path):
    """A recording with moduli and one without; features of other programs stay there."""
    recording(tmp_path / "cells.rtdc")
    recording(tmp_path / "other.rtdc", medium="other")
    script = ALONE + f"""
import dclab
dclab.load_plugin_feature({str(plugin_file)!r})
with dclab.new_dataset("cells.rtdc") as cells, dclab.new_dataset("other.rtdc") as other:
    assert "area_um" in cells and "rheocyte_modulus" in cells.features_scalar
    assert len(cells["rheocyte_modulus"]) == 3000 and (cells["rheocyte_modulus"] > 0).sum() > 1000
    assert "area_um" in other and "area_um" in other.features_scalar and "rheocyte_modulus" not in other
assert not any(name.split(".")[0] == "rheocyte" for name in sys.modules)
"""
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=True)


def test_the_command_prints_what_the_package_writes(plugin_file, tmp_path):
    written = rheocyte.dclab_plugin(tmp_path / "plugin.py")
    assert written.read_bytes() == plugin_file.read_bytes()
    rheocyte.dclab_plugin(written)
    written.write_text("somebody's own plugin")
    with pytest.raises(rheocyte.UserError):
        rheocyte.dclab_plugin(written)


@pytest.mark.parametrize("name", [
    "CellCarrier", "Cell Carrier-B", "0.5%", "0,60 % (w/v) MC in PBS", "0.8% methyl cellulose", "0.49 MC-PBS", "0.8% Ficoll",
    "0.7% MC", "-0.5%", "MC0.5%", "PBS 0.5%", "0.5% 0.6% MC", "Water ", "H2O", ""])
def test_media_are_known_by_the_same_names(plugin, name):
    measured = {"channel_width_um": 20, "flow_rate_ul_s": 0.04, "temperature_C": 23}
    found = plugin.known_medium(name)
    if found is None:
        with pytest.raises(rheocyte.UserError):
            rheocyte.viscosity(name, **measured)
    else:
        assert rheocyte.viscosity(name, **measured) == rheocyte.viscosity(found, **measured)


@pytest.mark.parametrize("made", [
    {}, {"temperature": 30}, {"medium": "CellCarrierB", "temperature": 23}, {"medium": "0.83% MC-PBS"},
    {"medium": "0,60 % (w/v) MC in PBS", "width": 30, "rate": 0.16}, {"medium": "water", "temperature": 25},
    {"medium": "water", "width": 30, "rate": 0.16, "temperature": 25},
    {"medium": "other", "user": {"rheocyte viscosity_mPas": 7.5}}], ids=str)
def test_moduli_are_those_of_extract(plugin, tmp_path, made):
    file = recording(tmp_path / "cells.rtdc", **made)
    with dclab.new_dataset(file) as dataset:
        same(dataset, extracted(file))
        assert np.isfinite(dataset["rheocyte_modulus"]).sum() > 1000


SETTINGS = [
    ({"emodulus temperature": 30.0}, {"temperature": 30}),
    ({"emodulus medium": "CellCarrierB"}, {"medium": "CellCarrierB"}),
    ({"emodulus medium": "0.83% MC-PBS", "emodulus temperature": 35.0}, {"medium": "0.83% MC-PBS", "temperature": 35}),
    ({"emodulus viscosity": 5.0}, {"viscosity_mPas": 5}),
    ({"emodulus viscosity": 5.0, "emodulus medium": "other"}, {"viscosity_mPas": 5}),
    ({"emodulus viscosity model": "herold-2017"}, {"viscosity_model": "herold-2017"}),
    ({"emodulus medium": "CellCarrierB", "emodulus viscosity model": "herold-2017"},
     {"medium": "CellCarrierB", "viscosity_model": "herold-2017"}),
    ({"emodulus lut": "HE-3D-26"}, {"table": "HE-3D-26"}),
    ({"emodulus lut": "LE-2D-FEM-19", "emodulus temperature": float("nan")}, {}),
]


@pytest.mark.filterwarnings("ignore")
def test_moduli_follow_the_settings_of_dclab(plugin, tmp_path):
    """One after the other in one dataset: nothing of the settings before is left."""
    file = recording(tmp_path / "cells.rtdc")
    with dclab.new_dataset(file) as dataset:
        for settings, options in SETTINGS:
            dataset.config["calculation"].clear()
            dataset.config["calculation"].update(settings)
            same(dataset, extracted(file, **options))


@pytest.mark.parametrize("settings", [
    {"emodulus medium": "other"}, {"emodulus medium": "ketchup"}, {"emodulus temperature": 296.15},
    {"emodulus viscosity": 0.005}, {"emodulus viscosity model": "nobody-1900"},
    {"emodulus medium": "0.83% MC-PBS", "emodulus viscosity model": "herold-2017"}], ids=str)
def test_there_is_no_feature_for_settings_that_cannot_be(plugin, tmp_path, settings):
    with dclab.new_dataset(recording(tmp_path / "cells.rtdc")) as dataset:
        assert "rheocyte_modulus" in dataset
        dataset.config["calculation"].update(settings)
        assert "rheocyte_modulus" not in dataset and "area_um" in dataset.features_scalar


def test_a_recording_without_temperature_gets_its_moduli_from_the_settings(plugin):
    file = CASES / "no-temperature.rtdc"
    if not file.exists():
        pytest.skip("../shared/cases is not there")
    with dclab.new_dataset(file) as dataset:
        assert "rheocyte_modulus" not in dataset
        dataset.config["calculation"]["emodulus temperature"] = 23
        same(dataset, extracted(file, temperature=23))
        assert np.isfinite(dataset["rheocyte_modulus"]).sum() == 30
    with dclab.new_dataset(CASES / "reservoir.rtdc") as dataset:
        assert "rheocyte_modulus" not in dataset


def test_inertia_ratios_are_measured_in_masks(plugin, tmp_path):
    """Where none are stored; dclab measures them as rheocyte does, but in double precision."""
    file = tmp_path / "cells.rtdc"
    rheocyte.synth({"recording": {"cells": 20, "seed": 3}, "channel": {"width_um": 20},
                    "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
                    "cell": {"radius_um": {"mean": 6}, "bulk": {"young_modulus_kPa": {"mean": 3}}}}, file)
    with dclab.new_dataset(file) as dataset:
        excess = np.array(dataset["rheocyte_shape_excess"])
        bare = dclab.new_dataset({name: dataset[name][:] for name in ("area_um", "deform", "mask", "pos_x", "pos_y")})
        for section in ("setup", "imaging", "user"):
            bare.config[section].update(dataset.config[section])
        assert np.isfinite(excess).all()
        assert np.allclose(bare["rheocyte_shape_excess"], excess, rtol=0, atol=1e-5)


VIRTUAL = {"recording": {"cells": 100, "seed": 3}, "channel": {"width_um": 20},
           "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
           "cell": {"radius_um": {"mean": 6, "sd": 0.3}, "bulk": {"young_modulus_kPa": {"mean": 3, "sd": 0.3}}}}


@pytest.mark.parametrize("tension", [0, 400])
def test_the_recommended_number_of_a_companion_is_that_of_extract(plugin, program, tmp_path, tension):
    """Other recordings have none: of elongated cells E from deformation is far too low, and masks show more of round ones."""
    rheocyte.synth(VIRTUAL, tmp_path / "cells.rtdc", flow__axial_tension_Pa=tension)
    recommended = rheocyte.extract(tmp_path / "cells.rtdc").attrs["recommended"]
    subprocess.run([program, "extract", "cells.rtdc", "-o", "out", "--quiet"], cwd=tmp_path, check=True)
    with dclab.new_dataset(tmp_path / "out/cells_rheocyte.rtdc") as dataset:
        assert (dataset["rheocyte_recommended"][:] == recommended["young_modulus_median_kPa"]).all()
    assert abs(recommended["young_modulus_median_kPa"] / 3 - 1) < 0.1  # 100 cells that scatter by 10 %: 1.3 %; masks 3 %
    with dclab.new_dataset(tmp_path / "cells.rtdc") as dataset:
        assert np.isnan(dataset["rheocyte_recommended"]).all()


def test_a_plugin_function_never_raises(plugin, monkeypatch, tmp_path):
    """Whatever is wrong: dclab would fail with any feature of any recording."""
    def broken(*_):
        raise RuntimeError("an error of the plugin")

    nonsense = dclab.new_dataset({"area_um": np.ones(3), "deform": np.ones(3)})
    nonsense.config["setup"].update({"channel width": np.nan, "flow rate": -1, "medium": "", "chip region": "channel"})
    assert plugin.can_compute(nonsense) is False and plugin.can_compute(None) is False
    assert np.array_equal(plugin.compute(nonsense)["rheocyte_state"], np.ones(3))
    with dclab.new_dataset(recording(tmp_path / "cells.rtdc", events=10)) as dataset:
        monkeypatch.setattr(plugin, "moduli_of", broken)
        assert np.isnan(dataset["rheocyte_modulus"]).all() and (dataset["rheocyte_state"] == 1).all()


DCSCOPE = ALONE + """
import os
import numpy as np
from PyQt6 import QtCore, QtWidgets

recording, plugin = sys.argv[1], sys.argv[2:]
app = QtWidgets.QApplication([])
from dcscope.gui.main import DCscope

failures = []
sys.excepthook = lambda *error: failures.append(error)
QtWidgets.QMessageBox.warning = QtWidgets.QMessageBox.critical = lambda *said: failures.append(said)
QtCore.QCoreApplication.setOrganizationName("DC-analysis")
QtCore.QCoreApplication.setApplicationName("dcscope")
QtCore.QSettings.setDefaultFormat(QtCore.QSettings.Format.IniFormat)
QtCore.QSettings().setValue("check for updates", 0)
window = DCscope()
for file in plugin:
    window.extensions.import_extension_from_path(file)
window.add_dataslot(paths=[recording])
slot, = window.pipeline.slots
medians = []
for settings in ({}, {"emodulus scenario": "manual", "emodulus temperature": 30.0}, {"emodulus medium": "CellCarrierB"}):
    state = slot.__getstate__()
    state["emodulus"].update(settings)
    slot.__setstate__(state)
    medians.append(str(np.nanmedian(slot.get_dataset()["rheocyte_modulus"])))
app.processEvents()
print(failures, file=sys.stderr)
print(len(failures), *medians, flush=True)
os._exit(0)  # threads of DCscope go on
"""


def test_dcscope_takes_the_file_and_still_has_it_after_a_restart(plugin_file, tmp_path):
    pytest.importorskip("dcscope", reason="DCscope is not installed", exc_type=ImportError)
    file = recording(tmp_path / "cells.rtdc")
    expected = [np.nanmedian(extracted(file, **options)[0])
                for options in ({}, {"temperature": 30}, {"medium": "CellCarrierB", "temperature": 30})]
    environment = {**os.environ, "HOME": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"}
    for folder in ("CONFIG", "DATA", "CACHE"):
        environment[f"XDG_{folder}_HOME"] = str(tmp_path / folder.lower())
    for given in ([plugin_file], []):
        ran = subprocess.run([sys.executable, "-c", DCSCOPE, file, *given], env=environment, cwd=tmp_path, check=True,
                             capture_output=True, text=True)
        failures, *medians = ran.stdout.splitlines()[-1].split()
        assert failures == "0", ran.stderr
        assert np.allclose([float(median) for median in medians], expected, rtol=1e-5)
