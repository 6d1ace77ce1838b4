#include "events/event_reader.h"

#include <algorithm>

#include "events/direction_of_cells.h"
#include "events/plausibility.h"
#include "events/settings_hash.h"

namespace rheocyte {

namespace {

const Recording& checked(const Recording& recording, const EventNeeds& needs) {
  if (needs.outlines == OutlineUse::needed) ShapeSource::check_outlines(recording, needs.outlines_for);
  return recording;
}

RecordingFacts facts_of(const Recording& recording, const ExtractSettings& settings, const ShapeSource& shapes,
                        const Gates& gates) {
  RecordingFacts facts;
  facts.labels = labels_of(recording.metadata());
  facts.conditions = settings.conditions;
  facts.pixel_size_um = settings.pixel_size_um;
  facts.medium = settings.medium_text();
  facts.viscosity_model = settings.model_text();
  facts.temperature = settings.temperature_text();
  if (settings.buffer) {
    facts.temperature_C = settings.temperature_C;
    facts.range_of_viscosity_model = settings.range_text();
  }
  facts.area_from = shapes.area_from();
  facts.deformation_from = shapes.deformation_from();
  facts.gates = gates.description();
  facts.made_of = recording.metadata().text(made_of_key).value_or("");
  facts.recorded = recording.events();
  facts.settings = settings.lines();
  facts.decisive = decisive_lines(settings, gates);
  facts.notes = recording.remarks();
  facts.notes.insert(facts.notes.end(), settings.warnings.begin(), settings.warnings.end());
  return facts;
}

}  // namespace

RecordingLabels labels_of(const Metadata& metadata) {
  const auto text = [&](const char* key) { return metadata.text(key).value_or(""); };
  return {text("experiment:sample"), text("experiment:date"), text("experiment:time"), text("experiment:run index"),
          text("setup:chip identifier")};
}

EventReader::EventReader(const Recording& recording, const MeasuringOptions& options, const EventNeeds& needs)
    : recording_(checked(recording, needs)),
      settings_(extract_settings(options, needs.pixels, recording)),
      shapes_(recording, settings_.pixel_size_um),
      features_(recording, shapes_),
      gates_(options.lifts_shape_gates ? Gates(options.gates).without_shapes() : Gates(options.gates)),
      facts_(facts_of(recording, settings_, shapes_, gates_)),
      reynolds_at_1_mPas_(reynolds_at_1_mPas(settings_.conditions.flow)) {
  if (needs.outlines != OutlineUse::none && ShapeSource::has_outlines(recording))
    outlines_.emplace(recording, settings_.pixel_size_um);
  gates_.check(features_);
}

int EventReader::turn_downstream(double sign) {
  turn(direction_of_cells(*outlines_, sign));
  return facts_.direction;
}

ShapeVector EventReader::shape(std::size_t event) {
  ShapeVector shape = outlines_->features(event);
  if (facts_.direction >= 0) return shape;
  for (int k = min_mode + 1; k <= max_mode; k += 2) shape(int(ShapeFeature::first_mode) + k - min_mode) *= -1;
  return shape;
}

void EventReader::read(std::size_t first, std::size_t count) {
  viscosity_mPas_.resize(count);
  facts_.outside_temperature += settings_.viscosities(recording_, first, viscosity_mPas_);
  inside_.resize(count);
  gates_.apply(features_, first, inside_);
  facts_.gated += std::size_t(std::ranges::count(inside_, char{0}));
  for (std::size_t i = 0; i < count; ++i) {
    if (!inside_[i] || !(reynolds(i) > max_reynolds_number)) continue;
    ++facts_.inertial;
    facts_.greatest_reynolds_number = std::max(facts_.greatest_reynolds_number, reynolds(i));
  }
}

}  // namespace rheocyte
