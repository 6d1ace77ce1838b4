// The effective modulus of a recording and the cell behind it, as columns of its summary.
#pragma once
#include "extract/effective_cell.h"
#include "report/column.h"

namespace rheocyte {

Columns<EffectiveCell> effective_columns();

}  // namespace rheocyte
