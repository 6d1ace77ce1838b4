#include "measurement/event_features.h"

#include <fmt/format.h>

#include "case/nearest_name.h"
#include "case/refuse_path.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

bool is_shape(const std::string& feature) { return feature == "area_um" || feature == "deform"; }

bool implies_area_ratio(const Recording& recording) {
  return recording.has_scalar("area_cvx") && recording.has_scalar("area_msd");
}

}  // namespace

bool EventFeatures::has(const std::string& feature) const {
  return is_shape(feature) || recording_.has_scalar(feature) ||
         (feature == "area_ratio" && implies_area_ratio(recording_));
}

std::vector<std::string> EventFeatures::names() const {
  std::vector<std::string> names = recording_.scalar_names();
  for (const char* implied : {"area_um", "deform", "area_ratio"})
    if (has(implied) && !recording_.has_scalar(implied)) names.emplace_back(implied);
  return names;
}

std::string EventFeatures::near(const std::string& feature) const {
  const std::vector<std::string> known = names();
  const auto nearest = nearest_name(feature, std::vector<std::string_view>(known.begin(), known.end()));
  return nearest ? fmt::format(" Did you mean {}?", *nearest) : "";
}

void EventFeatures::read(const std::string& feature, std::size_t first, std::span<double> values) {
  if (!has(feature))
    refuse_path(recording_.file(), fmt::format("has no feature {}.{}", one_line(feature, 60), near(feature)));
  if (recording_.has_scalar(feature)) return recording_.read_scalar(feature, first, values);
  other_.resize(values.size());
  if (feature == "area_um") return shapes_.read(first, values, other_);
  if (feature == "deform") return shapes_.read(first, other_, values);
  recording_.read_scalar("area_cvx", first, values);
  recording_.read_scalar("area_msd", first, other_);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= other_[i];
}

}  // namespace rheocyte
