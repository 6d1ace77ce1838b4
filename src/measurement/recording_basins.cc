// The part of Recording that finds features in basins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "case/joined.h"
#include "case/user_error.h"
#include "measurement/recording_content.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_number_of_basins = 16;
constexpr int max_number_of_files = 64;  // basins of basins included
constexpr const char* internal_group = "basin_events";

}  // namespace

void Recording::open_basins(Opening& opening) {
  Content& c = *content_;
  const Hdf5Handle group = open_group(c.file.get(), "basins");
  auto names = group ? member_names(group.get()) : std::nullopt;
  if (!names) return;
  if (names->size() > max_number_of_basins) {
    c.remarks.push_back(fmt::format("has {} basins; only the first {} are used.", names->size(), max_number_of_basins));
    names->resize(max_number_of_basins);
  }
  std::vector<BasinDefinition> cropped;
  for (const auto& name : *names) {
    const Hdf5Handle dataset = open_dataset(group.get(), name);
    const auto lines = dataset ? read_lines(dataset.get(), c.bytes) : std::nullopt;
    if (!lines) continue;
    const auto definition = read_basin_definition(joined(*lines, "\n"));
    if (!definition)
      c.remarks.push_back(why_basin_is_not_used(joined(*lines, "\n")));
    else if (definition->kind == BasinDefinition::Kind::cropped)
      cropped.push_back(*definition);
    else
      add_basin(*definition, opening);
  }
  for (const BasinDefinition& definition : cropped) add_cropped_images(definition);
}

void Recording::add_basin(const BasinDefinition& definition, Opening& opening) {
  Content& c = *content_;
  Basin basin;
  basin.features = definition.features;
  if (!definition.mapping.empty()) {
    const auto found = c.scalars.find(definition.mapping);
    basin.mapping.emplace(found == c.scalars.end() ? 0 : found->second.shape.rows());
    if (basin.mapping->empty() || !read_rows(found->second, 0, *basin.mapping)) {
      c.remarks.push_back(
          fmt::format("the basin \"{}\" is not used: its map of events is missing.", one_line(definition.name, 60)));
      return;
    }
  }
  if (definition.kind == BasinDefinition::Kind::internal)
    add_internal_basin(std::move(basin));
  else
    add_file_basin(definition, std::move(basin), opening);
}

void Recording::add_internal_basin(Basin basin) {
  Content& c = *content_;
  const Hdf5Handle group = open_group(c.file.get(), internal_group);
  const auto names = group ? member_names(group.get()) : std::nullopt;
  for (const auto& feature : names.value_or(std::vector<std::string>())) {
    auto data = open_numbers(group.get(), feature, c.bytes);
    if (data && (data->shape.extent.size() == 1 || data->shape.is_pictures()))
      basin.internal.emplace(feature, std::move(*data));
  }
  c.basins.push_back(std::move(basin));
}

void Recording::add_file_basin(const BasinDefinition& definition, Basin basin, Opening& opening) {
  Content& c = *content_;
  std::string reason = "its file was not found";
  for (const auto& file : basin_files(definition, c.path)) {
    reason = open_basin_file(file, basin, opening);
    if (!reason.empty()) continue;
    c.bytes_with_basins += basin.recording->content_->bytes_with_basins;
    // A file may consist of basins alone.
    if (c.events == 0) c.events = basin.mapping ? basin.mapping->size() : basin.recording->events();
    c.basins.push_back(std::move(basin));
    return;
  }
  c.remarks.push_back(fmt::format("the basin \"{}\" is not used: {}.", one_line(definition.name, 60), reason));
}

void Recording::add_cropped_images(const BasinDefinition& definition) {
  Content& c = *content_;
  const Hdf5Handle group = open_group(c.file.get(), internal_group);
  const auto names = group ? member_names(group.get()) : std::nullopt;
  Basin basin;
  basin.features = definition.features;
  std::string missing;
  for (const auto& feature : names.value_or(std::vector<std::string>())) {
    if (basin.features && std::ranges::find(*basin.features, feature) == basin.features->end()) continue;
    auto images = CroppedImages::open(open_group(group.get(), feature), size_of_pictures(), c.bytes);
    if (!images) continue;
    const std::string& background = images->background();
    if (images->size().pixels() == 0)
      missing = "the size of its pictures (imaging:roi size x, imaging:roi size y) is missing";
    else if (!background.empty() && (feature != "image" || background == feature ||  // one of its own could lead back
                                     image_size(background) != images->size()))
      missing = fmt::format("its background {} is missing or of another size", one_line(background, 60));
    else
      basin.cropped.emplace(feature, std::move(*images));
  }
  if (basin.cropped.empty())
    c.remarks.push_back(fmt::format("the basin \"{}\" is not used: {}.", one_line(definition.name, 60),
                                    missing.empty() ? "its pictures are missing" : missing));
  else
    c.basins.push_back(std::move(basin));
}

ImageSize Recording::size_of_pictures() const {
  const auto width = content_->metadata.number("imaging:roi size x"),
             height = content_->metadata.number("imaging:roi size y");
  const auto is_side = [](double n) { return n >= 1 && n <= double(reading_limits.image_side) && n == std::floor(n); };
  if (width && height && is_side(*width) && is_side(*height)) return {std::size_t(*width), std::size_t(*height)};
  return image_size("image_bg").value_or(image_size("mask").value_or(ImageSize{}));
}

std::string Recording::open_basin_file(const fs::path& file, Basin& basin, Opening& opening) const {
  std::error_code error;
  const auto link = opening.chain.insert(fs::weakly_canonical(file, error));
  if (!link.second) return "it leads back to a file that is open";
  std::string problem;
  try {
    if (++opening.files > max_number_of_files) throw UserError("its files refer to too many others");
    basin.recording.reset(new Recording(file, opening));
  } catch (const UserError& refusal) {
    problem = refusal.what();
    problem.resize(problem.find_last_not_of('.') + 1);
  }
  opening.chain.erase(link.first);
  if (!problem.empty()) return problem;
  if (!same_measurement(content_->metadata, basin.recording->metadata(), basin.mapping.has_value()))
    return "it belongs to another measurement";
  return {};
}

bool Recording::is_in(const Basin& basin, const std::string& feature, Kind kind) {
  if (basin.features && std::ranges::find(*basin.features, feature) == basin.features->end()) return false;
  if (!basin.recording) {
    const auto found = basin.internal.find(feature);
    const std::size_t dimensions = found == basin.internal.end() ? 0 : found->second.shape.extent.size();
    return kind == Kind::pictures ? dimensions == 3 || basin.cropped.contains(feature)
                                  : kind == Kind::scalar && dimensions == 1;
  }
  switch (kind) {
    case Kind::scalar: return basin.recording->has_scalar(feature);
    case Kind::pictures: return basin.recording->image_size(feature).has_value();
    case Kind::contours: return basin.recording->has_contours();
  }
  return false;
}

// Internal ones first, as the field's programs do.
std::vector<std::string> Recording::scalar_names() const {
  std::set<std::string> names;
  for (const auto& [name, feature] : content_->scalars) names.insert(name);
  for (const Basin& basin : content_->basins) {
    for (const auto& [name, feature] : basin.internal) names.insert(name);
    if (!basin.recording) continue;
    for (const auto& name : basin.recording->scalar_names()) names.insert(name);
  }
  std::erase_if(names, [this](const std::string& name) { return !has_scalar(name); });
  return {names.begin(), names.end()};
}

const Recording::Basin* Recording::basin_with(const std::string& feature, Kind kind) const {
  for (const bool internal : {true, false})
    for (const auto& basin : content_->basins)
      if (internal == !basin.recording && is_in(basin, feature, kind)) return &basin;
  return nullptr;
}

void Recording::read_through(const Basin& basin, const std::string& feature, std::size_t first,
                             std::span<double> values) {
  constexpr std::size_t longest_gap = 64;  // reading on over a gap costs less than a new request
  const auto read = [&](std::size_t from, std::span<double> target) {
    if (basin.recording) return basin.recording->read_scalar(feature, from, target);
    const auto& dataset = basin.internal.at(feature);
    const std::size_t rows = dataset.shape.rows(), there = from < rows ? std::min(target.size(), rows - from) : 0;
    const bool good = read_rows(dataset, from, target.first(there));
    std::ranges::fill(target.subspan(good ? there : 0), no_value);
  };
  if (!basin.mapping) return read(first, values);
  const auto& map = *basin.mapping;
  std::ranges::fill(values, no_value);
  const std::size_t count = first < map.size() ? std::min(values.size(), map.size() - first) : 0;
  std::vector<double> piece;
  for (std::size_t i = 0; i < count;) {
    if (map[first + i] < 0) {  // none: the basin has no such event
      ++i;
      continue;
    }
    // As many events as ascend without a long gap.
    std::size_t end = i + 1;
    while (end < count && map[first + end] >= map[first + end - 1] &&
           map[first + end] - map[first + end - 1] <= static_cast<std::int64_t>(longest_gap))
      ++end;
    const std::int64_t from = map[first + i];
    piece.resize(static_cast<std::size_t>(map[first + end - 1] - from + 1));
    read(static_cast<std::size_t>(from), piece);
    for (std::size_t k = i; k < end; ++k) values[k] = piece[static_cast<std::size_t>(map[first + k] - from)];
    i = end;
  }
}

}  // namespace rheocyte
