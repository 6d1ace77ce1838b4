"""How many threads one computation may take."""

import sys
import threading

from rheocyte.arrays import number
from rheocyte.errors import UserError


def threads_of(threads):
    """For the native module: 0 stands for all processors. None: these in the main thread of a process that multiprocessing
    has not started, else one, since workers of a pool take a case each. UserError for what is not a whole number from 1 to
    1024.
    """
    if threads is None:
        return 1 if _is_worker() else 0
    count = number(threads, "threads")
    if not 1 <= count <= 1024 or count != int(count):
        raise UserError(f"threads is {count:g}; give a whole number from 1 to 1024.")
    return int(count)


def _is_worker():
    if threading.current_thread() is not threading.main_thread():
        return True
    processes = sys.modules.get("multiprocessing.process")  # loaded in each process that multiprocessing starts
    return processes is not None and processes.parent_process() is not None
