#include "population/single_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/no_value.h"

namespace rheocyte {
namespace {

constexpr int image_places = 48, image_newton_steps = 12;
constexpr double image_reach = 4;  ///< in standard deviations
constexpr std::size_t images_that_tell = 5000;
constexpr double settled_image = 1e-6;

}  // namespace

ImagedCell cell_of_image(const ForwardMap& map, const SampleEvent& event) {
  const auto radii = map.log_radii(), heights = map.heights();
  double u = std::clamp(0.5 * (event.log_area - std::log(std::numbers::pi)), radii.lower, radii.upper), x = 0;
  const auto beside = [&](double height) { return ImagedCell{u, height, false}; };
  if (!(event.measure > 0)) return beside(heights.upper);
  for (int step = 0; step < image_newton_steps; ++step) {
    const MapPoint p = map.at(u, x);
    if (!(p.measure > 0)) break;
    // ln of the measure is nearly linear in x.
    const double area = event.log_area - p.log_area, measure = std::log(event.measure / p.measure),
                 by_radius = p.measure_by_radius / p.measure, by_height = p.measure_by_height / p.measure;
    const double det = p.log_area_by_radius * by_height - p.log_area_by_height * by_radius;
    const double du = (area * by_height - p.log_area_by_height * measure) / det,
                 dx = (p.log_area_by_radius * measure - area * by_radius) / det;
    u = std::clamp(u + du, radii.lower, radii.upper);
    x += dx;
    if (x < heights.lower - 1) return beside(heights.lower);
    if (x > heights.upper) break;
    const bool is_settled = std::abs(du) < settled_image && std::abs(dx) < settled_image;
    if (is_settled && x < heights.lower) return beside(heights.lower);
    if (is_settled) return {u, x, true};
    x = std::max(x, heights.lower);
  }
  return beside(heights.upper);
}

double log_modulus_of_image(const ForwardMap& map, const SampleEvent& event) {
  const auto [u, x, is_in_map] = cell_of_image(map, event);
  return is_in_map ? map.soft_end(u).log_modulus + x + event.log_viscosity : no_value;
}

SingleImages single_images(const Sample& sample, const CellDistribution& cells, double image_error) {
  const double reach = image_reach * std::hypot(cells.modulus_spread, image_error);
  SingleImages images{cells.mean_log_modulus - reach, 2 * reach / image_places,
                      std::vector<double>(std::size_t(image_places))};
  const std::size_t stride = sample.bins() / images_that_tell + 1;
  std::size_t number = 0;
  for (const EventGroup& group : sample.groups)
    for (const SampleEvent& event : group.events) {
      if (number++ % stride != 0) continue;
      const double place = (log_modulus_of_image(*group.map, event) - images.first) / images.step;
      if (place >= 0 && place < image_places)
        images.counts[std::size_t(place)] += event.count;
      else
        images.without += event.count;
    }
  return images;
}

}  // namespace rheocyte
