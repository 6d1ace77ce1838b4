// What `rheocyte moduli` tells of each event. A new column is declared in extract/moduli_columns.cc.
#pragma once
#include <span>

#include "extract/elongation_columns.h"
#include "infer/bulk_cortex_fit.h"
#include "infer/shape_excess.h"

namespace rheocyte {

/// What a block of events has to say, all equally long.
struct ModuliBlock {
  std::span<const ShapeVector> seen;  ///< shapes in pixels
  std::span<const double> viscosity_mPas;
  std::span<const ModuliEstimate> estimates;
  std::span<const ShapeExcess> shape;  ///< against solids without a cortex
  ElongationBlock elongation;          ///< as if they were such solids
};

/// In the order of tables.
ColumnsOf<ModuliBlock> moduli_columns();

/// Those of the estimates alone.
ColumnsOf<ModuliBlock> estimate_columns();

/// Features beside those of `rheocyte extract`: moduli of the events whose moduli are resolved, and the stiffness of
/// all that have one. Their names are their roles.
ColumnsOf<ModuliBlock> moduli_features();

}  // namespace rheocyte
