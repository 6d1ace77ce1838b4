// The effective modulus over area and deformation of cells under a known axial tension of the liquid, as a grid: with
// the tension of a recording each of its events has a modulus (docs/theory-extract.md, sec. "The effective modulus").
#pragma once
#include <optional>

#include "infer/proportioned_cells.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

/// Of the same cells in the channel and flow of the table; what grids call the stiffness is the effective modulus in
/// one, and S = E + E2D / r0 in the other.
struct GridsUnderTension {
  GridContent effective_modulus, stiffness;
};

/// `tension_Pa` is that in the recording's flow. Deformations are those that remain once a GridMap has subtracted its
/// law of the pixels, which is that of round solids: elongated cells have 0.001 to 0.003 more. A pixel size of zero:
/// without pixels. Nothing if the table has no cells under such a tension.
std::optional<GridsUnderTension> grids_under_tension(const ProportionedCells& cells, const Sight& sight,
                                                     double tension_Pa, double pixel_size_um = 0);

/// Only the effective modulus.
std::optional<GridContent> grid_under_tension(const ProportionedCells& cells, const Sight& sight, double tension_Pa,
                                              double pixel_size_um = 0);

}  // namespace rheocyte
