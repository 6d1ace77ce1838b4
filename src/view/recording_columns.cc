#include "view/recording_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "report/event_columns.h"
#include "report/former_names.h"
#include "report/moduli_columns.h"

namespace rheocyte {

namespace {

static_assert(std::endian::native == std::endian::little, "columns are handed on as they lie in memory");

constexpr std::string_view modulus_name = "emodulus";

/// Of which event of a basin each event is the copy: no property of a cell.
bool is_basin_mapping(const std::string& name) { return name.starts_with("basinmap"); }

/// A stored modulus keeps apart from those that are computed here: it has another table, or another law.
std::string name_of_stored(const std::string& feature) {
  return feature == modulus_name ? std::string(stored_modulus_name) : feature;
}

/// What a name stands for in the file; an empty one for the modulus, which is the computed one or none.
std::string stored_feature(const std::string& name) {
  if (name == stored_modulus_name) return std::string(modulus_name);
  return name == modulus_name ? "" : name;
}

template <class Number>
void append(std::span<const double> values, std::string& bytes) {
  const std::size_t start = bytes.size();
  bytes.resize(start + values.size() * sizeof(Number));
  char* at = bytes.data() + start;
  for (const double value : values) {
    const auto number = static_cast<Number>(value);
    std::memcpy(at, &number, sizeof number);
    at += sizeof number;
  }
}

/// Also of a companion that the version before has written; empty if there is none.
std::string feature_with_role(const Recording& companion, const std::string& role) {
  const auto named = [&](std::string_view word) {
    return companion.metadata().text(fmt::format("user:rheocyte {}", word)).value_or("");
  };
  std::string feature = named(role);
  for (const FormerName& name : former_names())
    if (feature.empty() && name.present == role) feature = named(name.former);
  return feature;
}

}  // namespace

std::vector<ComputedColumn> computed_columns(const Recording& companion) {
  std::vector<ComputedColumn> columns;
  for (const ColumnDescription& column : companion_columns()) {
    const std::string feature = column.rank == 0 ? column.role : feature_with_role(companion, column.role);
    if (companion.has_scalar(feature)) columns.push_back({column.role, feature});
  }
  return columns;
}

std::vector<ColumnDescription> computed_features() {
  std::vector<ColumnDescription> features = companion_columns();
  const auto of_moduli = descriptions(moduli_features());
  features.insert(features.end(), of_moduli.begin(), of_moduli.end());
  for (ColumnDescription& feature : features) feature.name = feature.role;
  return features;
}

RecordingColumns::RecordingColumns(const Recording& recording, const ComputedFiles& files)
    : recording_(recording), files_(files) {
  if (files.companion) computed_ = computed_columns(*files.companion);
  try {
    const double pixel_size_um = recording.metadata().number("imaging:pixel size").value_or(0);
    shapes_.emplace(recording, pixel_size_um);
    features_.emplace(recording, *shapes_);
  } catch (const UserError&) {  // such recordings have only what they store
  }
}

std::vector<std::string> RecordingColumns::names() const {
  std::vector<std::string> names = features_ ? features_->names() : recording_.scalar_names();
  std::erase_if(names, is_basin_mapping);
  std::ranges::transform(names, names.begin(), name_of_stored);
  std::ranges::sort(names);
  std::erase_if(names, [this](const std::string& name) { return computed(name) || has_modulus(name); });
  for (const auto& column : computed_) names.push_back(column.name);
  if (files_.moduli)
    for (const ColumnDescription& feature : moduli_features()) names.push_back(feature.role);
  return names;
}

bool RecordingColumns::has_modulus(const std::string& name) const {
  return files_.moduli && std::ranges::count(moduli_features(), name, &ColumnDescription::role) > 0;
}

bool RecordingColumns::has(const std::string& name) const {
  if (computed(name) || has_modulus(name)) return true;
  const std::string feature = stored_feature(name);
  return features_ ? features_->has(feature) : recording_.has_scalar(feature);
}

const std::string* RecordingColumns::computed(const std::string& name) const {
  const auto found = std::ranges::find(computed_, name, &ComputedColumn::name);
  return found == computed_.end() ? nullptr : &found->feature;
}

void RecordingColumns::read(const std::string& name, std::size_t first, std::span<double> values) {
  if (const std::string* feature = computed(name)) return files_.companion->read_scalar(*feature, first, values);
  if (has_modulus(name)) return files_.moduli->read_scalar(name, first, values);
  if (!has(name)) refuse_path(recording_.file(), fmt::format("has no feature {}.", one_line(name, 60)));
  if (features_) return features_->read(stored_feature(name), first, values);
  recording_.read_scalar(stored_feature(name), first, values);
}

void append_numbers(std::span<const double> values, NumberType type, std::string& bytes) {
  if (type == NumberType::float32)
    append<float>(values, bytes);
  else
    append<double>(values, bytes);
}

}  // namespace rheocyte
