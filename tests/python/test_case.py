"""A case has the keys of case files as attributes, checks them at once and reports mistakes by one sentence."""

import pickle

import numpy as np
import pytest

import rheocyte
from rheocyte import Case, UserError


def test_every_declared_key_is_an_attribute(paper):
    case = Case(paper)
    for key in rheocyte.case_keys():
        found = case
        for part in key["name"].split("."):
            assert part in dir(found)
            found = getattr(found, part)
        assert found is None or isinstance(found, (float, str, list)), key["name"]


def test_a_file_a_dictionary_and_keywords_make_the_same_case(paper, tmp_path):
    case = Case(paper)
    (tmp_path / "case.toml").write_text(case.to_toml())
    flat = Case(channel_width_um=20, flow_rate_ul_s=0.04, viscosity_mPas=15, radius_um=7.66, young_modulus_kPa=4,
                numerics__accuracy=1e-3)
    assert Case(tmp_path / "case.toml") == case == flat == Case(case.to_dict()) == pickle.loads(pickle.dumps(case))
    assert len({case, flat}) == 1


def test_a_key_that_is_set_changes_the_case_and_a_wrong_one_leaves_it(paper):
    case = Case(paper)
    case.cell.bulk.young_modulus_kPa = np.float32(3)
    assert case.cell.bulk.young_modulus_kPa == 3
    before = case.hash
    with pytest.raises(UserError, match=r"cell.radius_um = 1000.*range"):
        case.cell.radius_um = 1000
    assert case.hash == before
    with pytest.raises(AttributeError, match="case_keys"):
        case.cell.radius = 5


def test_a_law_brings_its_keys_and_takes_them_away(paper):
    case = Case(paper)
    assert case.flow.exponent is None
    case.flow = {"law": "power-law", "consistency_Pa_sn": 0.4, "exponent": 0.6}
    assert (case.flow.law, case.flow.exponent, case.flow.viscosity_mPas) == ("power-law", 0.6, None)
    case.flow = {"law": "newtonian", "viscosity_mPas": 10}
    assert (case.flow.exponent, case.flow.viscosity_mPas) == (None, 10)


def test_the_constants_of_fung_and_skalak_come_with_their_laws(paper):
    case = Case(paper).replace(cell__bulk__law="fung", cell__bulk__stiffening=0.5)
    assert case.cell.bulk.stiffening == 0.5 and Case(case.to_dict()) == case
    assert case.replace(cell__bulk__stiffening=0.6).hash != case.hash
    shell = Case(paper).replace(cell__cortex__law="skalak", cell__cortex__modulus_mN_per_m=1)
    assert (shell.cell.cortex.area_constant, shell.cell.bulk.stiffening) == (1, None)


def test_a_key_in_time_makes_the_case_one_in_time(paper):
    case = Case(paper).replace(time__end_us=100, cell__viscosity_mPas=15)
    assert case.time.scheme == "monolithic"
    assert Case(paper).time.scheme == "stationary"


@pytest.mark.parametrize("keys, sentence", [
    ({"cell": {"radus_um": 5}}, r"radus_um.*did you mean.*radius_um"),
    ({"cell": {"radius_um": "large"}}, r"cell.radius_um = \"large\""),
    ({"cell": {"radius_um": float("nan")}}, "cell.radius_um"),
    ({"cell": {"radius_um": True}}, "cell.radius_um = True"),
    ({"cell": {"radius_um": [1, 2]}}, "cell.radius_um"),
    ({"cell": {"radius_um": object()}}, "of the type object"),
    ({"cell": {"radius_um": 1j}}, "cell.radius_um"),
    ({"cell": {"bulk": {"law": "jelly"}}}, "jelly"),
    ({"cell": 5}, "cell"),
    ({"flow": {"exponent": 0.5}}, "flow.exponent"),
    ({5: 5}, "is not a text"),
    ({"cell": {"radius_um": "a\udcff"}}, "cell.radius_um"),
    ({"a\udcff": 5}, "is not a text"),
])
def test_mistakes_are_value_errors_that_name_the_key(paper, keys, sentence):
    for section, values in keys.items():
        if isinstance(paper.get(section), dict) and isinstance(values, dict):
            paper[section] = {**paper[section], **values}
        else:
            paper[section] = values
    with pytest.raises(UserError, match=sentence) as caught:
        Case(paper)
    assert isinstance(caught.value, ValueError) and "\n" not in str(caught.value)


@pytest.mark.parametrize("source", [5, ["cell"], b"case.toml", "a\0b"])
def test_what_is_no_source_is_refused(source):
    with pytest.raises(UserError):
        Case(source)


def test_mistakes_in_files_are_told_with_their_line(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text("[channel]\nwidth_um = 20\n\n[cell]\nradius_um = -1\n")
    with pytest.raises(UserError, match=r"case.toml:5"):
        Case(file)
    with pytest.raises(UserError, match="nowhere.toml"):
        Case(tmp_path / "nowhere.toml")


def test_keywords_are_the_options_of_the_command_line(paper):
    for key in rheocyte.case_keys():
        if key["option"] == "--tube-radius-um":
            assert Case(paper, tube_radius_um=12).channel.radius_um == 12
        if key["option"] == "--young-modulus-kPa":
            assert Case(paper, young_modulus_kPa=7).cell.bulk.young_modulus_kPa == 7


def test_a_copy_and_a_result_keep_the_case_as_it_was(paper):
    case = Case(paper)
    copy, result = Case(case), rheocyte.solve(case)
    case.cell.bulk.young_modulus_kPa = 9
    assert copy.cell.bulk.young_modulus_kPa == result.problem.cell.bulk.young_modulus_kPa == 4
