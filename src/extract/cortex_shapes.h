// Whether outlines are those of cells with a cortex: one rule for single recordings and for populations
// (docs/theory-extract.md, sec. "Elongated cells").
#pragma once
#include "extract/shape_verdict.h"

namespace rheocyte {

/// Medians of outlines.
struct OutlinesBesideSolids {
  double asymmetry = no_value;  ///< c_3
  double radius_px = no_value;  ///< of the circle of equal area; NaN where the size of the pixels is unknown
  Median mode_4, mode_5;        ///< c_4 and c_5 beyond those of solids with the same area, c_2 and c_3, pixels apart
};

/// Whether the rear is flatter and the flanks are straighter than those of any solid.
bool are_of_cortex(const OutlinesBesideSolids& outlines);

}  // namespace rheocyte
