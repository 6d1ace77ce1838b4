#include "infer/shape_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "infer/smooth_events.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

double sign_of(const ShapeGrid& shapes) {
  const ShapeNodes& nodes = shapes.nodes();
  return shapes.mode(3, nodes.min_log_area, std::exp(nodes.lower.front())) < 0 ? -1 : 1;
}

template <class Take>
void in_blocks(std::size_t all, const Take& take) {
  for (std::size_t first = 0; first < all; first += event_block_size)
    take(first, std::min(event_block_size, all - first));
}

MeasuredEvents part(const MeasuredEvents& events, std::size_t first, std::size_t count) {
  return {events.size.subspan(first, count), events.deformation.subspan(first, count),
          events.viscosity_mPas.empty() ? events.viscosity_mPas : events.viscosity_mPas.subspan(first, count)};
}

}  // namespace

bool ShapeExcess::is_elongated() const {
  constexpr double least = 0.05, deviations = 3;
  return excess > std::max(least, deviations * error);
}

double deformation_of_ellipse(double ratio) {
  // Ramanujan's second formula for the perimeter: off by 1e-9 for a ratio of 3.
  const double h = std::pow((ratio - 1) / (ratio + 1), 2);
  const double perimeter_over_pi = (ratio + 1) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
  return 1 - 2 * std::sqrt(ratio) / perimeter_over_pi;
}

double inertia_ratio_deviation(double area_um2, double pixel_size_um) {
  // Measured on nearly round cells of 30 to 109 um^2 in pixels of 0.34 um.
  return 0.016 * std::sqrt(30 / area_um2) * (pixel_size_um / 0.34);
}

ShapeMap::ShapeMap(const StiffnessGrid& grid)
    : origin_(grid.origin()), shapes_(grid.content().shapes.value()), sign_(sign_of(shapes_)) {}

double ShapeMap::inertia_ratio(double area_um2, double deformation) const {
  return shapes_.inertia_ratio(std::log(area_um2), deformation);
}

void ShapeMap::compare(const MeasuringConditions& conditions, const MeasuredEvents& events,
                       std::span<const double> inertia_ratios, std::span<ShapeExcess> excesses) const {
  assert(inertia_ratios.size() == events.size.size() && excesses.size() == events.size.size());
  SmoothEvents smooth;
  in_blocks(excesses.size(), [&](std::size_t first, std::size_t count) {
    remove_pixels(conditions, origin_.flow, part(events, first, count), smooth);
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double ratio = inertia_ratios[first + i], deformation = smooth.deformation[k];
      ShapeExcess& e = excesses[first + i];
      e.expected = shapes_.inertia_ratio(smooth.log_area[k], deformation);
      e.excess =
          ratio > 0 && std::isfinite(ratio) && shapes_.has_area(smooth.log_area[k]) ? ratio - e.expected : no_value;
      e.error = inertia_ratio_deviation(events.size[first + i], conditions.pixel_size_um);
      const bool has_deformation = deformation > smooth.deformation_deviation[k] && ratio > 0;
      e.odd_fraction = has_deformation ? 1 - deformation_of_ellipse(ratio) / deformation : no_value;
    }
  });
}

}  // namespace rheocyte
