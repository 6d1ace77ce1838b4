"""The way of a cell in time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rheocyte.cases import Case
from rheocyte.errors import NoStateError
from rheocyte.native_module import native
from rheocyte.states import Result
from rheocyte.worker_threads import threads_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    import pandas


def evolve(case: Case | str | PathLike[str] | Mapping[str, Any] | None = None, *, threads: int | None = None,
           **overrides: Any) -> Evolution:
    """Follows a cell from the sphere in time; the case needs time.end_us (or end_um) and cell.viscosity_mPas.

    case       a Case, the path of a case file, a dictionary or None; keywords replace its keys as for Case
    threads    at most, as for rheocyte.solve

    Returns an Evolution, an iterator of the states at 0, time.output_every_us (or _um), ..., the end. It computes in a thread
    of its own, ahead of the loop. Equations and schemes stand in docs/theory-time.md.

    >>> for state in rheocyte.evolve("examples/paper-cell-in-time.toml"):
    ...     print(state.t_us, state.deformation)
    """
    if not isinstance(case, Case) or overrides:
        case = Case(case, **overrides)
    return Evolution(case, threads)


class State:
    """A cell at an output: t_us, position_um, contour (array (n, 2) of x and r in um), deformation, area_um2, ...

    The numbers have the names of result.json. outlines: in a duct "across" and, off the axis, "offset", as Result.outlines.
    """

    def __init__(self, numbers: dict[str, Any]) -> None:
        numbers["contour"][:, 1] = np.maximum(numbers["contour"][:, 1], 0)
        self.__dict__.update(numbers)

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any: ...  # numbers with the names of result.json

    def __repr__(self):
        return f"<State at {self.t_us:g} us: deformation {self.deformation:.6f}>"


class Evolution:
    """Iterator of the states of rheocyte.evolve.

    evolution.history    numbers of all steps so far, a pandas.DataFrame with the columns of history.csv
    evolution.errors     errors of these numbers, a pandas.DataFrame with the columns of history_errors.csv; waits for the end
    evolution.result     the last state, a Result; waits for the end
    evolution.stop()     ends the computation; so does Ctrl-C in a loop, and what was computed stays

    A numerical failure ends the iteration; `result.status` and `result.message` give the reason, and `check()` raises
    it as NoStateError.
    """

    def __init__(self, case: Case, threads: int | None = None) -> None:
        self._case = case
        self._native = native.Evolution(case._values, threads_of(threads))
        self._waiting = []

    def __iter__(self) -> Evolution:
        return self

    def __next__(self) -> State:
        if self._waiting:
            return self._waiting.pop(0)
        numbers = self._native.next()
        if numbers is None:
            raise StopIteration
        return State(numbers)

    @property
    def history(self) -> pandas.DataFrame:
        """A pandas.DataFrame with one row for each step in time so far; the columns are those of history.csv."""
        import pandas

        return pandas.DataFrame(self._native.history())

    @property
    def errors(self) -> pandas.DataFrame:
        """Estimated errors of the history, row by row, a pandas.DataFrame with the columns of history_errors.csv.

        Waits for the end of the computation; no rows where they are not known.
        """
        import pandas

        self._wait()
        return pandas.DataFrame(self._native.history_errors())

    def _wait(self):
        while (numbers := self._native.next()) is not None:
            self._waiting.append(State(numbers))

    @property
    def result(self) -> Result:
        """The last state with all its numbers; waits for the end of the computation."""
        self._wait()
        return Result(self._native.result(), self._case)

    def check(self) -> Evolution:
        """Waits for the end; NoStateError if it is not that of the case."""
        result = self.result
        if not result.converged:
            raise NoStateError(result)
        return self

    def stop(self) -> None:
        """Ends the computation with the present step; what was computed stays."""
        self._native.stop()

    def __repr__(self):
        return f"<Evolution: {'complete' if self._native.is_over() else 'under way'}>"
