#include "solve/warm_start.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {
namespace {

double relative_change(double a, double b) { return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b)); }

/// About the strain by the difference of the axial tensions.
double stretch_by_tension(const Problem& a, const Problem& b) {
  const auto tension = [](const Problem& p) { return p.bulk.axial_tension + p.cortex.axial_tension; };
  const double difference = tension(a) - tension(b);
  if (difference == 0) return 0;
  return std::abs(difference) / (3 * a.bulk.shear_modulus + (a.cortex.modulus + a.cortex.tension) / a.radius_ratio);
}

}  // namespace

bool has_same_laws(const Problem& a, const Problem& b) {
  const bool same_side = (a.offset == 0) == (b.offset == 0) && (a.offset == 0 || a.camera == b.camera);
  return a.bulk.law == b.bulk.law && a.cortex.law == b.cortex.law && (a.cortex.bending > 0) == (b.cortex.bending > 0) &&
         a.liquid.law == b.liquid.law && a.drive == b.drive && a.section == b.section && same_side;
}

bool has_same_channel(const Problem& a, const Problem& b) {
  return a.channel_length == b.channel_length && a.extent.width == b.extent.width &&
         a.extent.height == b.extent.height && (is_power_law(a.liquid.law) || a.liquid == b.liquid);
}

double distance(const Problem& a, const Problem& b) {
  return std::max(
      {relative_change(a.radius_ratio, b.radius_ratio), relative_change(a.bulk.shear_modulus, b.bulk.shear_modulus),
       std::abs(a.bulk.c1_fraction - b.bulk.c1_fraction), std::abs(a.bulk.stiffening - b.bulk.stiffening),
       relative_change(a.cortex.area_constant, b.cortex.area_constant),
       relative_change(a.cortex.modulus, b.cortex.modulus), relative_change(a.cortex.tension, b.cortex.tension),
       relative_change(a.cortex.bending, b.cortex.bending), relative_change(a.liquid.exponent, b.liquid.exponent),
       relative_change(a.liquid.shear_rate_floor, b.liquid.shear_rate_floor),
       std::abs(a.bulk.rest_stretch - b.bulk.rest_stretch), stretch_by_tension(a, b),
       relative_change(a.pressure_gradient, b.pressure_gradient), relative_change(a.offset, b.offset),
       std::abs(a.liquid.reynolds - b.liquid.reynolds)});
}

bool has_same_mesh(const Problem& a, const Problem& b) {
  return a.radius_ratio == b.radius_ratio && a.offset == b.offset && a.liquid.law == b.liquid.law &&
         a.liquid.exponent == b.liquid.exponent && a.liquid.shear_rate_floor == b.liquid.shear_rate_floor &&
         a.pressure_gradient == b.pressure_gradient;
}

}  // namespace rheocyte
