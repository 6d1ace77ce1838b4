// The estimates of a block of events by `rheocyte moduli`.
#pragma once
#include <span>

#include "extract/elongation_values.h"
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

}  // namespace rheocyte
