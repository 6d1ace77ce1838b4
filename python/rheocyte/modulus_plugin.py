"""A plugin feature of dclab and DCscope: Young's moduli by rheocyte's tables of the square channel.

    rheocyte dclab-plugin > rheocyte_modulus.py        then choose the file in DCscope's dialogue of extensions, or
    dclab.load_plugin_feature("rheocyte_modulus.py")

The file is complete: tables and laws stand at its end, and it needs nothing but dclab and numpy. Channel, flow rate and
pixel size are those of the recording; medium, viscosity, its model and the temperature are those that are set in dclab
or DCscope (section "calculation" of the configuration), else those of the recording. The table is that of the medium,
as `rheocyte extract` chooses it, or the one whose name is set as look-up table. Formulas: docs/theory-extract.md.
"""

import base64
import functools
import json
import logging
import re
from typing import NamedTuple

import numpy as np

DATA = "{}"  # `rheocyte dclab-plugin` puts tables and laws behind this text

# The numbers of the states are those of all files of rheocyte.
VALID, NO_DATA, TOO_SMALL, TOO_LARGE, TOO_STIFF, UNRESOLVED, REGULARISED, INERTIAL = 0, 1, 2, 3, 4, 7, 8, 10
WITH_MODULUS = (VALID, REGULARISED, INERTIAL)
FEATURES = ("rheocyte_modulus", "rheocyte_modulus_error", "rheocyte_state", "rheocyte_shape_excess", "rheocyte_recommended")
WORDS_OF_SOLUTIONS = set("mc pbs methyl cellulose methylcellulose in w v wt 1x solution buffer".split())
EVENTS_AT_ONCE = 1 << 16  # memory does not grow with the recording


@functools.cache
def data():
    """The tables by their names, and the laws."""
    return json.loads(DATA)


class Settings(NamedTuple):
    """How a recording was measured, by the settings of dclab and its metadata."""
    channel_width_um: float
    flow_rate_ul_s: float
    pixel_size_um: float
    viscosity_mPas: float | None  # None: that of the medium
    medium: str
    viscosity_model: str
    temperature_C: float | None  # of all events; None: as recorded
    recorded_C: float | None  # of the recording as a whole
    look_up_table: str


def sections(dataset, *names):
    """Of the configuration; empty ones where there are none."""
    return [dataset.config[name] if name in dataset.config else {} for name in names]


def number(values, key):
    """A finite number, or None."""
    value = values.get(key)
    return float(value) if value is not None and np.isfinite(float(value)) else None


def possible(value, limit):
    """The number if it lies within the limits of that name; ValueError."""
    least, greatest = data()["limits"][limit]
    if value is None or not least <= value <= greatest:
        raise ValueError(f"{limit} is {value}")
    return value


def settings_of(dataset):
    """ValueError or KeyError for recordings of which something is not known."""
    setup, imaging, chosen = sections(dataset, "setup", "imaging", "calculation")
    if setup.get("chip region", "channel").lower() != "channel":
        raise ValueError("cells of the reservoir are not deformed by the channel")
    viscosity, medium, model = liquid_of(dataset)
    wanted = number(chosen, "emodulus temperature")
    settings = Settings(
        channel_width_um=possible(number(setup, "channel width"), "channel_width_um"),
        flow_rate_ul_s=possible(number(setup, "flow rate"), "flow_rate_ul_s"),
        pixel_size_um=possible(number(imaging, "pixel size"), "pixel_size_um"),
        viscosity_mPas=viscosity, medium=medium, viscosity_model=model,
        temperature_C=None if viscosity or wanted is None else possible(wanted, "temperature_C"),
        recorded_C=number(setup, "temperature"), look_up_table=str(chosen.get("emodulus lut", "")))
    if viscosity is None:
        viscosity_at(settings, 23.0)  # whether the model knows the medium
        if settings.temperature_C is None and "temp" not in dataset:
            possible(settings.recorded_C, "temperature_C")
    return settings


def liquid_of(dataset):
    """Viscosity (mPa s), medium and model of the viscosity; None for the viscosity where it is that of the medium."""
    setup, user, chosen = sections(dataset, "setup", "user", "calculation")
    medium = known_medium(chosen.get("emodulus medium", setup.get("medium", "")))
    viscosity = number(chosen, "emodulus viscosity")
    if viscosity is None and medium is None and "emodulus medium" not in chosen:
        viscosity = number(user, "rheocyte viscosity_mPas")  # of virtual recordings
    if viscosity is not None:
        return possible(viscosity, "viscosity_mPas"), "", ""
    if medium is None:
        raise ValueError("the viscosity of the medium is not known")
    return None, medium, chosen.get("emodulus viscosity model", "buyukurganci-2022")


def known_medium(name):
    """dclab's name of a medium whose viscosity it knows, or None; solutions of methyl cellulose by their percentage."""
    from dclab.features.emodulus.viscosity import ALIAS_MEDIA
    text, percentage = str(name).lower().replace(",", "."), r"(?<![a-z\d.-])(\d*\.?\d+)[ _\t]*%"
    percent, words = re.findall(percentage, text), re.findall("[a-z0-9]+", re.sub(percentage, " ", text))
    if not percent:
        return ALIAS_MEDIA.get("".join(words))
    is_mc = WORDS_OF_SOLUTIONS.issuperset(words) and (not words or {"mc", "cellulose", "methylcellulose"} & {*words})
    return ALIAS_MEDIA.get(f"{float(percent[0]):g}% mc-pbs") if len(percent) == 1 and is_mc else None


def viscosity_at(settings, celsius, rate_factor=1):
    """Effective viscosity (mPa s) at the wall, of the medium, at so many times the flow rate."""
    from dclab.features.emodulus.viscosity import get_viscosity
    return get_viscosity(medium=settings.medium, channel_width=settings.channel_width_um, temperature=celsius,
                         flow_rate=rate_factor * settings.flow_rate_ul_s, model=settings.viscosity_model)


def temperatures_of(settings, dataset):
    """Degrees Celsius of each event, or of all; NaN where a buffer cannot have what is recorded."""
    if settings.temperature_C is not None:
        return settings.temperature_C
    if "temp" in dataset:
        celsius = column_of(dataset, "temp")
        celsius[np.clip(celsius, *data()["limits"]["temperature_C"]) != celsius] = np.nan
        if np.isfinite(celsius).any():
            return celsius
    return possible(settings.recorded_C, "temperature_C")


def liquid(settings, dataset):
    """Viscosity of each event (mPa s), and n of eta ~ (shear rate)^(n - 1) at the median temperature."""
    if settings.viscosity_mPas is not None:
        return np.full(len(dataset), settings.viscosity_mPas), 1.0
    celsius = temperatures_of(settings, dataset)
    viscosity = np.broadcast_to(viscosity_at(settings, celsius), len(dataset))
    middle = np.nanmedian(celsius)
    return viscosity, 1 + np.log2(viscosity_at(settings, middle, 2) / viscosity_at(settings, middle))


def unpacked(text, *shape):
    return np.frombuffer(base64.b64decode(text), "<f4").astype(float).reshape(shape)


def slopes(values):
    """Along the first axis, per node: of the polynomial through the five nearest nodes."""
    count = len(values)
    nodes = np.arange(min(5, count))
    found = np.empty_like(values)
    for i in range(count):
        first = min(max(i - len(nodes) // 2, 0), count - len(nodes))
        change = np.append(0, nodes[1:] * (i - first) ** (nodes[1:] - 1))  # of the powers of the place
        weights = np.linalg.solve(np.vander(nodes, increasing=True).T, change)
        found[i] = np.tensordot(weights, values[first:first + len(nodes)], 1)
    return found


def hermite(t):
    """Weights of the values and slopes at the ends of an interval at a place of it, 0 to 1."""
    s = 1 - t
    return s * s * (1 + 2 * t), t * t * (3 - 2 * t), s * s * t, -s * t * t


def hermite_slope(t):
    s = 1 - t
    return -6 * t * s, 6 * t * s, s * (1 - 3 * t), t * (3 * t - 2)


def between(weights, *values_and_slopes):
    return sum(weight * value for weight, value in zip(weights, values_and_slopes))


class Patch:
    """Values over ln(area) and ln(deformation): columns of as many rows each between two borders; bicubic."""
    def __init__(self, lower, upper, values):
        self.columns, self.rows = values.shape
        self.lower, self.upper = (lower, slopes(lower)), (upper, slopes(upper))
        by_row = slopes(values.T).T
        self.nodes = values, slopes(values), by_row, slopes(by_row)

    def borders(self, column, weights):
        """ln(deformation) of the first and the last row."""
        return [between(weights, value[column], value[column + 1], slope[column], slope[column + 1])
                for value, slope in (self.lower, self.upper)]

    def value(self, place, weights, weights_along):
        """By the weights among columns and among rows, at places (column, row)."""
        column, row = place
        value, by_column, by_row, by_both = (
            [nodes[at, up] for at in (column, column + 1) for up in (row, row + 1)] for nodes in self.nodes)
        ends = [between(weights_along, *values[first:first + 2], *changes[first:first + 2])
                for values, changes in ((value, by_row), (by_column, by_both)) for first in (0, 2)]
        return between(weights, *ends)


class Stiffness(Patch):
    """ln(kPa) of a part of a table, with its errors, and the reason why there is none above it."""
    def __init__(self, record):
        self.first_column, self.regularised = record["first_column"], record["regularised"]
        lower = unpacked(record["lower"], -1)
        shape = len(lower), record["rows"]
        super().__init__(lower, unpacked(record["upper"], -1), unpacked(record["log_stiffness"], *shape))
        error = unpacked(record["error"], *shape)
        self.error = np.maximum.reduce([error[:-1, :-1], error[1:, :-1], error[:-1, 1:], error[1:, 1:]])
        self.beyond = unpacked(record["beyond"], -1)

    def answer(self, column, fraction, log_deformation):
        """ln(kPa), its slopes by columns and by ln(deformation), and the relative error."""
        weights, changes = hermite(fraction), hermite_slope(fraction)
        (lower, upper), (lower_change, upper_change) = self.borders(column, weights), self.borders(column, changes)
        rows_per_height = (self.rows - 1) / (upper - lower)
        height = (log_deformation - lower) * rows_per_height
        row = np.minimum(height.astype(int), self.rows - 2)
        place, up = (column, row), hermite(height - row)
        by_row = self.value(place, weights, hermite_slope(height - row))
        # At constant deformation the height in rows changes with the borders.
        height_change = -rows_per_height * (lower_change + height / (self.rows - 1) * (upper_change - lower_change))
        return (self.value(place, weights, up), self.value(place, changes, up) + by_row * height_change,
                by_row * rows_per_height, self.error[column, row])


class Shapes(Patch):
    """(inertia ratio - 1) / deformation of the cells of a table."""
    def __init__(self, record):
        lower, upper = unpacked(record["lower"], -1), unpacked(record["upper"], -1)
        self.least_log_area, self.step = record["least_log_area"], record["column_step"]
        deformation = np.exp(np.linspace(lower, upper, record["rows"], axis=1))
        super().__init__(lower, upper, (unpacked(record["inertia_ratio"], *deformation.shape) - 1) / deformation)

    def excess(self, log_area, deformation, ratio):
        """Measured inertia ratio less that of the table's cell; NaN outside the table's areas."""
        place = (log_area - self.least_log_area) / self.step
        is_known = (place >= 0) & (place <= self.columns - 1) & (ratio > 0) & np.isfinite(deformation)
        place = np.where(is_known, place, 0)
        column = np.minimum(place.astype(int), self.columns - 2)
        weights = hermite(place - column)
        lower, upper = self.borders(column, weights)
        log_deformation = np.log(np.where(is_known & (deformation > 0), deformation, 1e-300))
        height = np.clip((log_deformation - lower) / (upper - lower), 0, 1) * (self.rows - 1)
        row = np.minimum(height.astype(int), self.rows - 2)
        expected = np.minimum(deformation, np.exp(upper)) * self.value((column, row), weights, hermite(height - row))
        return np.where(is_known, ratio - 1 - np.where(deformation > 0, expected, 0), np.nan)


@functools.cache  # one of each name
class Table:
    """Young's modulus over area and deformation, in the channel for which it was computed."""
    def __init__(self, name):
        record = data()["tables"][name]
        self.width_um, self.load = record["channel_width_um"], record["flow_rate_ul_per_s"] * record["viscosity_mPas"]
        self.least_log_area, self.step, self.columns = (record[k] for k in ("least_log_area", "column_step", "columns"))
        self.patches = [Stiffness(patch) for patch in record["patches"]]
        self.shapes = Shapes(record["shapes"])

    def answer(self, log_area, log_deformation):
        """ln(kPa), its slopes by ln(area) and ln(deformation), the relative error (4 rows); and the states."""
        place = (log_area - self.least_log_area) / self.step
        state, found = np.full(place.shape, float(TOO_STIFF)), np.full((4, *place.shape), np.nan)
        state[place < 0], state[place > self.columns - 1] = TOO_SMALL, TOO_LARGE
        state[np.isnan(place) | np.isnan(log_deformation)] = NO_DATA
        is_open = state == TOO_STIFF
        place = np.where(is_open, place, 0)
        column = np.minimum(place.astype(int), self.columns - 2)
        fraction = place - column
        for patch in self.patches:
            own = column - patch.first_column
            here = np.flatnonzero(is_open & (own >= 0) & (own < patch.columns - 1))
            own, height = own[here], log_deformation[here]
            lower, upper = patch.borders(own, hermite(fraction[here]))
            is_inside, is_above = (lower <= height) & (height <= upper), height > upper
            take, above = here[is_inside], here[is_above]
            found[:, take] = patch.answer(own[is_inside], fraction[take], height[is_inside])
            state[take] = REGULARISED if patch.regularised else VALID
            state[above] = patch.beyond[own[is_above] + (fraction[above] > 0.5)]
            is_open[here[~is_above]] = False
        found[1] /= self.step
        return found, state


def table_for(settings, exponent):
    """The one that is set, else the one whose liquid is as shear-thinning, else that of a Newtonian liquid."""
    exponents = {name: record["flow_exponent"] for name, record in data()["tables"].items()}
    if settings.look_up_table in exponents:
        return Table(settings.look_up_table)
    nearest = min(exponents, key=lambda name: abs(exponents[name] - exponent))
    if abs(exponents[nearest] - exponent) <= data()["limits"]["flow_exponent_tolerance"]:
        return Table(nearest)
    return Table(next(name for name, own in exponents.items() if own == 1))


def without_pixels(area, deformation, settings, table):
    """ln(area) in the table's channel and deformation, without what pixels do to them, their standard deviations by
    pixels, and the correlation of these (docs/theory-extract.md, eq:pixel-errors)."""
    laws = data()["pixels"]
    area_px = np.clip(area / settings.pixel_size_um ** 2, *laws["areas_px"])
    s, d = area_px ** (-1 / 3), np.clip(deformation, *laws["deformations"])

    def law(name):
        return np.polynomial.polynomial.polyval2d(d, s, laws[name])

    def deviation(name):
        return s * s * np.maximum(law(f"{name}_deviation"), laws[f"least_{name}_deviation"])

    scale = (table.width_um / settings.channel_width_um) ** 2
    return (np.log(area * scale * (1 + s * s * law("area"))), deformation - s * s * law("deformation"),
            deviation("area"), deviation("deformation"), np.clip(law("correlation"), -1, 1))


def modulus(smooth, viscosity, settings, table):
    """Young's moduli and their standard errors (kPa), and the states."""
    log_area, deformation, area_deviation, deformation_deviation, correlation = smooth
    found, state = table.answer(log_area, np.log(np.maximum(deformation, 0)))
    log_kPa, by_log_area, by_log_deformation, error = found
    state[np.isin(state, WITH_MODULUS) & ~np.isfinite(viscosity)] = NO_DATA
    has = np.isin(state, WITH_MODULUS)
    load = settings.flow_rate_ul_s * viscosity / table.load
    kPa = np.where(has, np.exp(log_kPa) * load * (table.width_um / settings.channel_width_um) ** 3, np.nan)
    by_area = by_log_area * area_deviation
    by_deformation = by_log_deformation * deformation_deviation / deformation
    variance = by_area ** 2 + by_deformation ** 2 + 2 * correlation * by_area * by_deformation + error ** 2
    inertia, limits = data()["inertia"], data()["limits"]
    reynolds = inertia["reynolds_number"] * settings.flow_rate_ul_s / (settings.channel_width_um * viscosity)
    standard_error = kPa * np.hypot(np.sqrt(variance), inertia["relative_error"] * reynolds)
    state[has & (reynolds > limits["greatest_reynolds_number"])] = INERTIAL
    is_lost = has & ~(standard_error <= limits["greatest_relative_error"] * kPa)
    kPa[is_lost] = standard_error[is_lost] = np.nan
    state[is_lost] = UNRESOLVED
    return kPa, standard_error, state


def column_of(dataset, name):
    """A feature with one value per event; NaN for what is not a number and behind the end of one that is shorter."""
    values, column = np.asarray(dataset[name][:], dtype=float), np.full(len(dataset), np.nan)
    column[:len(values)] = values[:len(column)]
    return np.where(np.isfinite(column), column, np.nan)


def inertia_ratios(dataset):
    """That are stored, or computed by dclab; NaN where there are neither: moduli do not need them."""
    try:
        return column_of(dataset, "inert_ratio_cvx")
    except Exception:  # such as masks without a contour
        return np.full(len(dataset), np.nan)


def moduli_of(dataset):
    """The features of all events, (5, events)."""
    settings = settings_of(dataset)
    viscosity, exponent = liquid(settings, dataset)
    table = table_for(settings, exponent)
    area, deformation, ratio = column_of(dataset, "area_um"), column_of(dataset, "deform"), inertia_ratios(dataset)
    found = np.full((len(FEATURES), len(dataset)), np.nan)
    for first in range(0, len(dataset), EVENTS_AT_ONCE):
        some = slice(first, first + EVENTS_AT_ONCE)
        smooth = without_pixels(area[some], deformation[some], settings, table)
        found[:3, some] = modulus(smooth, viscosity[some], settings, table)
        found[3, some] = table.shapes.excess(*smooth[:2], ratio[some])
    told = json.loads(sections(dataset, "user")[0].get("rheocyte recommended", "{}"))  # of companions that `rheocyte extract` has written
    found[4] = told.get("young_modulus_median_kPa") or np.nan
    return found


def can_compute(dataset):
    """False, or what the moduli depend on: dclab computes them again when that changes."""
    try:
        return repr(settings_of(dataset))
    except Exception:  # from a plugin it would make all features of all recordings unusable
        return False


def compute(dataset):
    """The features of each event; the modulus to report (kPa) is that of the recording, the same for all."""
    try:
        with np.errstate(all="ignore"):
            found = moduli_of(dataset)
    except Exception:
        logging.getLogger(__name__).exception("There are no moduli of %s.", dataset)
        found = np.full((len(FEATURES), len(dataset)), np.nan)
        found[2] = NO_DATA
    return dict(zip(FEATURES, found))


info = {
    "method": compute,
    "method check required": can_compute,
    "description": "Young's modulus by rheocyte's tables",
    "long description": "Young's modulus of each event from area and deformation with its standard error, corrected for pixels, by the table of "
                        "the medium for the square channel. Recommended: the modulus to report of the recording, in companions of rheocyte "
                        "extract. States: 0 valid, 1 no data, 2 too small, 3 too large, 4 too stiff, 5 too soft, 6 unstable, 7 unresolved; with "
                        "a modulus: 8 regularised, 10 inertial. Shape excess: inertia ratio less that of the table's cell. Medium, viscosity, "
                        "its model and temperature follow the settings of the Young's modulus; the look-up table chosen there does not count, "
                        "unless it is one of those inside this file (HE-3D-26, HE-3D-MC049-26, ...).",
    "feature names": list(FEATURES),
    "feature labels": ["Young's modulus from deformation (rheocyte) [kPa]", "Standard error of Young's modulus (rheocyte) [kPa]",
                       "State of Young's modulus (rheocyte)", "Excess of the inertia ratio (rheocyte)", "Recommended Young's modulus (rheocyte) [kPa]"],
    "features required": ["area_um", "deform"], "scalar feature": [True] * len(FEATURES),
}
