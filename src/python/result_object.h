// A solved state as Python holds it.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "result/result.h"

namespace rheocyte {

/// The columns of contour.csv by their names.
pybind11::dict surface_columns(const Result& result);

}  // namespace rheocyte
