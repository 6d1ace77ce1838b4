"""Tables of Young's moduli over area and deformation: rheocyte's own and published ones."""

import importlib.util
import os
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rheocyte.arrays import equally_long, number, numbers, positive
from rheocyte.errors import UserError
from rheocyte.native_module import native
from rheocyte.progress import progress_bar
from rheocyte.specs import read_spec

STATES = tuple(native.state_names)  # names of the numbers in Moduli.state
_MODEL = "buyukurganci-2022"


class Moduli(NamedTuple):
    """One value per event, arrays of the shape of the events."""

    young_modulus_kPa: np.ndarray  # NaN without a modulus
    standard_error_kPa: np.ndarray  # of pixels and of the table; NaN where the table does not know its error
    state: np.ndarray  # int8, the names are in rheocyte.STATES: 0 valid, 8 regularised, else why there is no modulus


def table_names():
    """Names of the tables that come with the package."""
    return sorted(native.table_files())


def place_of_table(name):
    """The file of a table of the dclab that is installed for this interpreter; any other name as it is."""
    dclab = importlib.util.find_spec("dclab")
    if dclab and dclab.origin and os.sep not in os.fspath(name):
        file = Path(dclab.origin).parent / "features" / "emodulus" / f"lut_{os.fspath(name)}.txt"
        if file.is_file():
            return str(file)
    return os.fspath(name)


def table(spec, folder, *, jobs=None, progress=None, **overrides):
    """Computes a whole look-up table, as `rheocyte table` does; goes on where an earlier call was interrupted.

    spec            path of a TOML file, or a dictionary with its keys, nested or dotted (`rheocyte help table`)
    folder          where the table is kept, with its text table, lines and simulations; other processes may help there
    jobs            threads; None: all processors
    progress        called with the share that is done; True: a bar of tqdm where it is installed
    overrides       keys that replace those of the spec, with two underscores for each dot: table__radii=12

    Returns the Table; for cells with bulk and cortex, the folder, which rheocyte.moduli takes. UserError names a wrong
    key, or says that the folder belongs to another spec. Ctrl-C keeps the branches that are complete.
    """
    text, name, settings = read_spec(spec, overrides, "table")
    with progress_bar(progress) as tell:
        for sentence in native.compute_table(text, name, settings, os.fspath(folder), jobs or 0, tell):
            warnings.warn(sentence, stacklevel=2)
    if any(Path(folder).glob("grid_*.cbor")) or any(Path(folder).glob("lut_*.txt")):
        return Table(folder)
    return Path(folder)


def viscosity(medium, *, channel_width_um, flow_rate_ul_s, temperature_C, model=_MODEL):
    """Effective viscosity (mPa s) of a measurement buffer at the wall of the square channel.

    medium          "CellCarrier", "0.49% MC-PBS", "CellCarrierB", "0.83% MC-PBS", "water", ...
    temperature_C   a number or an array; the result has its shape
    model           "buyukurganci-2022" (doi 10.1039/D2SM01515C) or "herold-2017" (arXiv:1704.00572); water has its own

    UserError for a medium or a model that is not known.
    """
    width, rate = positive(channel_width_um, "channel_width_um"), positive(flow_rate_ul_s, "flow_rate_ul_s")
    celsius = numbers(temperature_C, "temperature_C")
    found = native.Buffer(str(medium), str(model)).viscosity(width, rate, celsius.ravel())
    return found.reshape(celsius.shape) if celsius.ndim else float(found[0])


class Table:
    """Young's modulus over area and deformation.

    Table(name="LE-2D-26")    a name of rheocyte.table_names(), a table of an installed dclab ("LE-2D-FEM-19"), the folder
                              or a file of a table of rheocyte, or a file in dclab's format
    Table.for_medium(...)     the table whose liquid is as shear-thinning as a buffer

    rheocyte's own tables know standard errors and correct areas for pixels; published ones give what dclab gives, to
    1e-6. UserError if there is no such table or it is damaged. docs/theory-extract.md holds the equations.
    """

    def __init__(self, name="LE-2D-26"):
        if not isinstance(name, (str, os.PathLike)):
            raise UserError(f"Table: {name!r} is no name of a table and no path.")
        self._native = native.Table(place_of_table(name))
        self._origin = self._native.origin()

    @classmethod
    def for_medium(cls, medium, *, temperature_C=23.0, model=_MODEL):
        """The shipped table for a buffer, as `rheocyte extract` chooses it."""
        exponent = native.Buffer(str(medium), str(model)).flow_exponent(number(temperature_C, "temperature_C"))
        return cls(native.Table.for_exponent(exponent).origin()["identifier"])

    identifier = property(lambda self: self._origin["identifier"], doc="For example LE-2D-26.")
    is_own = property(lambda self: self._origin["is_own"], doc="Whether it is one of rheocyte's own, with errors.")

    @property
    def origin(self):
        """For what it was computed: channel_width_um, flow_rate_ul_s, viscosity_mPas, flow_exponent, model, program, spec."""
        return dict(self._origin)

    def modulus(self, area_um2, deform, *, channel_width_um, flow_rate_ul_s, viscosity_mPas=None, medium=None,
                temperature_C=None, viscosity_model=_MODEL, pixel_size_um=0.0, correct_area=True):
        """Young's modulus of each event.

        area_um2, deform    as measured, arrays of one length or numbers; float64 arrays are not copied
        viscosity_mPas      a number or one per event; or medium and temperature_C (a number or one per event)
        pixel_size_um       what pixels of this size do to area and deformation is taken away; 0: nothing
        correct_area        whether that holds for areas, too (own tables only)

        Returns Moduli: young_modulus_kPa, standard_error_kPa, state. Area and modulus scale to the channel, flow and
        viscosity (docs/theory-extract.md, eq:scaling). UserError for arrays that do not fit.
        """
        area, deformation = numbers(area_um2, "area_um2"), numbers(deform, "deform")
        shape = area.shape
        area, deformation = np.atleast_1d(area), np.atleast_1d(deformation)
        conditions = self._conditions(channel_width_um, flow_rate_ul_s, pixel_size_um, correct_area)
        mPas = _viscosity(viscosity_mPas, medium, temperature_C, viscosity_model, channel_width_um, flow_rate_ul_s)
        arrays = {"area_um2": area, "deform": deformation}
        equally_long(**arrays, **({"viscosity": mPas} if mPas.size != 1 else {}))
        found = self._native.modulus(area, deformation, mPas, conditions)
        return Moduli(*(column.reshape(shape) for column in found))

    def lines(self, levels_kPa=None, *, count=11, channel_width_um=None, flow_rate_ul_s=None, viscosity_mPas=None,
              pixel_size_um=0.0):
        """Isoelasticity lines: a list of pairs (young_modulus_kPa, points), points (n, 2) of area (um2) and deformation.

        levels_kPa      moduli of the lines; else `count` that spread evenly
        channel_width_um, flow_rate_ul_s, viscosity_mPas    of the measurement; else those of the table
        pixel_size_um   the lines run where cells lie in pictures with such pixels; 0: without pixels
        """
        levels = [] if levels_kPa is None else np.atleast_1d(numbers(levels_kPa, "levels_kPa")).tolist()
        if not all(np.isfinite(level) and level > 0 for level in levels):
            raise UserError(f"levels_kPa is {levels_kPa!r}; give moduli above 0.")
        if not 1 <= count <= 1000:
            raise UserError(f"count is {count!r}; give a number of lines from 1 to 1000.")
        return self._native.lines(levels, int(count), self._seen(channel_width_um, flow_rate_ul_s, viscosity_mPas,
                                                                 pixel_size_um))

    def support(self, *, channel_width_um=None, flow_rate_ul_s=None, viscosity_mPas=None, pixel_size_um=0.0):
        """Border of the region with moduli: polygon (n, 2) of area (um2) and deformation; arguments as lines."""
        return self._native.support(self._seen(channel_width_um, flow_rate_ul_s, viscosity_mPas, pixel_size_um))

    def _seen(self, width, rate, mPas, pixel):
        own = self._origin
        conditions = self._conditions(own["channel_width_um"] if width is None else width,
                                      own["flow_rate_ul_s"] if rate is None else rate, pixel, True)
        conditions.set_viscosity(positive(own["viscosity_mPas"] if mPas is None else mPas, "viscosity_mPas"))
        return conditions

    @staticmethod
    def _conditions(width, rate, pixel, correct_area):
        pixel = number(pixel, "pixel_size_um")
        if pixel < 0:
            raise UserError(f"pixel_size_um is {pixel:g}; give a size in um, or 0.")
        return native.Conditions(positive(width, "channel_width_um"), positive(rate, "flow_rate_ul_s"), pixel,
                                 bool(correct_area))

    def __repr__(self):
        return f"<Table {self._origin['description']}>"


def _viscosity(mPas, medium, temperature_C, model, width, rate):
    """One value, or one per event."""
    if mPas is not None:
        if medium is not None or temperature_C is not None:
            raise UserError("viscosity_mPas and medium exclude each other; give one of them.")
        return np.atleast_1d(numbers(mPas, "viscosity_mPas"))
    if medium is None or temperature_C is None:
        raise UserError("the viscosity is missing; give viscosity_mPas, or medium and temperature_C.")
    return np.atleast_1d(viscosity(medium, channel_width_um=width, flow_rate_ul_s=rate, temperature_C=temperature_C,
                                   model=model))
