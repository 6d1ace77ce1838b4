#include "extract/turning_law.h"

#include <algorithm>
#include <cmath>

#include "numeric/no_value.h"

namespace rheocyte {

namespace {

constexpr double fitted_exponent = 0.6;                 // of the liquids that were solved, beside Newtonian ones
constexpr double least_ratio = 0.3, most_ratio = 0.87;  // of the cells

/// Linear between a Newtonian liquid and one of the exponent that was solved, and a little beyond.
double between(double newtonian, double thinning, double exponent) {
  constexpr double least_exponent = 0.45;
  const double fraction = (1 - std::clamp(exponent, least_exponent, 1.0)) / (1 - fitted_exponent);
  return newtonian + fraction * (thinning - newtonian);
}

double radius_ratio(double radius_um, const ChannelFlow& flow) {
  return std::clamp(2 * radius_um / flow.width_um, least_ratio, most_ratio);
}

double mean_velocity_um_per_s(const ChannelFlow& flow) {
  constexpr double um3_per_ul = 1e9;
  if (!(flow.rate_ul_s > 0) || !(flow.width_um > 0)) return no_value;
  return flow.rate_ul_s * um3_per_ul / (flow.width_um * flow.width_um);
}

double squared(double x) { return x * x; }

}  // namespace

double turning_rate_per_um(double radius_um, const ChannelFlow& flow) {
  const double ratio = radius_ratio(radius_um, flow), half = flow.width_um / 2;
  const double newtonian = 1.60 + squared(ratio - 0.7), thinning = 0.785 - 2 * squared(ratio - 0.57);
  return between(newtonian, thinning, flow.exponent) * mean_velocity_um_per_s(flow) / (half * half);
}

double cell_velocity_um_per_s(double radius_um, const ChannelFlow& flow) {
  const double ratio = radius_ratio(radius_um, flow);
  const double newtonian = 2.184 - 0.476 * ratio - 0.588 * squared(ratio),
               thinning = 1.813 + 0.248 * ratio - 0.919 * squared(ratio);
  return between(newtonian, thinning, flow.exponent) * mean_velocity_um_per_s(flow);
}

double tilt_of_stored_shape(double radius_um, double ratio, double way_um, const ChannelFlow& flow) {
  const double time_s = way_um / cell_velocity_um_per_s(radius_um, flow), square = ratio * ratio;
  return turning_rate_per_um(radius_um, flow) * (1 - (square - 1) / (square + 1)) * time_s;
}

}  // namespace rheocyte
