#include "extract/event_shapes.h"

#include <algorithm>
#include <cmath>

#include "extract/shape_verdict.h"
#include "measurement/shape_source.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

constexpr const char* stored_ratio = "inert_ratio_cvx";
constexpr std::size_t outlines_looked_at = 1024, at_a_time = 64;  // events, for the direction

double inertia_ratio(const HullAsymmetry& hull) { return 1 / std::sqrt(hull.moment_ratio); }

}  // namespace

bool EventShapes::are_measured(const Recording& recording) {
  return recording.has_scalar(stored_ratio) || ShapeSource::has_outlines(recording);
}

EventShapes::EventShapes(const Recording& recording, const MeasuringConditions& conditions, const ShapeMap* map,
                         bool with_asymmetry)
    : recording_(recording), conditions_(conditions), map_(map) {
  if (!are_measured(recording)) {
    missing_ =
        "the recording has neither inert_ratio_cvx nor contours nor masks: whether the shapes are those of the model "
        "is unknown.";
    return;
  }
  if (!map) {
    missing_ = "the table does not say what its cells look like, so shapes cannot be compared with those of the model.";
    return;
  }
  const bool has_outlines = ShapeSource::has_outlines(recording), has_ratio = recording.has_scalar(stored_ratio);
  if (has_outlines && ((with_asymmetry && map->has_asymmetry()) || !has_ratio)) {
    outlines_.emplace(recording, conditions.pixel_size_um > 0 ? conditions.pixel_size_um : 1);
    find_direction();
  }
  inertia_ratio_from_ = has_ratio ? stored_ratio : recording.has_contours() ? "contour" : "mask";
  if (!has_outlines)
    missing_ = "the recording has neither contours nor masks: there are no moduli from the asymmetry of the outlines.";
}

void EventShapes::find_direction() {
  const std::size_t events = recording_.events(), pieces = std::min(outlines_looked_at, events) / at_a_time + 1;
  double sum = 0, squares = 0, count = 0;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t first = piece * events / pieces, last = std::min(first + at_a_time, events);
    for (std::size_t event = first; event < last; ++event) {
      const HullAsymmetry hull = asymmetry(event, nullptr);
      const double c = hull.mode_3;
      if (!(std::abs(c) < 0.3) || inertia_ratio(hull) > max_inertia_ratio_of_cells) continue;  // no cell, or a red one
      sum += c;
      squares += c * c;
      ++count;
    }
  }
  if (count < 2) return;
  const double mean = sum / count, error = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
  if (std::abs(mean) > 2 * error) direction_ = mean * map_->sign_of_asymmetry() > 0 ? 1 : -1;
}

HullAsymmetry EventShapes::asymmetry(std::size_t event, ContourFeatures* measured) {
  const PixelContour contour = outlines_->outline(event);
  if (measured) *measured = measurer_.measure(contour, measured_pixel_um_);
  if (contour.size() < fewest_outline_points) return {no_value, no_value, no_value};
  return hull_asymmetry(measured ? measurer_.hull() : measurer_.find_hull(contour));
}

void EventShapes::read_outlines(std::size_t first, ShapeColumns& columns) {
  const int direction = direction_ < 0 ? -1 : 1;
  const bool stored = inertia_ratio_from_ == stored_ratio;
  for (std::size_t i = 0; i < columns.mode_3.size(); ++i) {
    const HullAsymmetry hull = asymmetry(first + i, measured_pixel_um_ > 0 ? &columns.outlines[i] : nullptr);
    columns.mode_2[i] = hull.mode_2;
    columns.mode_3[i] = direction * hull.mode_3;
    if (!stored) columns.inertia_ratio[i] = inertia_ratio(hull);
  }
}

void EventShapes::compute(std::size_t first, const MeasuredEvents& events, ShapeColumns& c) {
  const std::size_t count = events.size.size();
  if (!is_known()) {  // nothing but NaN ever
    c.inertia_ratio.resize(count, no_value);
    c.x_um.resize(count, no_value);
    c.excess.resize(count, {no_value, no_value, no_value, no_value});
    return;
  }
  c.inertia_ratio.assign(count, no_value);
  c.x_um.assign(count, no_value);
  c.excess.assign(count, {no_value, no_value, no_value, no_value});
  if (recording_.has_scalar("pos_x")) recording_.read_scalar("pos_x", first, c.x_um);
  if (inertia_ratio_from_ == stored_ratio) recording_.read_scalar(stored_ratio, first, c.inertia_ratio);
  if (outlines_) {
    for (auto* column : {&c.mode_2, &c.mode_3}) column->resize(count);
    for (auto* column : {&c.modulus_kPa, &c.standard_error_kPa, &c.systematic_error_kPa})
      column->assign(count, no_value);
    if (measured_pixel_um_ > 0) c.outlines.resize(count);
    c.states.assign(count, ModulusState::no_data);
    read_outlines(first, c);
    if (map_->has_asymmetry())
      map_->estimate(conditions_, events, {c.mode_2, c.mode_3},
                     {c.modulus_kPa, c.standard_error_kPa, c.states, c.systematic_error_kPa});
  }
  map_->compare(conditions_, events, c.inertia_ratio, c.excess);
}

}  // namespace rheocyte
