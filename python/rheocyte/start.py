"""How the program runs a module of this package: python3 -I -c CODE FOLDER MODULE [ARGUMENT...].

CODE (src/store/python_package.cc) puts FOLDER, that of the package, in front of Python's own module path and calls
main(). Without arguments the module is loaded at once and awaits them on standard input, each followed by NUL, until
its end: the program starts it while there is nothing to draw yet. It draws nothing if none come.
"""

import contextlib
import importlib
import os
import signal
import sys

try:
    import resource
except ImportError:  # Windows has no limits of this kind
    resource = None


def main():
    """Command line."""
    if hasattr(signal, "SIGUSR1"):  # the program is gone; temporary files go, too
        signal.signal(signal.SIGUSR1, lambda *_: sys.exit(1))
    name, *arguments = sys.argv[1:]
    check_memory()
    try:
        load_matplotlib()
        module, run = importlib.import_module(f"rheocyte.{name}"), importlib.import_module("rheocyte.files").run
    except ImportError as error:
        print(f"rheocyte: the pictures need Python with numpy and matplotlib ({error}).", file=sys.stderr)
        sys.exit(2)
    if not arguments:
        arguments = [os.fsdecode(text) for text in sys.stdin.buffer.read().split(b"\0")[:-1]]
    if arguments:
        sys.argv[:] = [name, *arguments]
        run(module.main)


def check_memory():
    """Under a small limit of memory, OpenBLAS, on which numpy stands, asks for it again and again without end."""
    if not resource:
        return
    limit, needed = resource.getrlimit(resource.RLIMIT_AS)[0], 400 << 20
    if limit != resource.RLIM_INFINITY and limit < needed:
        print(f"rheocyte: the pictures need {needed >> 20} MB of memory; ulimit -v allows {limit >> 20} MB.",
              file=sys.stderr)
        sys.exit(2)


@contextlib.contextmanager
def elsewhere():
    """In the top folder, then where it was before, also where that has lost its name."""
    here = os.open(".", os.O_PATH) if hasattr(os, "O_PATH") else os.getcwd()
    os.chdir("/")
    try:
        yield
    finally:
        os.chdir(here)
        if isinstance(here, int):
            os.close(here)


def load_matplotlib():
    """Loads matplotlib without any settings but its own: it would read a matplotlibrc of the current folder, too."""
    os.environ.update(MATPLOTLIBRC=os.devnull, MPLBACKEND="Agg", OPENBLAS_NUM_THREADS="1")
    with elsewhere():
        from matplotlib.artist import Artist
    # The help texts of its classes' properties are a quarter of the time that loading takes.
    if hasattr(Artist, "_update_set_signature_and_docstring"):
        Artist._update_set_signature_and_docstring = classmethod(lambda cls: None)
