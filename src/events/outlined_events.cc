#include "events/outlined_events.h"

#include "events/direction_of_cells.h"

namespace rheocyte {

namespace {

const Recording& with_outlines(const Recording& recording, std::string_view use) {
  ShapeSource::check_outlines(recording, use);
  return recording;
}

}  // namespace

OutlinedEvents::OutlinedEvents(const Recording& recording, const MeasuringOptions& options, std::string_view use)
    : recording_(with_outlines(recording, use)),
      settings_(extract_settings(options, PixelUse::fit, recording)),
      outlines_(recording, settings_.pixel_size_um),
      shapes_(recording, settings_.pixel_size_um),
      features_(recording, shapes_),
      gates_(options.gates) {
  gates_.check(features_);
}

int OutlinedEvents::turn_downstream(double sign) {
  const int direction = direction_of_cells(outlines_, sign);
  turn(direction);
  return direction;
}

ShapeVector OutlinedEvents::shape(std::size_t event) {
  ShapeVector shape = outlines_.features(event);
  if (!is_mirrored_) return shape;
  for (int k = min_mode + 1; k <= max_mode; k += 2) shape(int(ShapeFeature::first_mode) + k - min_mode) *= -1;
  return shape;
}

void OutlinedEvents::read(std::size_t first, std::size_t count) {
  viscosity_mPas_.resize(count);
  outside_temperature_ += settings_.viscosities(recording_, first, viscosity_mPas_);
  inside_.resize(count);
  gates_.apply(features_, first, inside_);
}

}  // namespace rheocyte
