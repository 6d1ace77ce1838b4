"""Stationary states: solving a case, and what is known of its state."""

from __future__ import annotations

import base64
import io
import json
import os
import threading
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from rheocyte import paths
from rheocyte.arrays import number
from rheocyte.cases import Case
from rheocyte.errors import NoStateError, UserError
from rheocyte.memory_file import written
from rheocyte.native_module import native
from rheocyte.progress import told_to
from rheocyte.worker_threads import threads_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, KeysView, Mapping
    from os import PathLike

    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from rheocyte.vtu import Fields

    _Source = Case | str | PathLike[str] | Mapping[str, Any] | None

_DEFAULT_MEMORY_MB = 256


def solve(case: _Source = None, *, check: bool = False, progress: Callable[[dict[str, float]], object] | None = None,
          gradient: str | Iterable[str] = (), threads: int | None = None, **overrides: Any) -> Result:
    """The stationary shape of a cell, from the sphere to the requested stiffness by itself.

    case        a Case, the path of a case file, a dictionary or None; keywords replace its keys as for Case
    check       raise NoStateError where the state does not exist or was not reached; else the Result says so in
                `status` and `message`, and holds the last state on the way
    progress    called after each step with a dictionary (compliance, deformation, newton_iterations, degree)
    gradient    keys of the case by which all numbers of the result are differentiated, or "all": Result.gradient
    threads     at most; the numbers do not depend on it. None: all processors, as far as the work pays for them, but one in
                threads and processes that others have started, as those of pools

    Returns a Result. UserError for a case that is wrong; Ctrl-C ends the computation.
    The equations stand in docs/theory.md.

    >>> rheocyte.solve("examples/paper-cell.toml").deformation
    """
    return Session(memory_MB=0).solve(case, check=check, progress=progress, gradient=gradient, threads=threads,
                                    **overrides)


class Session:
    """Solves one case after another and keeps meshes, factors and states: a case near an earlier one starts from there.

    Session(memory_MB=256)    the latest states are kept up to this size

    Threads may share a session, but then wait for each other; give each one of its own. A computation does not hold
    Python's lock.
    """

    def __init__(self, memory_MB: float = _DEFAULT_MEMORY_MB) -> None:
        size = number(memory_MB, "memory_MB")
        if not 0 <= size < 1e9:
            raise UserError(f"Session: memory_MB is {size:g}; give a size from 0 on.")
        self._native = native.Session(int(size * 2**20))

    def solve(self, case: _Source = None, *, check: bool = False, progress: Callable[[dict[str, float]], object] | None = None,
              gradient: str | Iterable[str] = (), threads: int | None = None, **overrides: Any) -> Result:
        """As rheocyte.solve, from a kept state if one is near; the answer is the same up to rounding and tolerance."""
        keys = [gradient] if isinstance(gradient, str) else [str(key) for key in gradient]
        if not isinstance(case, Case) or overrides:
            case = Case(case, **overrides)
        result = Result(self._native.solve(case._values, keys, told_to(progress), threads_of(threads)), case)
        if check and not result.converged:
            raise NoStateError(result)
        return result

    @property
    def warm_starts(self) -> int:
        """How many answers started from a kept state."""
        return self._native.warm_starts()

    @property
    def memory_bytes(self) -> int:
        """Size of what is kept, about."""
        return self._native.memory_bytes()

    def __repr__(self):
        return f"<Session: {self.warm_starts} warm starts, {self.memory_bytes / 2**20:.0f} MB kept>"


class Result:
    """A state of cell and liquid, with every number of result.json as an attribute (docs/result-reference.md).

    result.deformation, result.area_um2, result.cell_velocity_m_per_s, ...; None where there is no such number
    result.converged       whether it is the state that was asked for; else `status` and `message` say why not
    result.case            the case as a dictionary; `problem` is the Case itself
    result.contour         meridian, array (n, 2): x along the channel from the barycentre, r >= 0 from the axis, in um,
                           from the front pole to the rear one
    result.outlines        of a cell in a duct, what else is seen of it: from the side, along the diagonal; off the axis
    result.surface         columns of contour.csv by their names: stretches, tensions (mN/m), curvatures (1/um)
    result.gradient        derivatives by keys of the case, of solve(..., gradient=[...]):
                           result.gradient["cell.radius_um"]["deformation"] is in 1/um; None where there is none
    result.surface_gradient(key)   those of the columns of `surface`
    result.fields()        velocity, pressure, stress, displacement in cell and liquid
    result.plot()          the picture, a matplotlib figure
    """

    def __init__(self, computed: Any, case: Case) -> None:
        self._native = computed
        self._case = Case(case)
        self._known = None
        self._lock = threading.Lock()

    @property
    def _numbers(self):
        if self._known is None:
            self._known = self._native.numbers()
        return self._known

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._numbers:
            raise AttributeError(f"a result has no {name!r}; its numbers are {', '.join(self.__dict__.get('_known') or ())}")
        return self._numbers[name]

    def __getitem__(self, name: str) -> Any:
        return self._numbers[name]

    def keys(self) -> KeysView[str]:
        """Names of the numbers, those of result.json."""
        return self._numbers.keys()

    def __iter__(self) -> Iterator[str]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    def __dir__(self):
        return sorted({*super().__dir__(), *self._numbers})

    def to_dict(self) -> dict[str, Any]:
        """The content of result.json."""
        return self._native.numbers()

    @property
    def status(self) -> str:
        """"converged", or the name of the reason why not."""
        return self._native.status()

    @property
    def converged(self) -> bool:
        """Whether it is the state that was asked for."""
        return self.status == "converged"

    @property
    def problem(self) -> Case:
        """The Case that was solved."""
        return self._case

    @property
    def surface(self) -> dict[str, NDArray[np.float64]]:
        """Columns of contour.csv: dictionary of arrays (n,) by names with units, from the front pole to the rear one."""
        return self._native.surface()

    @property
    def contour(self) -> NDArray[np.float64]:
        """Meridian, array (n, 2) of x and r >= 0 in um, x from the barycentre along the flow; n = 0 without a state."""
        surface = self.surface
        return np.stack([surface["x_um"], surface["r_um"]], axis=1)

    @property
    def outlines(self) -> dict[str, NDArray[np.float64]]:
        """Of a cell in a duct, dictionary of arrays (n, 2) in um, x from the barycentre along the flow; empty in a tube.

        On the axis "side", and "diagonal" (square) or "across" (rectangle, funnel: seen along the width): halves as `contour`,
        from the front pole to the rear one. Off the axis "offset": the closed convex outline in the plane of the offset, y
        from the axis along the offset.
        """
        return self._native.outlines()

    @property
    def gradient(self) -> dict[str, dict[str, float | None]]:
        """Derivatives of the measures: dictionary by keys of the case of dictionaries by measures.

        Each in the unit of the measure over that of the key, of the numbers as they are computed, on their mesh; None where
        a measure has no number. Empty unless `gradient` was given to solve, and None for all measures of a state that did
        not converge.
        """
        return self._numbers["gradients"]

    def surface_gradient(self, key: str) -> dict[str, NDArray[np.float64]]:
        """Derivatives of the columns of `surface` by a key of the case: dictionary of arrays (n,) by their names.

        Each in the unit of the column over that of the key, at the same material points of the cell: x_um and r_um
        describe how the contour moves. UserError for a key that was not among `gradient` of solve.
        """
        if key not in self.gradient:
            raise UserError(f"surface_gradient: there is no gradient by {key!r}; give it to solve(..., gradient=[...]).")
        return self._native.surface_gradient(list(self.gradient).index(key))

    @overload
    def fields(self, x_um: None = None, r_um: None = None) -> Fields: ...
    @overload
    def fields(self, x_um: ArrayLike, r_um: ArrayLike) -> dict[str, NDArray[np.float64]]: ...
    def fields(self, x_um=None, r_um=None):
        """Fields of cell and liquid in the half section r >= 0.

        Without arguments those of the mesh, rheocyte.vtu.Fields: points (N, 3) in um, elements (n, p + 1, p + 1), data
        by name. With two arrays of equidistant places a dictionary of arrays (len(r_um), len(x_um)), NaN outside the
        channel; vectors are (rows, columns, 2).

        velocity (m/s, laboratory), velocity_relative (m/s, to the cell), pressure (Pa, 0 in the undisturbed flow at the
        cell), stress (Pa, von Mises, in the cell), shear_stress (Pa, in the liquid), displacement (um), region (0
        liquid, 1 cell). UserError if there is no state.
        """
        from rheocyte import field_arrays, vtu

        fields = vtu.read_grid(self._vtu(), field_arrays.NAMES)
        if x_um is None and r_um is None:
            return fields
        return field_arrays.on_grid(fields, x_um, r_um)

    def save_fields(self, path: str | PathLike[str]) -> None:
        """Writes the fields as a .vtu file for ParaView, PyVista or meshio."""
        target, content = paths.path(path, "the file of the fields"), self._vtu()
        try:
            with open(target, "wb") as file:
                file.write(content)
        except OSError as error:
            raise UserError(f"{target} cannot be written: {error.strerror}.") from error

    def _vtu(self):
        if not self._native.has_state():
            raise UserError(f"this result has no fields: {self.message}")
        content, is_whole = written(self._native.write_fields)
        if not is_whole:
            raise MemoryError("the fields do not fit into memory")
        return content

    def plot(self) -> Figure:
        """The picture of `rheocyte solve`: cell, flow and stress; a matplotlib figure."""
        from rheocyte import duct_picture, picture, tube_picture

        if picture.is_in_duct(self.to_dict()):
            return duct_picture.draw(duct_picture.story_of(self.to_dict(), self.fields()))
        story = tube_picture.story_of(self.to_dict(), self.contour, self.fields(), self._shell_tension())
        return tube_picture.draw(story)

    def _shell_tension(self):
        return self.surface["tension_meridional_mN_per_m"] if self.case["cell"]["bulk"]["law"] == "none" else None

    def _repr_html_(self):
        """Picture and numbers for notebooks."""
        if not self._native.has_state():
            return f"<p><b>{self.status}</b>: {self.message}</p>"
        with self._lock:
            file = io.BytesIO()
            self.plot().savefig(file, format="png", dpi=200)
        text = base64.b64encode(file.getvalue()).decode()
        return f'<img style="width: 100%; max-width: 640px" src="data:image/png;base64,{text}" alt="{self!r}">'

    def __repr__(self):
        if not self._native.has_state():
            return f"<Result: {self.status}>"
        return f"<Result: {self.status}, deformation {self.deformation:.6f}, area {self.area_um2:.3f} um2>"
