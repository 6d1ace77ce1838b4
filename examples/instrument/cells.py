"""Moduli of single cells by ctypes, without the package rheocyte: python3 cells.py [LIBRARY]"""
import ctypes
import math
import sys

ABI = 1
WIDTH, HEIGHT = 250, 80
NAN = math.nan


class Result(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in (
        "area_um2", "deformation", "inertia_ratio", "x_um", "y_um", "young_modulus_kPa", "young_modulus_error_kPa",
        "effective_modulus_kPa", "effective_modulus_error_kPa", "stiffness_kPa", "stiffness_error_kPa",
        "axial_tension_Pa")] + [("young_state", ctypes.c_int32), ("effective_state", ctypes.c_int32),
                                ("outline", ctypes.c_int32), ("setup", ctypes.c_uint32)]


def library(path):
    cell = ctypes.CDLL(path)
    double, size, handle, text = ctypes.c_double, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_char_p
    cell.rheocyte_cell_open_values.argtypes = [ctypes.c_uint32, text] + 6 * [double] + [
        text, ctypes.POINTER(handle), text, size]
    cell.rheocyte_cell_open_worker.argtypes = [handle] + 3 * [ctypes.c_uint32] + [ctypes.POINTER(handle)]
    cell.rheocyte_cell_from_mask.argtypes = [handle, text, ctypes.c_uint32, ctypes.c_uint32, size,
                                             ctypes.POINTER(Result)]
    cell.rheocyte_cell_close_worker.argtypes = cell.rheocyte_cell_close.argtypes = [handle]
    cell.rheocyte_cell_status_text.restype = cell.rheocyte_cell_state_text.restype = text
    return cell


def check(cell, status, message=b""):
    if status != 0:
        raise RuntimeError((message or cell.rheocyte_cell_status_text(status)).decode())


def main():
    cell = library(sys.argv[1] if len(sys.argv) > 1 else "librheocyte_cell.so.1")
    setup, worker = ctypes.c_void_p(), ctypes.c_void_p()
    message = ctypes.create_string_buffer(500)
    # medium, temperature, viscosity, channel width, flow rate, pixel size, axial tension, folder of the tables
    status = cell.rheocyte_cell_open_values(ABI, b"CellCarrier", 23, NAN, 20, 0.04, 0.34, 200, None,
                                            ctypes.byref(setup), message, len(message))
    check(cell, status, message.value)
    check(cell, cell.rheocyte_cell_open_worker(setup, WIDTH, HEIGHT, 0, ctypes.byref(worker)))

    mask = bytes(((x - 125) / 21) ** 2 + ((y - 40) / 18) ** 2 <= 1 for y in range(HEIGHT) for x in range(WIDTH))
    result = Result()
    check(cell, cell.rheocyte_cell_from_mask(worker, mask, WIDTH, HEIGHT, 0, ctypes.byref(result)))
    print(f"area {result.area_um2:.17g} deformation {result.deformation:.17g} E {result.young_modulus_kPa:.17g} "
          f"S {result.stiffness_kPa:.17g}")

    check(cell, cell.rheocyte_cell_close_worker(worker))
    check(cell, cell.rheocyte_cell_close(setup))


if __name__ == "__main__":
    main()
