"""Which pixels of the edge a mask contains changes moduli by no more than the common error that is stated."""

import importlib.util

import numpy as np
import pytest
from conftest import TOP

pytest.importorskip("h5py")
pytest.importorskip("dclab")


@pytest.fixture(scope="module")
def drawing():
    """The renderer of bench/independent_recordings.py, which shares no line with the program's own."""
    spec = importlib.util.spec_from_file_location("independent_recordings", TOP / "bench/independent_recordings.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def line_of(drawing, program, file, setup, masks, keep_masks):
    """The summary of 400 cells of one deformation, whose radii cover a pixel."""
    random = np.random.default_rng(1)
    angles = np.linspace(0, 2 * np.pi, drawing.ANGLES, endpoint=False)
    shape = 1 + np.sqrt(setup.deformation / 2) * np.cos(3 * angles)  # d = 2 c3^2 of a small third mode
    radii = setup.radius_um / drawing.PIXEL_UM + np.linspace(-0.5, 0.5, 400)
    pictures = np.array([drawing.mask(radius * shape, 0, 32 + random.uniform(-0.5, 0.5, 2), (64, 64), masks) for radius in radii])
    drawing.write(file, setup, pictures, keep_masks)
    return drawing.extract(program, file, setup)


@pytest.mark.parametrize("deformation", [0.004, 0.012])
def test_the_common_error_holds_what_another_rule_for_the_edge_does(drawing, program, tmp_path, deformation):
    setup = drawing.Setup(0, "round", 20, "", 23, 10, 6.4, deformation, 0)
    lines = [line_of(drawing, program, tmp_path / f"{masks}.rtdc", setup, masks, keep_masks=False) for masks in ("centre", "samples")]
    moduli = [drawing.number(line, "young_modulus_median_kPa") for line in lines]
    common = drawing.number(lines[0], "recommended_young_modulus_median_kPa_common_error")
    assert lines[0]["recommended_modulus"] == "deformation"
    assert 0 < moduli[0] - moduli[1] < common  # smaller masks have a greater deformation


def test_half_covered_pixels_do_not_change_the_mean_deformation(drawing):
    # Of a straight edge a pixel is covered by half when its centre lies on it; what is left is the curvature's.
    random = np.random.default_rng(2)
    outlines = [np.full(drawing.ANGLES, 19 + random.uniform(-0.5, 0.5)) for _ in range(100)]
    places = 22 + random.uniform(-0.5, 0.5, (100, 2))
    by_coverage, by_centre = ([drawing.features(drawing.mask(outline, 0, place, (44, 44), masks))["deform"]
                               for outline, place in zip(outlines, places)] for masks in ("coverage", "centre"))
    assert abs(np.mean(by_coverage) - np.mean(by_centre)) < 5e-5  # 100 times less than pixels do; measured 1e-5
