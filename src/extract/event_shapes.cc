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

EventShapes::EventShapes(const Recording& recording, const MeasuringConditions& conditions, const Tables& tables,
                         bool with_asymmetry)
    : recording_(recording), conditions_(conditions), tables_(tables) {
  if (!are_measured(recording)) {
    missing_ =
        "the recording has neither inert_ratio_cvx nor contours nor masks: whether the shapes are those of the model "
        "is unknown.";
    return;
  }
  if (!tables.round) {
    missing_ = "the table does not say what its cells look like, so shapes cannot be compared with those of the model.";
    return;
  }
  const bool has_outlines = ShapeSource::has_outlines(recording), has_ratio = recording.has_scalar(stored_ratio);
  if (has_outlines && (with_asymmetry || !has_ratio)) {
    outlines_.emplace(recording, conditions.pixel_size_um > 0 ? conditions.pixel_size_um : 1);
    find_direction();
  }
  inertia_ratio_from_ = has_ratio ? stored_ratio : recording.has_contours() ? "contour" : "mask";
  if (!has_outlines)
    missing_ =
        "the recording has neither contours nor masks: the modulus of elongated cells is told by area, deformation and "
        "inertia ratio, less accurately than by the outlines.";
  else if (!tables.elongated)
    missing_ =
        "there is no table of elongated cells for this channel: moduli are those of cells that nothing but the flow "
        "deforms.";
}

std::optional<ElongatedBy> EventShapes::elongated_by() const {
  if (!is_known() || !tables_.elongated) return {};
  return has_asymmetry() ? ElongatedBy::modes : ElongatedBy::inertia;
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
  if (std::abs(mean) > 2 * error) direction_ = mean * tables_.round->sign_of_asymmetry() > 0 ? 1 : -1;
}

HullAsymmetry EventShapes::asymmetry(std::size_t event, ContourFeatures* measured) {
  const PixelContour contour = outlines_->outline(event);
  if (measured) *measured = measurer_.measure(contour, measured_pixel_um_);
  if (contour.size() < fewest_outline_points) return {no_value, no_value, no_value, no_value, no_value};
  return hull_asymmetry(measured ? measurer_.hull() : measurer_.find_hull(contour));
}

void EventShapes::read_outlines(std::size_t first, ShapeColumns& columns) {
  const int direction = direction_ < 0 ? -1 : 1;
  const bool stored = inertia_ratio_from_ == stored_ratio;
  for (std::size_t i = 0; i < columns.mode_3.size(); ++i) {
    const HullAsymmetry hull = asymmetry(first + i, measured_pixel_um_ > 0 ? &columns.outlines[i] : nullptr);
    columns.mode_2[i] = hull.mode_2;
    columns.mode_3[i] = direction * hull.mode_3;
    columns.mode_4[i] = hull.mode_4;
    columns.mode_5[i] = direction * hull.mode_5;
    if (!stored) columns.inertia_ratio[i] = inertia_ratio(hull);
  }
}

/// What is left of the next modes is that of cells with a cortex.
void EventShapes::compare_with_solids(ShapeColumns& c) const {
  constexpr int fourth = number_of(ElongatedMeasure::mode_3) + 1;
  const ElongatedTable& table = tables_.elongated->solids().table();
  for (std::size_t i = 0; i < c.mode_4.size(); ++i) {
    const bool has_cell = c.elongation.states[i] == ModulusState::valid;
    const ElongatedState solid = has_cell ? table.at(c.elongation.cells[i]) : ElongatedState{};
    c.mode_4[i] = has_cell ? c.mode_4[i] - solid.value(fourth) : no_value;
    c.mode_5[i] = has_cell ? c.mode_5[i] - solid.value(fourth + 1) : no_value;
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
    for (auto* column : {&c.mode_2, &c.mode_3, &c.mode_4, &c.mode_5}) column->resize(count);
    if (measured_pixel_um_ > 0) c.outlines.resize(count);
    read_outlines(first, c);
  }
  if (const auto by = elongated_by()) {
    c.elongation.assign(count);
    const ElongatedShapes shapes = by == ElongatedBy::modes ? ElongatedShapes{*by, c.mode_2, c.mode_3}
                                                            : ElongatedShapes{*by, c.inertia_ratio, events.deformation};
    tables_.elongated->estimate(conditions_, events, shapes, c.elongation.estimates());
    if (by == ElongatedBy::modes) compare_with_solids(c);
  }
  tables_.round->compare(conditions_, events, c.inertia_ratio, c.excess);
}

}  // namespace rheocyte
