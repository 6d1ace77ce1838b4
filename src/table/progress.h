// By which measure the states of a table show how far the flow has deformed the cell: steps along a branch, and what
// errors are relative to, go by it.
#pragma once
#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// The deformation. Elongated cells have one without flow: of them it is the third mode, which distinguishes front from
/// rear.
inline Measure progress_of(const TableSpec& spec) {
  return spec.is_elongated() ? Measure::mode_3 : Measure::deformation;
}

}  // namespace rheocyte
