#include "report/companion_shapes.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace rheocyte {

namespace {

constexpr std::array<std::string_view, 4> kept_shapes{"inert_ratio_cvx", "inert_ratio_prnc", "inert_ratio_raw",
                                                      "volume"};

}  // namespace

CompanionShapes::CompanionShapes(CompanionWriter& companion, const Recording& recording, Extraction& extraction)
    : companion_(companion), recording_(recording) {
  const bool has_outlines = extraction.event_shapes().has_asymmetry() && extraction.settings().pixel_size_um > 0;
  for (const OutlineFeature& feature : outline_features()) {
    if (std::ranges::find(kept_shapes, feature.name) == kept_shapes.end()) continue;
    if (recording.has_scalar(feature.name)) {
      companion.add_feature(feature.name, true);
      stored_.push_back(&feature);
    } else if (has_outlines) {
      companion.add_feature(feature.name);
      measured_.push_back(&feature);
    }
  }
  if (!measured_.empty()) extraction.measure_outlines();
}

void CompanionShapes::write(std::size_t first, const EventBlock& block) {
  values_.resize(block.state.size());
  for (const OutlineFeature* feature : stored_) {
    recording_.read_scalar(feature->name, first, values_);
    companion_.write(feature->name, first, values_);
  }
  for (const OutlineFeature* feature : measured_) {
    std::ranges::transform(block.outlines, values_.begin(), feature->value);
    companion_.write(feature->name, first, values_);
  }
}

}  // namespace rheocyte
