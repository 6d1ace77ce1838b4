"""The compiled module, or a sentence that says how to get it."""

try:
    from rheocyte.lib import native
except ImportError as error:  # it is absent, or made for another Python
    raise ImportError(f"the compiled module of rheocyte cannot be loaded ({error}); install the package with "
                      "`pip install .` in the folder of its sources.") from error

__all__ = ["native"]
