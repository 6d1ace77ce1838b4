// Events of a population as the forward map has them: what a fit is checked with.
#pragma once
#include "numeric/cell_random.h"
#include "population/cell_distribution.h"
#include "population/forward_map.h"

namespace rheocyte {

struct DrawnCell {
  double log_radius, log_modulus;
};
inline DrawnCell drawn_cell(const CellDistribution& cells, CellRandom& random) {
  const double zu = random.normal(), other = random.normal();
  const double ze = cells.correlation * zu + std::sqrt(1 - cells.correlation * cells.correlation) * other;
  return {cells.mean_log_radius + cells.radius_spread * zu, cells.mean_log_modulus + cells.modulus_spread * ze};
}

struct SeenValues {
  double log_area, measure;
};
/// With noise; the cell's modulus is the one at a viscosity of 1 mPa s.
inline SeenValues seen_values(const ForwardMap& map, const DrawnCell& cell, CellRandom& random) {
  const MapPoint p = map.at(cell.log_radius, cell.log_modulus - map.soft_end(cell.log_radius).log_modulus);
  const double first = random.normal(), second = random.normal(), area = std::sqrt(p.area_variance);
  const double along = p.covariance / area, across = std::sqrt(p.measure_variance - along * along);
  return {p.log_area + area * first, p.measure + along * first + across * second};
}

}  // namespace rheocyte
