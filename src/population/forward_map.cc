#include "population/forward_map.h"

#include <cmath>

namespace rheocyte {

double event_error(const ForwardMap& map, double u, double log_modulus_per_mPas) {
  const auto end = map.soft_end(u);
  const MapPoint p = map.at(u, log_modulus_per_mPas - end.log_modulus);
  const RadiusSlopes by_u = at_constant_modulus(p, end.slope);
  // Two values and two unknowns: the inverse of J C^-1 J^T is J^-1 C J^-T, of which the row of e counts.
  const double det = by_u.log_area * p.measure_by_height - p.log_area_by_height * by_u.measure;
  const double of_area = -by_u.measure / det, of_measure = by_u.log_area / det;
  return std::sqrt(of_area * of_area * p.area_variance + 2 * of_area * of_measure * p.covariance +
                   of_measure * of_measure * p.measure_variance);
}

}  // namespace rheocyte
