#include "population/cell_distribution.h"

namespace rheocyte {

CellDistribution CellLaw::population(double mean, double variance) const {
  CellDistribution cells = at(mean);
  const double su = usual.radius_spread, se = usual.modulus_spread;
  cells.radius_spread = std::sqrt(su * su + variance * radius_slope * radius_slope);
  cells.modulus_spread = std::sqrt(se * se + variance * modulus_slope * modulus_slope);
  cells.correlation = (usual.correlation * su * se + variance * radius_slope * modulus_slope) /
                      (cells.radius_spread * cells.modulus_spread);
  return cells;
}

}  // namespace rheocyte
