"""What the compiled module writes into files, without one on a disk."""

import os


def written(write):
    """The bytes that write(place) leaves in the file at this place, and what it returns."""
    descriptor = os.memfd_create("rheocyte")
    try:
        returned = write(f"/proc/self/fd/{descriptor}")
        with open(descriptor, "rb", closefd=False) as file:
            file.seek(0)
            return file.read(), returned
    finally:
        os.close(descriptor)
