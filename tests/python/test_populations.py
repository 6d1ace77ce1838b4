"""What rheocyte.population returns shows itself, in words and in pictures, also where numbers are missing."""

import copy
import json
import warnings

import numpy as np
import pytest

import rheocyte
from rheocyte import UserError, population_picture
from rheocyte.files import save_figure
from rheocyte.populations import Population

CHECK = {"measure": "c3", "fitted": True, "fits": True, "distance": 0.02, "measured_median": 0.03, "spread": 0.01,
         "measured_quantiles": list(np.linspace(0.02, 0.04, 19)), "predicted_quantiles": list(np.linspace(0.021, 0.04, 19))}
IMAGES = {"ln_modulus_from": 1.0, "step": 0.05, "counts": [1, 5, 20, 40, 20, 5, 1], "without": 3}


BEYOND = {f"beyond_table_{side}": 0 for side in ("events", "softer", "longer", "larger", "fraction")}


def interval(name, value):
    return {name: value, f"{name}_low": 0.95 * value, f"{name}_high": 1.05 * value}


def recording(condition, session, modulus):
    return {"recording": f"{condition}{session}.rtdc", "condition": condition, "session": session, "events": 95,
            **interval("young_modulus_median_kPa", modulus), "young_modulus_ln_spread": 0.2, "radius_median_um": 6.3,
            "radius_ln_spread": 0.07, "correlation": 0.1, "kept_fraction": 0.9, "fits": True, "failure": None,
            "moduli_of_single_images": IMAGES, "checks": [copy.deepcopy(CHECK)]}


def condition(name, modulus):
    return {"condition": name, "recordings": 2, "events": 190, **interval("young_modulus_median_kPa", modulus),
            "young_modulus_ln_spread": 0.2, "young_modulus_interval_by": "scatter of the recordings", "radius_median_um": 6.3,
            "radius_ln_spread": 0.07, **BEYOND}


def quantity(name, unit, symbol):
    return {"quantity": name, "median": f"{name}_median_{unit.replace('/', '_per_')}", "symbol": symbol, "unit": unit}


@pytest.fixture
def record():
    comparison = {"control": "control", "treated": "drug", "quantity": "young_modulus", "test": "paired t", **interval("ratio", 1.3), "p": 0.02,
                  "degrees_of_freedom": 1, "ratio_by_sampling_low": 1.235, "ratio_by_sampling_high": 1.365}
    return {"made_by": "rheocyte population", "level": 0.95, "model": "solid",
            "quantities": [quantity("young_modulus", "kPa", "E")], "conditions": [condition("control", 4), condition("drug", 5.2)],
            "comparisons": [comparison],
            "recordings": [recording("control", 1, 4.0), recording("control", 2, 4.1), recording("drug", 1, 5.1),
                           recording("drug", 2, 5.3)]}


def table(rows):
    """Columns of what is no list, as the program gives them: a missing number is NaN, a missing text empty."""
    missing = {"failure": "", "young_modulus_interval_by": ""}
    names = [name for name, value in rows[0].items() if not isinstance(value, (list, dict))] if rows else []
    return {name: [missing.get(name, np.nan) if row.get(name) is None else row[name] for row in rows] for name in names}


def shown(record):
    tables = {name: table(record[name]) for name in ("recordings", "conditions", "comparisons")}
    tables["checks"] = table([{"recording": each["recording"], **check} for each in record["recordings"] for check in each["checks"]])
    return Population(record, tables, [{"event": []} for _ in record["recordings"]])


def test_a_population_tells_its_estimates_and_its_checks(record):
    text = repr(shown(record))
    assert "control: 4 kPa (3.8 .. 4.2), recordings: 2, events: 190" in text
    assert "drug / control: 1.3 (1.23 .. 1.37), p = 0.02" in text
    assert text.endswith("checks hold in 4 of 4 recordings")
    record["comparisons"][0]["p"] = None
    assert "by sampling alone, no p" in repr(shown(record))


def test_events_beyond_the_table_stand_beside_the_number(record):
    record["conditions"][1].update(beyond_table_events=81, beyond_table_softer=80, beyond_table_longer=1)
    assert "events: 190, and beyond the table 30 % softer" in repr(shown(record)), "190 + 81 events; 0.4 % are not worth a word"


def test_a_recording_that_is_not_there_is_named(record):
    found = shown(record)
    for wrong in (9, "control1.rtdc", None):
        with pytest.raises(UserError, match="number of a row of recordings, 0 to 3"):
            found.events(wrong)
    with pytest.raises(UserError, match="no values of their own"):
        found.events(0)


def test_recordings_without_numbers_do_not_hold_their_checks(record):
    record["recordings"][0].update(young_modulus_median_kPa=None, checks=[], fits=False, failure="no population was found")
    found = shown(record)
    assert list(found.recordings["fits"]) == [False, True, True, True]
    assert "checks hold in 3 of 3 recordings with numbers" in repr(found)
    assert "control1.rtdc: no population was found" in repr(found)


def test_long_names_of_conditions_are_slanted_and_the_legend_is_true(record):
    name = "untreated control of the first of May"
    for each in record["recordings"][:2]:
        each["condition"] = name
    record["conditions"][0]["condition"] = record["comparisons"][0]["control"] = name
    figure = population_picture.draw(record)
    labels = figure.axes[0].get_xticklabels()
    assert labels[0].get_text() == "untreated control of th\u2026" and labels[0].get_rotation() == 40
    assert "by its recordings" in figure.legends[0].get_texts()[1].get_text()
    for each in record["conditions"]:
        each["young_modulus_interval_by"] = "sampling of the events"
    assert "by sampling alone" in population_picture.draw(record).legends[0].get_texts()[1].get_text()


def test_pictures_are_drawn_without_a_warning_also_where_numbers_are_missing(record, tmp_path):
    stiff = record["recordings"][3]
    stiff.update(failure="too stiff to be seen", young_modulus_above_kPa=30.0, young_modulus_median_kPa=None, checks=[])
    record["recordings"][1]["checks"][0]["fits"] = False
    alone = {**copy.deepcopy(record), "conditions": record["conditions"][:1], "comparisons": [],
             "recordings": record["recordings"][:1]}
    nothing = {**copy.deepcopy(alone), "recordings": [{**copy.deepcopy(stiff), "condition": "control"}]}
    nothing["conditions"][0]["young_modulus_median_kPa"] = None
    record["comparisons"] = []  # the program makes none of conditions without a number
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for k, each in enumerate((record, alone, nothing)):
            save_figure(shown(each).plot(), tmp_path / f"population-{k}", 50, svg_dpi=50)
        save_figure(shown(record).plot_checks(), tmp_path / "checks", 50, svg_dpi=50)
        assert shown(nothing).plot_checks() is None
    assert (tmp_path / "population-2.png").stat().st_size > 0


def test_a_damaged_record_is_named(tmp_path):
    with pytest.raises(rheocyte.UserError, match="population.json cannot be read"):
        population_picture.read_record(tmp_path)
    (tmp_path / "population.json").write_text("{}")
    with pytest.raises(rheocyte.UserError, match="not a file of rheocyte population"):
        population_picture.read_record(tmp_path)
    (tmp_path / "population.json").write_text('{"made_by": "rheocyte population", "schema": 1}')
    with pytest.raises(rheocyte.UserError, match="population.json is damaged"):
        population_picture.read_record(tmp_path)


FORMER = {"made_by": "rheocyte population", "schema": 1, "level": 0.95, "model": "solid", "warnings": [],
          "quantities": [{"key": "young_modulus_kPa", "symbol": "E", "unit": "kPa"}],
          "conditions": [{"name": "a", "recordings": 1, "events": 95, "interval_by": "sampling of the events",
                          "median_young_modulus_kPa": {"value": 4, "lower": 3.8, "upper": 4.2}}],
          "comparisons": [{"control": "a", "treated": "b", "quantity": "young_modulus_kPa", "test": "paired t", "p": None,
                           "ratio": {"value": 1.3, "lower": None, "upper": None},
                           "ratio_by_sampling_alone": {"value": 1.3, "lower": 1.2, "upper": 1.4}}],
          "recordings": [{"recording": "a.rtdc", "condition": "a", "session": 1, "failure": None, "checks": [CHECK],
                          "population": {"median_young_modulus_kPa": {"value": 4, "lower": 3.8, "upper": 4.2},
                                         "spread_of_ln_modulus": 0.2, "median_radius_um": 6.3}}]}


def test_a_record_of_the_version_before_is_drawn_with_the_names_of_today(tmp_path):
    (tmp_path / "population.json").write_text(json.dumps(FORMER))
    record = population_picture.read_record(tmp_path)
    row = record["recordings"][0]
    assert (row["young_modulus_median_kPa"], row["young_modulus_median_kPa_low"], row["young_modulus_ln_spread"]) == (4, 3.8, 0.2)
    assert row["radius_median_um"] == 6.3 and record["conditions"][0]["condition"] == "a"
    assert record["comparisons"][0]["ratio_by_sampling_high"] == 1.4
    alone = {**record, "comparisons": []}
    assert "by sampling alone" in population_picture.draw(alone).legends[0].get_texts()[1].get_text()


def test_a_plan_shows_what_follows_from_it():
    plan = rheocyte.plan(6.5, 2, width_um=20, medium="0.49% MC-PBS", rate_ul_s=0.04)
    assert all(line in repr(plan) for line in plan.attrs["lines"]) and plan.attrs["lines"]
    assert type(plan[["channel_width_um"]]) is type(plan)
    assert plan["recommended"].dtype == bool and plan["channel_width_um"].tolist() == [20]
    with pytest.raises(UserError, match="medium is empty"):
        rheocyte.plan(6.5, 2, medium=[])
    with pytest.raises(UserError, match="width_um 0 is outside its range"):
        rheocyte.plan(6.5, 2, width_um=[20, 0])
    with pytest.raises(UserError, match="radius_um is not an array of numbers"):
        rheocyte.plan(None, 2)


def test_a_plan_reads_the_former_name_of_its_temperature():
    with pytest.warns(FutureWarning, match="temperature_C is now called temperature"):
        former = rheocyte.plan(6.5, 2, width_um=20, rate_ul_s=0.04, temperature_C=30)
    assert former.equals(rheocyte.plan(6.5, 2, width_um=20, rate_ul_s=0.04, temperature=30))
    assert not former.equals(rheocyte.plan(6.5, 2, width_um=20, rate_ul_s=0.04))


def with_cortex(record):
    """The same recordings as cells with a cortex, of which two numbers are reported."""
    record = copy.deepcopy(record)
    record["model"] = "cortex"
    record["quantities"] = [quantity("stiffness", "kPa", "E + E2D/r0"), quantity("cortex_modulus", "mN/m", "E2D")]
    for each in [*record["conditions"], *record["recordings"]]:
        modulus = each.pop("young_modulus_median_kPa")
        each.update(interval("stiffness_median_kPa", modulus) | interval("cortex_modulus_median_mN_per_m", 2 * modulus))
    comparison = record["comparisons"][0]
    record["comparisons"] = [{**comparison, "quantity": each["quantity"]} for each in record["quantities"]]
    return record


def test_cells_with_a_cortex_tell_each_quantity(record):
    text = repr(shown(with_cortex(record)))
    assert "control: E + E2D/r0 4 kPa (3.8 .. 4.2), E2D 8 mN/m (7.6 .. 8.4), recordings: 2" in text
    assert "drug / control: E2D, 1.3 (1.23 .. 1.37), p = 0.02" in text


def test_the_picture_of_cells_with_a_cortex_has_a_column_for_each_quantity(record):
    titles = [axes.get_title(loc="left") for axes in shown(with_cortex(record)).plot().axes]
    assert titles == ["E + E2D/r0 (kPa)", "E2D (mN/m)", "ratio", "ratio"]


def test_errors_of_the_outline_are_told_and_must_be_small(tmp_path):
    spec = {"recording": {"cells": 100}, "channel": {"width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
            "cell": {"radius_um": {"mean": 6, "sd": 0.4}, "bulk": {"young_modulus_kPa": {"mean": 4, "sd": 0.6}}},
            "noise": {"contour_um": 0.05}}
    rheocyte.synth(spec, tmp_path / "a.rtdc")
    found = rheocyte.population({"a": tmp_path / "a.rtdc"}, outline_noise_um=0.05)
    assert found.record["outline_noise_um"] == 0.05
    row, = found.record["recordings"]
    assert found.recordings["young_modulus_median_kPa"][0] == row["young_modulus_median_kPa"]
    assert found.recordings["events"].dtype == int and found.recordings["fits"].dtype == bool
    assert {*found.recordings} == {name for name, value in row.items() if not isinstance(value, (list, dict))}
    assert found.check()["measure"].tolist() == [check["measure"] for check in row["checks"]]
    assert found.events()["radius_um"].index.name == "event" and len(found.events()) == found.recordings["events"][0]
    with pytest.raises(UserError, match="outline_noise_um 2 is more than a tenth of it"):
        rheocyte.population({"a": tmp_path / "a.rtdc"}, outline_noise_um=2)
