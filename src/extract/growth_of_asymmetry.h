// Why the asymmetry of a recording's cells grows downstream (docs/real-cells.md).
#pragma once
#include "extract/shape_verdict.h"

namespace rheocyte {

/// What explains an asymmetry that grows downstream.
enum class Growth { none, of_creeping_cells, of_centring_cells };

struct GrowthOfAsymmetry {
  Growth kind = Growth::none;
  double growth = 0, change_of_mode_4 = 0, expected = 0;  ///< of c_4 if cells approach the axis
};

GrowthOfAsymmetry growth_of_asymmetry(const ShapeVerdict& verdict);

/// Of c_3, which a cell that approaches the axis gains, per um2 of its squared distance from the axis.
inline constexpr double mode_3_per_um2 = -0.0146;

}  // namespace rheocyte
