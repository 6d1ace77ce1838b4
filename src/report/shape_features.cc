#include "report/shape_features.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "case/refuse_path.h"

namespace rheocyte {

namespace {

constexpr std::array<std::string_view, 5> names{ratio_feature, expected_ratio_feature, "shape_excess", "odd_fraction",
                                                "mode_3"};

double ShapeExcess::*member_of(const std::string& feature) {
  if (feature == expected_ratio_feature) return &ShapeExcess::expected;
  return feature == "shape_excess" ? &ShapeExcess::excess : &ShapeExcess::odd_fraction;
}

/// Null for any other feature.
const TiltFeature* tilt_feature(const std::string& feature) {
  const auto found = std::ranges::find(tilt_features(), feature, &TiltFeature::name);
  return found == tilt_features().end() ? nullptr : &*found;
}

bool needs_outlines(const std::string& feature) { return feature == "mode_3" || tilt_feature(feature) != nullptr; }

}  // namespace

bool ShapeFeatures::knows(const std::string& feature) {
  return std::ranges::find(names, feature) != names.end() || tilt_feature(feature) != nullptr;
}

ShapeFeatures::ShapeFeatures(const Recording& recording, ShapeSource& source, const PlotOptions& options)
    : recording_(recording),
      source_(source),
      settings_(
          extract_settings(options.measuring, options.no_pixelation ? PixelUse::ignore : PixelUse::correct, recording)),
      tables_(options.table, options.section),
      shapes_(recording, settings_.conditions, {tables_.shapes(settings_.conditions.flow.exponent)},
              needs_outlines(options.x) || needs_outlines(options.y)) {
  const bool wants_asymmetry = needs_outlines(options.x) || needs_outlines(options.y);
  if (!shapes_.is_known() || (wants_asymmetry && !shapes_.has_asymmetry()))
    refuse_path(recording.file(), shapes_.missing());
}

void ShapeFeatures::compute(std::size_t first, std::size_t count) {
  if (first == first_ && area_.size() == count) return;
  for (auto* column : {&area_, &deformation_, &viscosity_}) column->resize(count);
  source_.read(first, area_, deformation_);
  settings_.viscosities(recording_, first, viscosity_);
  shapes_.compute(first, {area_, deformation_, viscosity_}, columns_);
  first_ = first;
}

void ShapeFeatures::read(const std::string& feature, std::size_t first, std::span<double> values) {
  compute(first, values.size());
  if (feature == ratio_feature)
    std::ranges::copy(columns_.inertia_ratio, values.begin());
  else if (feature == "mode_3")
    std::ranges::copy(columns_.mode_3, values.begin());
  else if (const TiltFeature* const tilt = tilt_feature(feature))
    std::ranges::transform(columns_.tilt, values.begin(), tilt->value);
  else
    std::ranges::transform(columns_.excess, values.begin(), member_of(feature));
}

}  // namespace rheocyte
