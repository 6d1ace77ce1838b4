"""Tables of Young's moduli over area and deformation: rheocyte's own and published ones."""

from __future__ import annotations

import atexit
import concurrent.futures
import functools
import importlib.util
import os
import tempfile
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rheocyte.arrays import equally_long, number, numbers, positive, truth
from rheocyte.errors import UserError
from rheocyte.native_module import native
from rheocyte.paths import path, word
from rheocyte.progress import progress_bar
from rheocyte.specs import read_spec

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from concurrent.futures import Executor
    from os import PathLike

    from numpy.typing import ArrayLike, NDArray

STATES: tuple[str, ...] = tuple(native.state_names)  # names of the numbers in Moduli.state
_MODEL = "buyukurganci-2022"


class Moduli(NamedTuple):
    """One value per event, arrays of the shape of the events."""

    young_modulus_kPa: np.ndarray  # NaN without a modulus
    young_modulus_kPa_error: np.ndarray  # of pixels and of the table; NaN where the table does not know its error
    state: np.ndarray  # int8, the names are in rheocyte.STATES: 0 valid, 8 regularised, else why there is no modulus

    @property
    def standard_error_kPa(self) -> np.ndarray:
        """Former name of young_modulus_kPa_error."""
        return self.young_modulus_kPa_error


class Shapes(NamedTuple):
    """One value per event, arrays of the shape of the events; NaN where something is missing."""

    expected: np.ndarray  # inertia ratio of the table's cell of this area and deformation
    excess: np.ndarray  # measured - expected inertia ratio
    standard_error: np.ndarray  # of the excess, by pixels
    odd_fraction: np.ndarray  # fraction of the deformation that no ellipse of this inertia ratio has


class TextFiles(NamedTuple):
    """Paths of a table in dclab's format."""

    table: Path  # for dclab.features.emodulus.load.register_lut
    lines: Path  # for dclab.isoelastics.Isoelastics


def table_names() -> list[str]:
    """Names of the tables that come with the package."""
    return sorted(native.table_files())


def dclab_plugin(file: str | PathLike[str]) -> Path:
    """Writes the plugin file that gives dclab and DCscope our moduli, as `rheocyte dclab-plugin` prints it, and returns its
    path. The file holds all that it needs: rheocyte need not be installed where it is used.

    file            where to; an older plugin file of rheocyte is replaced. UserError where another file stands
    """
    program = Path(__file__).with_name("modulus_plugin.py").read_text(encoding="utf-8")
    native.write_dclab_plugin(program, os.fsencode(path(file, "file")))
    return Path(file)


@functools.cache
def _passing_folder():
    """For temporary files: it is removed with the interpreter."""
    folder = tempfile.TemporaryDirectory(prefix="rheocyte-")
    atexit.register(folder.cleanup)
    return folder.name


def place_of_table(name: str | PathLike[str]) -> str:
    """The file of a table of the dclab that is installed for this interpreter; any other name as it is. In bytes: names
    of files need not be UTF-8."""
    wanted = path(name, "the table")
    dclab = importlib.util.find_spec("dclab")
    if dclab and dclab.origin:
        for file in (Path(dclab.origin).parent / "features" / "emodulus").glob("lut_*.txt"):
            if file.name == f"lut_{wanted}.txt":
                return os.fsencode(file)
    return os.fsencode(wanted)


def _piece(text, name, settings, piece, record):
    """What an executor's process does: needs nothing but the package."""
    return native.table_piece(text, name, settings, piece, record)


def _by_executor(executor, spec, folder, tell):
    """The table's pieces by an executor; sentences about what could not be made."""
    pieces, running = native.TablePieces(*spec, folder), {}
    try:
        while not pieces.is_complete():
            for piece, record in pieces.take():
                running[executor.submit(_piece, *spec, piece, record)] = piece
            if not running:
                time.sleep(1)  # other processes work on what is left
            for future in concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED).done:
                pieces.keep(running.pop(future), future.result())
            if tell:
                tell(pieces.fraction_done())
    except concurrent.futures.BrokenExecutor as error:
        raise UserError(f"The executor has broken down ({error}) What is finished is kept: call again.") from error
    finally:
        for future in running:
            future.cancel()
        pieces.give_up()
    return pieces.finish()


def table(spec: str | PathLike[str] | Mapping[str, Any], folder: str | PathLike[str], *, jobs: int | None = None,
          executor: Executor | None = None, progress: bool | Callable[[float], object] | None = None,
          **overrides: Any) -> Table | Path:
    """Computes a whole look-up table, as `rheocyte table` does; goes on where an earlier call was interrupted.

    spec            path of a TOML file, or a dictionary with its keys, nested or dotted (`rheocyte help table`)
    folder          where the table is kept, with its text table, lines and simulations; other processes may help there
    jobs            threads; None: all processors
    executor        a concurrent.futures.Executor that does the work in place of threads, one branch a task: a
                    ProcessPoolExecutor, dask.distributed's Client.get_executor(), mpi4py's MPIPoolExecutor. Its
                    processes need the package, not the folder
    progress        called with the fraction that is done; True: a bar of tqdm where it is installed
    overrides       keys that replace those of the spec, with two underscores for each dot: table__radii=12

    Returns the Table; for cells with bulk and cortex, the folder, which rheocyte.moduli takes. UserError names a wrong
    key, or says that the folder belongs to another spec. Ctrl-C keeps the branches that are complete.
    """
    text, name, settings = read_spec(spec, overrides, "table")
    place, threads = path(folder, "folder"), 0 if jobs is None else positive(jobs, "jobs")
    if executor is not None and jobs is not None:
        raise UserError("An executor has its own number of processes; give executor or jobs.")
    with progress_bar(progress) as tell:
        if executor is not None:
            sentences = _by_executor(executor, (text, name, settings), place, tell)
        else:
            sentences = native.compute_table(text, name, settings, place, int(threads), tell)
    for sentence in sentences:
        warnings.warn(sentence, stacklevel=2)
    if any(Path(folder).glob("grid_*.cbor")) or any(Path(folder).glob("lut_*.txt")):
        return Table(folder)
    return Path(folder)


def viscosity(medium: str, *, channel_width_um: float, flow_rate_ul_s: float, temperature_C: ArrayLike,
              model: str = _MODEL) -> Any:
    """Effective viscosity (mPa s) of a measurement buffer at the wall of the square channel.

    medium          "CellCarrier", "0.49% MC-PBS", "CellCarrierB", "0.83% MC-PBS", "water", ...
    temperature_C   a number or an array; the result has its shape, NaN at temperatures of events that cannot be
    model           "buyukurganci-2022" (doi 10.1039/D2SM01515C) or "herold-2017" (arXiv:1704.00572); water has its own

    UserError for a medium or a model that is not known.
    """
    width, rate = positive(channel_width_um, "channel_width_um"), positive(flow_rate_ul_s, "flow_rate_ul_s")
    celsius = _celsius(temperature_C)
    found = _buffer(medium, model).viscosity(width, rate, celsius.ravel())
    return found.reshape(celsius.shape) if celsius.ndim else float(found[0])


class Table:
    """Young's modulus over area and deformation.

    Table(name="LE-2D-26")    a name of rheocyte.table_names(), a table of an installed dclab ("LE-2D-FEM-19"), the folder
                              or a file of a table of rheocyte, or a file in dclab's format
    Table.for_medium(...)     the table whose liquid is as shear-thinning as a buffer

    rheocyte's own tables know standard errors and correct areas for pixels; published ones give what dclab gives, to
    1e-6. UserError if there is no such table or it is damaged. docs/theory-extract.md holds the equations.
    """

    def __init__(self, name: str | PathLike[str] = "LE-2D-26") -> None:
        self._native = native.Table(place_of_table(name))
        self._origin = self._native.origin()

    @classmethod
    def for_medium(cls, medium: str, *, temperature_C: float = 23.0, model: str = _MODEL) -> Table:
        """The shipped table for a buffer, as `rheocyte extract` chooses it."""
        exponent = _buffer(medium, model).flow_exponent(number(temperature_C, "temperature_C"))
        return cls(native.Table.for_exponent(exponent).origin()["identifier"])

    @property
    def identifier(self) -> str:
        """For example LE-2D-26."""
        return self._origin["identifier"]

    @property
    def is_own(self) -> bool:
        """Whether it is one of rheocyte's own, with errors."""
        return self._origin["is_own"]

    @property
    def origin(self) -> dict[str, Any]:
        """For what it was computed: channel_width_um, flow_rate_ul_s, viscosity_mPas, flow_exponent, model, program, spec."""
        return dict(self._origin)

    def modulus(self, area_um2: ArrayLike, deform: ArrayLike, *, channel_width_um: float, flow_rate_ul_s: float,
                pixel_size_um: float, viscosity_mPas: ArrayLike | None = None, medium: str | None = None,
                temperature_C: ArrayLike | None = None, viscosity_model: str = _MODEL, correct_area: bool = True) -> Moduli:
        """Young's modulus of each event.

        area_um2, deform    as measured, arrays (n,) or numbers; float64 arrays are not copied
        viscosity_mPas      a number or an array (n,); or medium and temperature_C (a number or an array (n,))
        pixel_size_um       what pixels of this size do to area and deformation is taken away; 0: nothing, for areas and
                            deformations without pixels (those of measured contours give moduli that are 20 % too low)
        correct_area        whether that holds for areas, too (own tables only)

        Returns Moduli: young_modulus_kPa, young_modulus_kPa_error, state, arrays (n,). Area and modulus scale to the channel,
        flow and viscosity (docs/theory-extract.md, eq:scaling). UserError for arrays that do not fit.
        """
        area, deformation = numbers(area_um2, "area_um2"), numbers(deform, "deform")
        shape = area.shape
        area, deformation = np.atleast_1d(area), np.atleast_1d(deformation)
        conditions = self._conditions(channel_width_um, flow_rate_ul_s, pixel_size_um, correct_area)
        name, values, buffer = _liquid(viscosity_mPas, medium, temperature_C, viscosity_model)
        arrays = {"area_um2": area, "deform": deformation}
        equally_long(**arrays, **({name: values} if values.size != 1 else {}))
        found = self._native.modulus(area, deformation, values, buffer, conditions)
        return Moduli(*(column.reshape(shape) for column in found))

    def shapes(self, area_um2: ArrayLike, deform: ArrayLike, inertia_ratio: ArrayLike, *, channel_width_um: float,
               pixel_size_um: float, correct_area: bool = True) -> Shapes:
        """The inertia ratios of events against those of the table's cells (docs/theory-extract.md, sec. "Shapes").

        area_um2, deform, inertia_ratio     as measured, arrays (n,) or numbers; the ratio of the convex hull
                                            (inert_ratio_cvx)
        pixel_size_um, correct_area         as modulus

        Returns Shapes: expected, excess, standard_error, odd_fraction, arrays (n,). UserError for arrays that do not fit,
        and for tables that do not know the shapes of their cells (published ones).
        """
        columns = {"area_um2": area_um2, "deform": deform, "inertia_ratio": inertia_ratio}
        arrays = {name: numbers(values, name) for name, values in columns.items()}
        shape = arrays["area_um2"].shape
        arrays = {name: np.atleast_1d(array) for name, array in arrays.items()}
        equally_long(**arrays)
        conditions = self._conditions(channel_width_um, self._origin["flow_rate_ul_s"], pixel_size_um, correct_area)
        return Shapes(*(column.reshape(shape) for column in self._native.shapes(*arrays.values(), conditions)))

    def lines(self, levels_kPa: ArrayLike | None = None, *, pixel_size_um: float, count: int = 11,
              channel_width_um: float | None = None, flow_rate_ul_s: float | None = None,
              viscosity_mPas: float | None = None) -> list[tuple[float, NDArray[np.float64]]]:
        """Isoelasticity lines: a list of pairs (young_modulus_kPa, points), points (n, 2) of area (um2) and deformation.

        levels_kPa      moduli of the lines; else `count` that spread evenly
        channel_width_um, flow_rate_ul_s, viscosity_mPas    of the measurement; else those of the table
        pixel_size_um   the lines run where cells lie in pictures with such pixels; 0: without pixels
        """
        levels = [] if levels_kPa is None else numbers(levels_kPa, "levels_kPa").ravel().tolist()
        if not all(np.isfinite(level) and level > 0 for level in levels):
            raise UserError(f"levels_kPa is {levels_kPa!r}; give moduli above 0.")
        wanted = number(count, "count")
        if not 1 <= wanted <= 1000:
            raise UserError(f"count is {wanted:g}; give a number of lines from 1 to 1000.")
        return self._native.lines(levels, int(wanted), self._seen(channel_width_um, flow_rate_ul_s, viscosity_mPas,
                                                                 pixel_size_um))

    def support(self, *, pixel_size_um: float, channel_width_um: float | None = None, flow_rate_ul_s: float | None = None,
                viscosity_mPas: float | None = None) -> NDArray[np.float64]:
        """Border of the region with moduli: polygon (n, 2) of area (um2) and deformation; arguments as lines."""
        return self._native.support(self._seen(channel_width_um, flow_rate_ul_s, viscosity_mPas, pixel_size_um))

    def texts(self, folder: str | PathLike[str] | None = None) -> TextFiles:
        """Writes the table in dclab's format, and its isoelasticity lines, and returns their paths (TextFiles).

        folder          for lut_<identifier>.txt and iso_<identifier>-area_um-deform.txt; made if it is not there.
                        None: a folder that is removed when the interpreter ends

        Linear interpolation between the rows, as dclab does it, gives the table's modulus to 2e-3 for areas of 50 to 150 um2
        and deformations of 0.005 to 0.04 (or nine tenths of the table's greatest). UserError for a published table, and where a
        file of another program stands.
        """
        place = Path(os.fsdecode(_passing_folder() if folder is None else path(folder, "folder")))
        files = TextFiles(place / f"lut_{self.identifier}.txt", place / f"iso_{self.identifier}-area_um-deform.txt")
        self._native.write_texts(*map(os.fsencode, files))
        return files

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
                                 truth(correct_area, "correct_area"))

    def __repr__(self):
        return f"<Table {self._origin['description']}>"


def _liquid(mPas, medium, temperature_C, model):
    """Name and values of the source of the viscosity, one or one per event, and the buffer if they are its temperatures."""
    if mPas is not None:
        if medium is not None or temperature_C is not None:
            raise UserError("viscosity_mPas and medium exclude each other; give one of them.")
        given = np.atleast_1d(numbers(mPas, "viscosity_mPas"))
        if (given <= 0).any():
            raise UserError(f"viscosity_mPas holds {given.min():g}; it must be above 0 (NaN: unknown).")
        return "viscosity_mPas", given, None
    if medium is None or temperature_C is None:
        raise UserError("the viscosity is missing; give viscosity_mPas, or medium and temperature_C.")
    return "temperature_C", np.atleast_1d(_celsius(temperature_C)), _buffer(medium, model)


def _buffer(medium, model):
    return native.Buffer(word(medium, "medium"), word(model, "the viscosity model"))


def _celsius(temperature_C):
    """Of a buffer in a channel. Of many events some may be wrong, which then have no modulus; a single number may not."""
    celsius = numbers(temperature_C, "temperature_C")
    low, high = native.possible_temperatures_C
    if celsius.size == 1 and not low <= celsius.reshape(())[()] <= high:
        raise UserError(f"temperature_C is {float(celsius.reshape(()))}; a buffer in a channel has {low:g} to {high:g}.")
    return celsius
