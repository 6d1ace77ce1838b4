"""The recommended modulus of HL60 samples with known treatments (Urbanska et al. 2020, latrunculin B and osmolarities)."""

import csv
import math
import subprocess

import pytest
from conftest import REFERENCE

DOSES = REFERENCE / "hl60-doses"

pytestmark = pytest.mark.skipif(not DOSES.is_dir(), reason="the samples with treatments are not beside this checkout")


@pytest.fixture(scope="module")
def lines(program, tmp_path_factory):
    """The summary of each sample, by its name."""
    folder = tmp_path_factory.mktemp("doses")
    subprocess.run([program, "extract", "--quiet", "-o", folder, *sorted(DOSES.glob("*.rtdc"))], check=True, capture_output=True)
    with open(folder / "rheocyte_summary.tsv", newline="", encoding="utf-8") as file:
        return {line["recording"].rpartition("/")[2].removesuffix(".rtdc"): line for line in csv.DictReader(file, delimiter="\t")}


def median(line):
    return float(line["recommended_young_modulus_median_kPa"] or "nan")


def test_no_modulus_is_recommended_from_fewer_than_half_of_the_cells(lines):
    assert len(lines) == 35
    for name, line in lines.items():
        if float(line["recommended_share_percent"]) < 50:
            assert math.isnan(median(line)), name
            assert line["recommended_bound"] == "softer" and float(line["recommended_bound_kPa"]) < 0.8, name
    assert sum(not math.isnan(median(line)) for line in lines.values()) >= 10


def test_a_treatment_that_softens_the_cells_has_the_lower_modulus(lines):
    treated = [(f"LatB_set{day}_{dose}", f"LatB_set{day}_0") for day in (1, 2, 3) for dose in ("0.005", "0.01", "0.025", "0.05", "0.1")]
    osmolarities = ["200", "250", "300", "400", "500", "600", "700"]
    treated += [(f"Osm_set{day}_{low}", f"Osm_set{day}_{high}") for day in (1, 2) for low, high in zip(osmolarities, osmolarities[1:])]
    compared = [(median(lines[soft]), median(lines[stiff])) for soft, stiff in treated]
    both = [(soft, stiff) for soft, stiff in compared if not math.isnan(soft + stiff)]
    assert len(both) >= 6
    assert all(soft < stiff for soft, stiff in both)
    # A softer sample has no number where a stiffer one has none.
    assert not any(math.isnan(stiff) and not math.isnan(soft) for soft, stiff in compared)


def test_without_outlines_the_systematic_error_contains_a_cortex(lines):
    for line in lines.values():
        if not math.isnan(median(line)):
            assert float(line["recommended_young_modulus_median_kPa_common_error"]) >= 0.35 * median(line)
            assert "homogeneous solids" in line["recommended_text"]
