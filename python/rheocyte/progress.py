"""How far a long computation has come."""


class progress_bar:
    """A function of the share that is done: the caller's, a bar of tqdm, or none."""

    def __init__(self, progress):
        self._call, self._bar = progress if callable(progress) else None, None
        if progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=100, unit="%")
            self._call = lambda share: self._bar.update(100 * share - self._bar.n)

    def __enter__(self):
        return self._call

    def __exit__(self, *_):
        if self._bar is not None:
            self._bar.close()
