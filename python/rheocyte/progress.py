"""How far a long computation has come."""

from rheocyte.errors import UserError


def told_to(progress):
    """The caller's function, or None; UserError for anything else."""
    if progress is not None and not callable(progress):
        raise UserError(f"progress is {progress!r}; give a function.")
    return progress


class progress_bar:
    """A function of the fraction that is done: the caller's, a bar of tqdm, or none."""

    def __init__(self, progress):
        self._call, self._bar = None if isinstance(progress, bool) else told_to(progress), None
        if progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=100, unit="%")
            self._call = lambda fraction: self._bar.update(100 * fraction - self._bar.n)

    def __enter__(self):
        return self._call

    def __exit__(self, *_):
        if self._bar is not None:
            self._bar.close()
