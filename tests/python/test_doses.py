"""The recommended modulus of HL60 samples with known treatments (Urbanska et al. 2020, latrunculin B and osmolarities)."""

import csv
import json
import math
import subprocess

import pytest
from conftest import REFERENCE

DOSES = REFERENCE / "hl60-doses"
LATRUNCULIN = ["0.001", "0.005", "0.01", "0.025", "0.05", "0.1"]  # ug/ml

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


def tension(line):
    return float(line["cell_axial_tension_Pa"])


def test_every_sample_has_an_effective_modulus_by_all_of_its_events(lines):
    assert len(lines) == 35
    for name, line in lines.items():
        assert line["recommended_modulus"] == line["recommended_reason"] == "effective", name
        assert float(line["recommended_share_percent"]) == 100
        assert 0.002 < float(line["recommended_young_modulus_median_kPa_error"]) / median(line) < 0.02, name
        assert line["effective_place"] == "inside"


def test_nearly_every_event_has_an_effective_modulus_under_that_tension(lines):
    for name, line in lines.items():
        share = float(line["effective_modulus_share_percent"])
        assert share > (50 if name.startswith("LatB") else 85), name  # the table in CellCarrier ends at d = 0.105 to 0.12
        of_events = float(line["effective_modulus_of_events_median_kPa"] or "nan")
        assert abs(of_events / median(line) - 1) < 0.05, name
        if name.startswith("LatB") and name.endswith("_0"):
            assert share > 98


def test_the_shapes_choose_the_cells_of_a_population(program, tmp_path):
    run = subprocess.run([program, "population", "--no-picture", "-o", tmp_path / "chosen", "--condition",
                          f"control={DOSES / 'LatB_set1_0.rtdc'},{DOSES / 'LatB_set2_0.rtdc'}"],
                         check=True, capture_output=True, text=True)
    assert "--model effective, because the cells of 2 of 2 recordings are longer" in run.stdout


def test_a_gate_counts_in_the_effective_modulus(program, tmp_path):
    sample = DOSES / "LatB_set2_0.rtdc"
    subprocess.run([program, "extract", "--quiet", "--max", "deform=0.07", "-o", tmp_path, sample], check=True, capture_output=True)
    with open(tmp_path / "rheocyte_summary.tsv", newline="", encoding="utf-8") as file:
        gated = next(csv.DictReader(file, delimiter="\t"))
    subprocess.run([program, "population", "--quiet", "--no-picture", "--max", "deform=0.07", "-o", tmp_path / "p", "--condition",
                    f"a={sample}"], check=True, capture_output=True)
    record = json.loads((tmp_path / "p" / "population.json").read_text(encoding="utf-8"))
    assert math.isclose(record["recordings"][0]["effective_modulus_median_kPa"], float(gated["effective_modulus_kPa"]), rel_tol=1e-3)


def test_latrunculin_softens_the_cells_by_a_third_and_more(lines):
    logs = {dose: [math.log(median(lines[f"LatB_set{day}_{dose}"]) / median(lines[f"LatB_set{day}_0"])) for day in (1, 2, 3)]
            for dose in LATRUNCULIN}
    for dose in ("0.05", "0.1"):
        assert 0.53 < math.exp(sum(logs[dose]) / 3) < 0.7, dose
        assert all(log < math.log(0.75) for log in logs[dose])
    means = [sum(logs[dose]) / 3 for dose in LATRUNCULIN]
    assert all(more < less for less, more in zip(means[:4], means[1:5])), "monotonic to 0.05 ug/ml"
    assert abs(means[0]) < 0.05


def test_the_modulus_grows_with_the_osmolarity(lines):
    for day in (1, 2):
        moduli = [median(lines[f"Osm_set{day}_{osmolarity}"]) for osmolarity in (250, 300, 400, 500, 600, 700)]
        assert all(low < high for low, high in zip(moduli, moduli[1:]))
        assert 1.7 < moduli[-1] / moduli[1] < 2.7


def test_one_axial_tension_belongs_to_the_set_up(lines):
    tensions = sorted(tension(line) for line in lines.values())
    middle = tensions[len(tensions) // 2]
    assert 180 < middle < 195
    assert all(0.88 < each / middle < 1.12 for each in tensions)
    for day in (1, 2, 3):
        for dose in LATRUNCULIN:
            assert abs(tension(lines[f"LatB_set{day}_{dose}"]) / tension(lines[f"LatB_set{day}_0"]) - 1) < 0.1


def test_the_law_of_the_cortex_is_part_of_the_systematic_error(lines):
    for name, line in lines.items():
        ratio = float(line["effective_modulus_over_other_law"] or "nan")
        error = float(line["recommended_young_modulus_median_kPa_common_error"]) / median(line)
        assert 0.1 < error < 0.35, name
        if not math.isnan(ratio):
            assert 0.6 < ratio < 1 and error > abs(math.log(ratio)) / 2, name


def test_doses_have_a_trend_and_an_ec50(program, tmp_path):
    conditions = [f"control={','.join(str(DOSES / f'LatB_set{day}_0.rtdc') for day in (1, 2, 3))}"]
    arguments = []
    for dose in LATRUNCULIN:
        conditions.append(f"lat{dose}={','.join(str(DOSES / f'LatB_set{day}_{dose}.rtdc') for day in (1, 2, 3))}")
        arguments += ["--dose", f"lat{dose}={dose}"]
    for condition in conditions:
        arguments += ["--condition", condition]
    run = subprocess.run([program, "population", "--model", "effective", "--paired", "--no-picture", "--dose-unit", "ug/ml", "-o",
                          tmp_path / "doses", *arguments], check=True, capture_output=True, text=True)
    assert "one tension, as the model requires" in run.stdout
    record = json.loads((tmp_path / "doses" / "population.json").read_text(encoding="utf-8"))
    response = record["dose_responses"][0]
    assert response["quantity"] == "effective_modulus" and response["p_of_trend"] < 1e-5
    assert 0.005 < response["ec50_low"] < response["ec50"] < response["ec50_high"] < 0.1
    assert f"EC50 {response['ec50']:.3g} ug/ml" in run.stdout
