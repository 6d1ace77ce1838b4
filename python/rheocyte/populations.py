"""Populations of cells: what rheocyte.population returns, and the planning of experiments."""

import functools
import html
import io
import json

import numpy as np

from rheocyte.arrays import number, numbers
from rheocyte.errors import UserError
from rheocyte.native_module import native


class Population:
    """What recordings say about their cells.

    recordings      pandas.DataFrame, one row per recording: condition, session, recording, events (that were fitted),
                    young_modulus_kPa (median), lower_kPa, upper_kPa, ln_modulus_spread, radius_um, ln_radius_spread,
                    correlation, kept_fraction (by the gates), fits (whether there are numbers and all checks hold), failure
    conditions      one row per condition: recordings, events, beyond_the_table (fraction of the events), young_modulus_kPa
                    with lower_kPa and upper_kPa (by the scatter of the recordings), spreads, radius_um; stiffening with its
                    ends (the exponent of E over the stress, of recordings at three or more flow rates)
    comparisons     one row per condition but the first, and quantity: control, treated, quantity, ratio, lower, upper, p,
                    degrees_of_freedom, sampling_lower, sampling_upper

    With model="cortex" the modulus columns are those of each quantity that is told, with its unit: stiffness_kPa (E + E2D/r0),
    young_modulus_kPa, cortex_modulus_mN_per_m, cortex_tension_mN_per_m, axial_tension_Pa (of the liquid), each with _lower,
    _upper and _ln_spread (between cells); NaN where a recording does not tell it.
    record          the dictionary of population.json
    """

    def __init__(self, text, events):
        import pandas

        self.record = json.loads(text)
        self._events = events
        several = [each["key"] for each in self.record["quantities"]] if self.record["model"] != "solid" else None
        self.recordings = pandas.DataFrame([_recording_row(each, several) for each in self.record["recordings"]])
        self.conditions = pandas.DataFrame([_condition_row(each, several) for each in self.record["conditions"]])
        self.comparisons = pandas.DataFrame([_comparison_row(each) for each in self.record["comparisons"]])

    def events(self, recording=0):
        """Shrunken values of the events of a recording (its row): event (counted from 1), young_modulus_kPa,
        ln_modulus_sd, radius_um, ln_radius_sd. For pictures, never for tests; UserError of more than 20,000 events,
        which were counted in bins."""
        import pandas

        if recording not in range(len(self._events)):
            raise UserError(f"recording is the number of a row of recordings, 0 to {len(self._events) - 1}; got {recording!r}.")
        if not self._events[recording]:
            raise UserError("the events of this recording have no values of their own: it has no numbers, its cells have a "
                            "cortex, or they were counted in bins; no_bins=True takes each by itself.")
        return pandas.read_csv(io.StringIO(self._events[recording]), sep="\t", index_col="event")

    def check(self):
        """pandas.DataFrame of the checks: recording, measure, fitted, fits, distance, measured and predicted medians with their
        standard errors, and how many of the three thirds by area fit (of few events none is looked at)."""
        import pandas

        return pandas.DataFrame([{"recording": each["recording"], "condition": each["condition"],
                                  **{name: value for name, value in check.items()
                                     if "quantiles" not in name and name != "thirds_by_area"},
                                  "thirds_that_fit": sum(third["fits"] for third in check.get("thirds_by_area", []))}
                                 for each in self.record["recordings"] for check in each["checks"]])

    def plot(self):
        """A matplotlib Figure, that of population.png: Young's modulus of each recording with its interval, one dot a session,
        the ratios to the first condition with the interval of their mean, and the cells against moduli of single images."""
        from rheocyte import population_picture

        return population_picture.draw(self.record)

    def plot_checks(self):
        """A matplotlib Figure, that of population-checks.png: quantiles of the fitted cells less those that were measured. None
        if nothing was checked."""
        from rheocyte import population_picture

        return population_picture.draw_checks(self.record)

    def __repr__(self):
        lines = [f"Population of {len(self.recordings)} recordings"]
        quantities = {each["key"]: each for each in self.record["quantities"]}
        several = len(quantities) > 1
        for condition in self.record["conditions"]:
            told = [f"{each['symbol'] + ' ' if several else ''}{_told(*_interval(condition, 'median_' + key), ' ' + each['unit'])}"
                    for key, each in quantities.items() if "median_" + key in condition]
            lines.append(f"{condition['name']}: {', '.join(told) or 'no number'}, recordings: {condition['recordings']}, "
                         f"events: {condition['events']}{_beyond_text(condition)}")
        for row in self.comparisons.itertuples():
            of = f"{quantities[row.quantity]['symbol']}, " if several else ""
            if np.isfinite(row.p):
                lines.append(f"{row.treated} / {row.control}: {of}{_told(row.ratio, row.lower, row.upper)}, p = {row.p:.2g}")
            else:
                lines.append(f"{row.treated} / {row.control}: {of}{_told(row.ratio, row.sampling_lower, row.sampling_upper)} by "
                             "sampling alone, no p")
        failed = self.recordings[self.recordings["failure"] != ""]
        lines.append(f"checks hold in {int(self.recordings['fits'].sum())} of {len(self.recordings) - len(failed)} recordings"
                     + (" with numbers" if len(failed) else ""))
        lines += [f"{row.recording}: {row.failure}" for row in failed.itertuples()]
        return "\n".join(lines)


def plan(radius_um, young_modulus_kPa, *, spread=0.2, radius_spread=0.07, between_recordings=0.03, difference=0.1, power=0.8,
         cells=500, mode_2=0.1, pixel_size_um=0.34, temperature_C=23, width_um=(15, 20, 30),
         medium=("0.49% MC-PBS", "0.83% MC-PBS"), rate_ul_s=()):
    """Which channel, flow rate and medium show a difference between conditions, as `rheocyte plan` says.

    radius_um, young_modulus_kPa
                    of the median cell
    spread, radius_spread, between_recordings
                    standard deviations of ln E and ln r0 between cells, and of ln E between recordings
    difference, power, cells
                    relative difference of E, the wanted probability to find it, cells of a recording
    mode_2          how elongated the cells are: c2 of their outlines
    pixel_size_um, temperature_C
                    of the camera, and of the medium
    width_um, medium, rate_ul_s
                    what is compared; without rates those of mean speeds of 0.04, 0.1, 0.2 and 0.4 m/s

    Returns a pandas.DataFrame with one row per channel: speed, viscosity, stress at the wall, deformation and mode_3 of the
    median cell, fraction of the cells inside the table, the error of ln E by one image, sessions that are needed (inf: more than
    100; NaN: the table has no such cells, or they are too stiff to be seen), and the Reynolds number.
    attrs["lines"]: what is recommended, and what limits. UserError for a number that makes no sense, and where no channel shows
    the cells.
    """
    import pandas

    options = native.PlanOptions()
    for name, value in {"radius_um": radius_um, "young_modulus_kPa": young_modulus_kPa, "spread": spread,
                        "radius_spread": radius_spread, "between_recordings": between_recordings, "difference": difference,
                        "power": power, "cells": cells, "mode_2": mode_2, "pixel_size_um": pixel_size_um,
                        "temperature_C": temperature_C}.items():
        setattr(options, name, number(value, name))
    options.widths_um = np.atleast_1d(numbers(width_um, "width_um")).tolist()
    options.media = [medium] if isinstance(medium, str) else list(medium)
    for name, values in {"width_um": options.widths_um, "medium": options.media}.items():
        if not values:
            raise UserError(f"{name} is empty; give one or several.")
    options.rates_ul_s = np.atleast_1d(numbers(rate_ul_s, "rate_ul_s")).tolist()
    table, lines = native.plan(options)
    frame = _plan_frame()(pandas.read_csv(io.StringIO(table), sep="\t"))
    frame["recommended"] = frame["recommended"] == "yes"
    frame.attrs["lines"] = lines
    return frame


@functools.cache
def _plan_frame():
    """pandas is loaded with the first plan."""
    import pandas

    class Plan(pandas.DataFrame):
        """The channels of a plan; what follows from them stands below them where it is shown."""

        @property
        def _constructor(self):
            return Plan

        def __repr__(self):
            return "\n".join([super().__repr__(), *self.attrs.get("lines", [])])

        def _repr_html_(self):
            told = "".join(f"<p>{html.escape(line)}</p>" for line in self.attrs.get("lines", []))
            return (super()._repr_html_() or "") + told

    return Plan


def _beyond(record):
    """By the side of the table, the fraction of the events beyond it."""
    counts = record.get("beyond_the_table") or {}
    events = record["events"] + sum(counts.values())
    return {side: count / events for side, count in counts.items() if count}


def _beyond_text(condition):
    shares = [f"{100 * share:.0f} % {side}" for side, share in _beyond(condition).items() if share >= 0.005]
    return f", and beyond the table {' and '.join(shares)}" if shares else ""


def _told(value, lower, upper, unit=""):
    """A number with its interval."""
    return f"{value:.3g}{unit} ({lower:.3g} .. {upper:.3g})" if np.isfinite(value) else "no number"


def _interval(record, name):
    value = record.get(name) or {}
    return [np.nan if value.get(part) is None else value[part] for part in ("value", "lower", "upper")]


def _moduli(record, several):
    """Columns of the medians: of solids one, else of each quantity."""
    if several is None:
        return {**dict(zip(("young_modulus_kPa", "lower_kPa", "upper_kPa"), _interval(record, "median_young_modulus_kPa"))),
                "ln_modulus_spread": record.get("spread_of_ln_modulus", np.nan)}
    columns = {}
    for key in several:
        columns.update(zip((key, f"{key}_lower", f"{key}_upper"), _interval(record, f"median_{key}")))
        columns[f"{key}_ln_spread"] = record.get(f"spread_of_ln_{key}", np.nan)
    return columns


def _recording_row(record, several):
    found = record.get("population") or {}
    row = {"condition": record["condition"], "session": record["session"], "recording": record["recording"],
           "events": record["events"]["fitted"], **_moduli(found, several), "radius_um": found.get("median_radius_um", np.nan), "ln_radius_spread": found.get("spread_of_ln_radius", np.nan)}
    if several is None:
        row["correlation"] = found.get("correlation", np.nan)
    row["kept_fraction"] = found.get("kept_fraction", np.nan)
    fits = not record["failure"] and all(check["fits"] for check in record["checks"])
    return {**row, "fits": fits, "failure": record["failure"] or ""}


def _condition_row(record, several):
    exponent, least, greatest = _interval(record.get("stiffening") or {}, "exponent_of_modulus_over_stress")
    return {"condition": record["name"], "recordings": record["recordings"], "events": record["events"],
            "beyond_the_table": sum(_beyond(record).values()), **_moduli(record, several), "radius_um": record.get("median_radius_um", np.nan),
            "ln_radius_spread": record.get("spread_of_ln_radius", np.nan),
            "stiffening": exponent, "stiffening_lower": least, "stiffening_upper": greatest}


def _comparison_row(record):
    ratio, lower, upper = _interval(record, "ratio")
    _, sampling_lower, sampling_upper = _interval(record, "ratio_by_sampling_alone")
    freedom = record["degrees_of_freedom"]
    return {"control": record["control"], "treated": record["treated"], "quantity": record["quantity"], "ratio": ratio, "lower": lower, "upper": upper,
            "p": np.nan if record["p"] is None else record["p"],
            "degrees_of_freedom": np.nan if freedom is None else freedom,
            "sampling_lower": sampling_lower, "sampling_upper": sampling_upper}
