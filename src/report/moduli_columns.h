// What `rheocyte moduli` reports of each event. A new column is declared in report/moduli_columns.cc.
#pragma once
#include "extract/moduli_block.h"
#include "report/event_column.h"

namespace rheocyte {

/// In the order of tables.
ColumnsOf<ModuliBlock> moduli_columns();

/// Those of the estimates alone.
ColumnsOf<ModuliBlock> estimate_columns();

/// Features beside those of `rheocyte extract`: moduli of the events whose moduli are resolved, and the stiffness of
/// all that have one. Their names are their roles.
ColumnsOf<ModuliBlock> moduli_features();

}  // namespace rheocyte
