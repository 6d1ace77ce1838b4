#include "extract/event_shapes.h"

#include <algorithm>
#include <cmath>

#include "events/direction_of_cells.h"
#include "measurement/contour_tilt.h"
#include "measurement/pixel_errors.h"
#include "measurement/shape_source.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

constexpr const char* stored_ratio = "inert_ratio_cvx";

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
    direction_ = direction_of_cells(*outlines_, tables.round->sign_of_asymmetry());
  }
  inertia_ratio_from_ = has_ratio ? stored_ratio : recording.has_contours() ? "contour" : "mask";
  if (!has_outlines)
    missing_ =
        "the recording has neither contours nor masks: the modulus of elongated cells follows from area, deformation "
        "and inertia ratio, less accurately than from the outlines.";
  else if (!tables.elongated)
    missing_ =
        "there is no table of elongated cells for this channel: moduli are those of cells that nothing but the flow "
        "deforms.";
}

std::optional<ElongatedBy> EventShapes::elongated_by() const {
  if (!is_known() || !tables_.elongated) return {};
  return has_asymmetry() ? ElongatedBy::modes : ElongatedBy::inertia;
}

HullAsymmetry EventShapes::asymmetry(const PixelContour& contour, ContourFeatures* measured) {
  const bool is_cut = outlines_->is_cut(contour);
  if (measured) *measured = measurer_.measure(is_cut ? PixelContour() : contour, measured_pixel_um_);
  if (contour.size() < fewest_outline_points || is_cut) return {};
  return hull_asymmetry(measured ? measurer_.hull() : measurer_.find_hull(contour));
}

void EventShapes::read_outlines(std::size_t first, ShapeColumns& columns) {
  const int direction = direction_ < 0 ? -1 : 1;
  const bool stored = inertia_ratio_from_ == stored_ratio, has_y = recording_.has_scalar("pos_y");
  outlines_->each(first, columns.mode_3.size(), [&](std::size_t event, const PixelContour& contour) {
    const std::size_t i = event - first;
    columns.is_cut[i] = outlines_->is_cut(contour);
    const HullAsymmetry hull = asymmetry(contour, measured_pixel_um_ > 0 ? &columns.outlines[i] : nullptr);
    columns.mode_2[i] = hull.mode_2;
    columns.mode_3[i] = direction * hull.mode_3;
    columns.mode_4[i] = hull.mode_4;
    columns.mode_5[i] = direction * hull.mode_5;
    columns.tilt[i] = contour_tilt(contour, measurer_.hull(), hull.sine_modes, direction, outlines_->picture());
    if (!stored || columns.is_cut[i]) columns.inertia_ratio[i] = hull.inertia_ratio();
    if (!has_y)
      columns.y_um[i] =
          std::isfinite(hull.mode_3) ? conditions_.pixel_size_um * measurer_.hull().moments().y : no_value;
  });
  if (has_y) recording_.read_scalar("pos_y", first, columns.y_um);
}

/// What is left of the next modes, without what pixels do to them, is that of cells with a cortex.
void EventShapes::compare_with_solids(const MeasuredEvents& events, ShapeColumns& c) const {
  constexpr int fourth = number_of(ElongatedMeasure::mode_3) + 1;
  const ElongatedTable& table = tables_.elongated->solids().table();
  for (auto* column : {&c.mode_4_excess, &c.mode_5_excess}) column->assign(c.mode_4.size(), no_value);
  for (std::size_t i = 0; i < c.mode_4.size(); ++i) {
    if (c.elongation.states[i] != ModulusState::valid) continue;
    const ElongatedState solid = table.at(c.elongation.cells[i]);
    c.mode_4_excess[i] = c.mode_4[i] - solid.value(fourth);
    c.mode_5_excess[i] = c.mode_5[i] - solid.value(fourth + 1);
    if (!(conditions_.pixel_size_um > 0)) continue;
    const ModeErrors pixels = mode_errors(std::log(events.size[i]) - 2 * std::log(conditions_.pixel_size_um),
                                          {c.mode_2[i], c.mode_3[i], c.mode_4[i], c.mode_5[i]});
    c.mode_4_excess[i] -= pixels.mode_4.excess;
    c.mode_5_excess[i] -= pixels.mode_5.excess;
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
    for (auto* column : {&c.mode_2, &c.mode_3, &c.mode_4, &c.mode_5, &c.y_um}) column->resize(count);
    c.tilt.resize(count);
    c.is_cut.resize(count);
    if (measured_pixel_um_ > 0) c.outlines.resize(count);
    read_outlines(first, c);
  }
  if (const auto by = elongated_by()) {
    c.elongation.assign(count);
    const ElongatedShapes shapes = by == ElongatedBy::modes
                                       ? ElongatedShapes{*by, c.mode_2, c.mode_3, c.mode_4, c.mode_5}
                                       : ElongatedShapes{*by, c.inertia_ratio, events.deformation};
    tables_.elongated->estimate(conditions_, events, shapes, c.elongation.estimates());
    if (by == ElongatedBy::modes) compare_with_solids(events, c);
  }
  tables_.round->compare(conditions_, events, c.inertia_ratio, c.excess);
}

}  // namespace rheocyte
