#include "infer/common_tension.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

namespace {

constexpr double normal_95 = 1.645;  ///< quantile of a normal distribution

}  // namespace

AxialTension CommonTension::tension() const {
  if (!is_found()) return AxialTension::unknown();
  return {value_Pa, (upper_Pa - lower_Pa) / (2 * normal_95)};
}

CommonTension common_tension(const CombinedPopulation& population, std::size_t cells, double wall_stress_Pa) {
  CommonTension found;
  found.cells = cells;
  const MomentFit& fit = population.fit;
  if (!fit.is_found) return found;
  constexpr int axial = int(CombinedParameter::axial_tension), means = int(CombinedParameter::log_radius_spread);
  const double variance = fit.covariance(axial, axial) + population.common_covariance(axial, axial);
  found.cells = fit.events;
  found.value_Pa = population.law.axial_tension * wall_stress_Pa;
  found.misfit = fit.misfit / std::max(int(population.features.size()) - means, 1);
  const double half_width_Pa = normal_95 * std::sqrt(variance) * wall_stress_Pa;
  found.lower_Pa = found.value_Pa - half_width_Pa;
  found.upper_Pa = found.value_Pa + half_width_Pa;
  return found;
}

}  // namespace rheocyte
