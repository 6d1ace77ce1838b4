"""Populations of cells and plans of experiments: what rheocyte.population and rheocyte.plan return."""

import functools
import html

import numpy as np

from rheocyte.errors import UserError


class Population:
    """What recordings say about their cells. The names of the columns are those of population.json and population.tsv.

    recordings      pandas.DataFrame, one row per recording: condition, session, recording, events (that were fitted),
                    young_modulus_median_kPa with the ends of its interval (..._low, ..._high), young_modulus_mean_kPa,
                    young_modulus_ln_spread (between cells), young_modulus_ln_median with its standard error (..._error),
                    radius_median_um, radius_ln_spread, correlation, kept_fraction (by the gates), fits (whether there are
                    numbers and all checks hold), failure; the numbers of events, and how it was measured
    conditions      one row per condition: recordings, events, the medians with their ends (by the scatter of the recordings),
                    spreads, radius_median_um, beyond_table_fraction (of the events); young_modulus_stress_exponent with its ends
                    (E as a power of the stress, of recordings at three or more flow rates)
    comparisons     one row per condition but the first, and quantity: control, treated, quantity, ratio with its ends, p,
                    degrees_of_freedom, ln_ratio with its standard error, ratio_by_sampling_low and ..._high

    dose_responses  one row per quantity, if doses were given: ec50 with its ends (dose of half of the effect on ln of the
                    quantity), ratio_at_large_dose, ratio_per_decade with its ends (for ten times the dose), p_of_trend

    With model="effective": effective_modulus (bulk, cortex and tension together) and axial_tension (of the liquid), by the
    medians of area, deformation and inertia ratio.
    With model="cortex" each quantity that is reported has these columns, with its unit: stiffness (E + E2D/r0),
    effective_modulus (bulk, cortex and tension together), young_modulus, cortex_modulus, cortex_tension, axial_tension (of
    the liquid); NaN if it is unknown.
    record          the dictionary of population.json
    """

    def __init__(self, record, tables, events):
        import pandas

        self.record = record
        self.recordings, self.conditions, self.comparisons, self._checks = (
            pandas.DataFrame(tables[name]) for name in ("recordings", "conditions", "comparisons", "checks"))
        self.dose_responses = pandas.DataFrame(record.get("dose_responses", []))
        self._events = events

    def events(self, recording=0):
        """Shrunken values of the events of a recording (its row): event (counted from 1), young_modulus_kPa,
        young_modulus_ln_error, radius_um, radius_ln_error. For pictures, never for tests; UserError of more than 20,000
        events, which were counted in bins."""
        import pandas

        if recording not in range(len(self._events)):
            raise UserError(f"recording is the number of a row of recordings, 0 to {len(self._events) - 1}; got {recording!r}.")
        if not self._events[recording]["event"]:
            raise UserError("the events of this recording have no values of their own: it has no numbers, its cells have a "
                            "cortex, or they were counted in bins; no_bins=True takes each by itself.")
        return pandas.DataFrame(self._events[recording]).set_index("event")

    def check(self):
        """pandas.DataFrame of the checks: recording, measure, fitted, fits, distance, measured and predicted medians with their
        standard errors, and how many of the three thirds by area fit (of few events none is looked at)."""
        return self._checks.copy()

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
        quantities = {each["quantity"]: each for each in self.record["quantities"]}
        several = len(quantities) > 1
        for condition in self.conditions.to_dict("records"):
            told = [f"{each['symbol'] + ' ' if several else ''}{_told(condition, each['median'], ' ' + each['unit'])}"
                    for each in quantities.values() if np.isfinite(condition[each["median"]])]
            lines.append(f"{condition['condition']}: {', '.join(told) or 'no number'}, recordings: {condition['recordings']}, "
                         f"events: {condition['events']}{_beyond_text(condition)}")
        for row in self.comparisons.to_dict("records"):
            of = f"{quantities[row['quantity']]['symbol']}, " if several else ""
            known = (_told(row, "ratio") + f", p = {row['p']:.2g}" if np.isfinite(row["p"])
                     else _told(row, "ratio", ends="ratio_by_sampling") + " by sampling alone, no p")
            lines.append(f"{row['treated']} / {row['control']}: {of}{known}")
        failed = self.recordings[self.recordings["failure"] != ""]
        if len(self._checks):
            lines.append(f"checks hold in {int(self.recordings['fits'].sum())} of {len(self.recordings) - len(failed)} recordings"
                         + (" with numbers" if len(failed) else ""))
        lines += self.record.get("tensions", [])
        lines += [f"{row.recording}: {row.failure}" for row in failed.itertuples()]
        return "\n".join(lines)


def framed_plan(table, lines):
    """The channels of a plan; attrs["lines"]: what follows from them."""
    frame = _plan_frame()(table)
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


def _beyond_text(condition):
    counts = {name.removeprefix("beyond_table_"): count for name, count in condition.items() if name.startswith("beyond_table_")}
    events = condition["events"] + counts.pop("events")
    del counts["fraction"]
    shares = [f"{100 * count / events:.0f} % {side}" for side, count in counts.items() if events and count / events >= 0.005]
    return f", and beyond the table {' and '.join(shares)}" if shares else ""


def _told(row, name, unit="", ends=None):
    """A number with its interval."""
    low, high = (row[f"{ends or name}_{end}"] for end in ("low", "high"))
    return f"{row[name]:.3g}{unit} ({low:.3g} .. {high:.3g})"
