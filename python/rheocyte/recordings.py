"""Recordings of RT-DC: Young's moduli of their events, moduli of bulk and cortex, features of masks, virtual ones."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from rheocyte.arrays import number, numbers, positive, truth
from rheocyte.datasets import source_of
from rheocyte.errors import UserError
from rheocyte.native_module import native
from rheocyte.paths import path
from rheocyte.populations import Population, framed_plan
from rheocyte.progress import progress_bar
from rheocyte.settings import filled, gated, with_settings
from rheocyte.specs import read_spec

@with_settings(native.ExtractOptions)
def extract(recording, *, progress=None, **settings):
    """Young's modulus of each event of a recording, as `rheocyte extract` gives it.

    recording       path of an .rtdc file or of a table of events (.csv, .tsv, .txt, .parquet), a DataFrame of pandas with
                    dclab's names of features (docs/text-recordings.md), or an open dclab dataset: its own events (those
                    of a child are the rows) and metadata are taken, also where they are not those of its file
    {settings}
    progress        called with the fraction that is done; True: a bar of tqdm where it is installed

    Returns a pandas.DataFrame with one row per event: area_um2, deformation, viscosity_mPas, young_modulus_kPa,
    young_modulus_kPa_error (without it for published tables), state (a category). Where the recording has inertia ratios,
    contours or masks: shape_excess (inertia ratio - that of the table's cell), shape_excess_error, elongated (a flag),
    odd_fraction (of the deformation). With contours or masks: mode_3, sine_mode_2 .. sine_mode_4 and flank_slope (how the
    outline lies to the flow), and by the table of elongated cells young_modulus_asymmetry_kPa,
    young_modulus_asymmetry_kPa_error, elongation (length over width that the liquid's tension alone would give the cell),
    axial_tension_Pa (of the liquid, along the flow) and their errors; without outlines the modulus is
    young_modulus_inertia_kPa, by area, deformation and inertia ratio (docs/real-cells.md). attrs: units, table,
    settings, settings_hash (the same for frames that are comparable), warnings, shapes (sentences on the shapes of all
    events), recommended (the modulus of the recording that is to be reported, a dict of the columns "recommended_..." of
    the summary table: modulus is "deformation", "elongated", "effective" or "none", young_modulus_median_kPa, its standard
    errors young_modulus_median_kPa_error by the scatter of the events and young_modulus_median_kPa_common_error that all
    events have in common, text the sentence; None for what is not known).

    UserError for what is wrong with the recording, naming what it lacks. It is read in a child of this process, for HDF5 is
    known to break down on some damaged files.
    """
    options = filled(native.ExtractOptions(), settings)
    with source_of(recording, gated(settings)) as source, progress_bar(progress) as tell:
        (columns, said), attributes = native.extract(source.place, options, tell)
    return _framed(columns, said, attributes, source)


@with_settings(native.ModuliOptions)
def moduli(recording, table=None, *, progress=None, **settings):
    """Moduli of bulk and cortex of each cell from its contour, as `rheocyte moduli` gives them.

    recording       as for extract
    table           combined table: a folder of rheocyte.table (examples/tables/combined.toml), its combined_*.cbor, or the
                    name of one that comes with the package; None: HC-2D-NH-26, of elongated cells
    {settings}
    progress        as for extract

    Returns a pandas.DataFrame: area_um2, deformation, viscosity_mPas, young_modulus_kPa, cortex_modulus_mN_per_m,
    tension_mN_per_m, stiffness_kPa and effective_modulus_kPa (bulk, cortex and tension together) with their standard
    errors, chi_squared, status, section_factor (c3 over that in the tube). attrs: settings, settings_hash, warnings.
    """
    options = filled(native.ModuliOptions(), settings)
    options.table = path("" if table is None else table, "table")
    with source_of(recording, gated(settings)) as source, progress_bar(progress) as tell:
        (columns, said), attributes = native.moduli(source.place, options, tell)
    return _framed(columns, said, attributes, source)


@with_settings(native.TimeCourseOptions)
def time_course(recordings, table=None, contraction_um=None, *, progress=None, **settings):
    """Young's modulus and viscosity of cells from how c3 changes along the channel, as `rheocyte time-course` does.

    recordings      one, or several of one population, as for extract
    table           dynamic table: the folder of one that `rheocyte table` has made, or its dynamic_*.cbor; None:
                    HE-chip-26, which comes with the package, of a square channel behind a funnel of 45 degrees
    contraction_um  pos_x of the end of the contraction, from which the cells come; one for all, or one each
    {settings}
    progress        as for extract

    Returns a pandas.DataFrame with one row per cell that was seen over at least 20 um: places, radius_um,
    young_modulus_kPa and viscosity_Pas with the ends of their 90 % intervals, chi_squared, section_factor (c3 over that in
    the tube), section_error (relative, of E, within its interval), status, event_numbers. attrs: settings, population
    (sentences; of at least 50 cells, also of those that were seen once). UserError says why single
    images, or pictures at one place, do not determine a viscosity.
    """
    import pandas

    if contraction_um is None:
        raise UserError("contraction_um is missing: pos_x (um) of the end of the contraction through which the cells enter the channel.")
    several = _several(recordings)
    if not several:
        raise UserError("recordings is empty; give one recording or several of one population.")
    places = np.atleast_1d(numbers(contraction_um, "contraction_um"))
    if len(places) not in (1, len(several)):
        raise UserError(f"contraction_um has {len(places)} places for {len(several)} recordings; give one, or one each.")
    each = [number(place, "contraction_um") for place in np.broadcast_to(places, len(several))]
    options = filled(native.TimeCourseOptions(), settings)
    with ExitStack() as stack, progress_bar(progress) as tell:
        sources = [stack.enter_context(source_of(recording, gated(settings))) for recording in several]
        columns, told, lines = native.time_course([source.place for source in sources], path("" if table is None else table, "table"), each, options, tell)
    for source in sources:
        columns["recording"] = [source.named(name) for name in columns["recording"]]
        told, lines = [source.named(line) for line in told], source.told(lines)
    frame = pandas.DataFrame(columns)
    frame.attrs.update(settings=told, population=lines)
    return frame


@with_settings(native.PopulationOptions)
def population(conditions, *, progress=None, **settings):
    """Mechanics of the cells of recordings, and whether conditions differ, as by `rheocyte population`.

    conditions      dictionary of conditions and their recordings (lists of what extract takes); the first one is that with
                    which others are compared
    {settings}
    progress        as for extract

    Returns a Population with the DataFrames recordings, conditions and comparisons, the methods events(), check() and
    plot(), and all of population.json as record (docs/populations.md). Recordings without a number say why in their column
    failure. UserError for what is wrong with a recording or the conditions.
    """
    if hasattr(conditions, "to_dict"):  # a pandas.Series
        conditions = conditions.to_dict()
    if not isinstance(conditions, Mapping) or not conditions or not all(isinstance(name, str) for name in conditions):
        raise UserError('conditions must be a dictionary of names and recordings, such as {"control": ["A.rtdc"]}.')
    options = filled(native.PopulationOptions(), settings)
    with ExitStack() as stack, progress_bar(progress) as tell:
        sources = [(name, [stack.enter_context(source_of(each, gated(settings))) for each in _several(recordings)])
                   for name, recordings in conditions.items()]
        found = native.population([(name, [source.place for source in of]) for name, of in sources], options, tell)
    return Population(*_renamed(found, [source for _, of in sources for source in of]))


def _renamed(found, sources):
    """The same lists and dictionaries, with the names of the recordings in their texts."""
    if isinstance(found, str):
        for source in sources:
            found = source.named(found)
        return found
    if isinstance(found, dict):
        return {name: _renamed(value, sources) for name, value in found.items()}
    return [_renamed(value, sources) for value in found] if isinstance(found, (list, tuple)) else found


@with_settings(native.PlanOptions)
def plan(radius_um, young_modulus_kPa, **settings):
    """Which channel, flow rate and medium show a difference between conditions, as `rheocyte plan` says.

    {settings}

    Several widths, media and rates are compared, each with each. Returns a pandas.DataFrame with one row per channel: speed,
    viscosity, stress at the wall, deformation and mode_3 of the median cell, inside_fraction (of the cells, inside the table),
    the error of ln E by one image, sessions that are needed (inf: more than 100; NaN: the table has no such cells, or they are
    too stiff to be seen), and the Reynolds number. attrs["lines"]: what is recommended, and what limits. UserError for a
    number that makes no sense, and where no channel shows the cells.
    """
    cell = {"radius_um": number(radius_um, "radius_um"), "young_modulus_kPa": number(young_modulus_kPa, "young_modulus_kPa")}
    return framed_plan(*native.plan(filled(native.PlanOptions(), {**cell, **settings})))


def _several(recordings):
    if hasattr(recordings, "tolist"):  # arrays and columns
        recordings = recordings.tolist()
    return list(recordings) if isinstance(recordings, (list, tuple, set, frozenset, Iterator)) else [recordings]


def synth(spec, file, *, replace=False, progress=None, **overrides):
    """Makes a virtual recording (.rtdc) of a population of cells, as `rheocyte synth` does.

    spec            path of a TOML file, or a dictionary with its keys, nested or dotted (`rheocyte help synth`)
    file            the recording; replace: one that is there already
    progress        called with the fraction that is done; True: a bar of tqdm where it is installed
    overrides       keys that replace those of the spec, with two underscores for each dot: recording__cells=1000

    The features userdef1 to userdef6 (userdef9 with recording.places_um) hold the true values. Returns the number of
    events. UserError names a wrong key.
    """
    place = Path(path(file, "file"))
    text, name, settings = read_spec(spec, overrides, "synth")
    if place.suffix != ".rtdc":
        raise UserError(f"{place}: recordings have names that end in .rtdc.")
    if place.exists() and not (truth(replace, "replace") and place.is_file()):
        raise UserError(f"{place}: already exists; give another name, or replace=True for a file.")
    with progress_bar(progress) as tell:
        return native.synth(text, name, settings, str(place), tell)


def features(masks, pixel_size_um):
    """Features of the shape from masks, as dclab defines them (docs/theory-extract.md, sec. "features").

    masks           boolean or integer array (events, rows, columns), or (rows, columns) of one event; anything but 0
                    belongs to the cell, of which the longest outline counts
    pixel_size_um   size of a pixel

    Returns a pandas.DataFrame with one row per event, NaN where there is no cell. Of the convex hull: area_um (um2),
    area_cvx (pixels), deform, circ, pos_x, pos_y (um), inert_ratio_cvx. Of the outline: area_msd (pixels), area_um_raw
    (um2), deform_raw, per_um_raw (um), inert_ratio_raw, inert_ratio_prnc, eccentr_prnc, tilt (radian), volume (um3),
    size_x, size_y (um), aspect. Of both: area_ratio, per_ratio. Cosine modes of the hull's radius: mode_2 .. mode_7; how
    it lies to the flow, for cells that move along +x and do not touch the border: sine_mode_2 .. sine_mode_4, flank_slope.
    """
    import pandas

    try:
        array = np.asarray(masks)
    except (TypeError, ValueError, RuntimeError) as error:
        raise UserError(f"masks is not an array: {error}.") from error
    if array.dtype.kind not in "biu" or array.ndim not in (2, 3) or 0 in array.shape[-2:]:
        raise UserError(f"masks has the type {array.dtype} and the shape {array.shape}; it must be booleans or whole "
                        "numbers (events, rows, columns).")
    size = positive(pixel_size_um, "pixel_size_um")
    as_bytes = array.view(np.uint8) if array.dtype.itemsize == 1 else (array != 0).view(np.uint8)
    as_bytes = np.ascontiguousarray(as_bytes).reshape(-1, *array.shape[-2:])
    names, columns = native.features(as_bytes, size)
    return pandas.DataFrame(columns.T, columns=names)  # one block, nothing is copied


def _framed(columns, said, attributes, source):
    """The columns of the events of a recording, and in attrs what is said about them."""
    import pandas

    for name in {"settings", "shapes", "warnings"} & {*attributes}:
        attributes[name] = source.told(attributes[name])
    attributes["warnings"] += source.warnings
    for name, column in columns.items():
        if name in said["words"]:
            columns[name] = pandas.Categorical.from_codes(column, said["words"][name])
        elif column.dtype == np.int8:
            columns[name] = column.astype(bool)
    frame = pandas.DataFrame(columns, copy=False)
    frame.attrs.update(attributes, units=said["units"])
    return frame
