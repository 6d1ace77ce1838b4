#include "measurement/basin.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "case/json_guard.h"
#include "case/split.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "measurement/any_bytes.h"
#include "numeric/md5.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t max_number_of_paths = 64;

json parsed(const std::string& json_text) {
  const std::string text = escapes_as_stand_ins(json_text);
  return is_sound_json(text) ? json::parse(text) : json();
}

std::string text_at(const json& definition, const char* key) {
  const auto found = definition.find(key);
  return found != definition.end() && found->is_string() ? without_stand_ins(found->get<std::string>()) : std::string();
}

std::vector<std::string> texts_in(const json& list) {
  std::vector<std::string> texts;
  for (const auto& entry : list)
    if (entry.is_string() && texts.size() < max_number_of_paths)
      texts.push_back(without_stand_ins(entry.get<std::string>()));
  return texts;
}

// As it was written, with its blanks, for it goes into the digest; nothing if absent or empty.
std::optional<std::string> raw_text(const Metadata& metadata, const std::string& key) {
  const auto found = metadata.values().find(key);
  if (found == metadata.values().end()) return std::nullopt;
  const auto* const text = std::get_if<std::string>(&found->second);
  if (!text) return metadata.text(key);
  return text->empty() ? std::nullopt : std::optional(*text);
}

// 16 bytes in the groups of a UUID.
std::string as_uuid(const std::string& digits) {
  return fmt::format("{}-{}-{}-{}-{}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(12, 4),
                     digits.substr(16, 4), digits.substr(20));
}

// Paths are written by programs of any system.
std::string file_name_in(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

std::string with_slashes(std::string path) {
  std::ranges::replace(path, '\\', '/');
  return path;
}

}  // namespace

std::optional<BasinDefinition> read_basin_definition(const std::string& json_text) {
  const json definition = parsed(json_text);
  if (!definition.is_object()) return std::nullopt;
  BasinDefinition basin;
  const std::string type = text_at(definition, "type"), format = text_at(definition, "format");
  if (type == "file" && format == "hdf5")
    basin.kind = BasinDefinition::Kind::file;
  else if (type == "internal" && format == "h5dataset")
    basin.kind = BasinDefinition::Kind::internal;
  else if (type == "internal" && format == "h5datasetchop")
    basin.kind = BasinDefinition::Kind::cropped;
  else
    return std::nullopt;
  basin.name = text_at(definition, "name");
  if (const auto paths = definition.find("paths"); paths != definition.end() && paths->is_array())
    basin.paths = texts_in(*paths);
  if (const auto features = definition.find("features"); features != definition.end() && features->is_array())
    basin.features = texts_in(*features);
  if (const auto mapping = text_at(definition, "mapping"); mapping != "same") basin.mapping = mapping;
  return basin;
}

std::string why_basin_is_not_used(const std::string& json_text) {
  const json definition = parsed(json_text);
  const std::string type = definition.is_object() ? text_at(definition, "type") : "",
                    format = definition.is_object() ? text_at(definition, "format") : "";
  if (type.empty() || format.empty()) return "a basin is not used: its definition is broken.";
  const std::string name = one_line(fmt::format("{} ({})", text_at(definition, "name"), format), 80);
  if (type == "remote")
    return fmt::format(
        "the basin \"{}\" is not used: it is on a network, which is not read; download the file and refer to it, or "
        "put its features into the recording.",
        name);
  return fmt::format(
      "the basin \"{}\" is not used: basins of this kind are not supported; export the recording with all its features "
      "by the program that wrote it.",
      name);
}

std::vector<std::string> file_basin_lines(const std::string& name, const std::vector<std::string>& paths,
                                          const std::string& mapping) {
  std::vector<std::string> names;
  for (const auto& path : paths) names.push_back(with_stand_ins(path));
  const json definition{{"description", nullptr}, {"features", nullptr}, {"format", "hdf5"},
                        {"identifier", nullptr},  {"mapping", mapping},  {"name", name},
                        {"paths", names},         {"perishable", false}, {"type", "file"}};
  return text_lines(stand_ins_escaped(definition.dump(2, ' ', false, json::error_handler_t::replace)));
}

std::vector<fs::path> basin_files(const BasinDefinition& basin, const fs::path& referring_file) {
  std::vector<fs::path> files;
  for (const auto& path : basin.paths)
    for (const auto& place : {path, with_slashes(path), file_name_in(path)}) {
      std::error_code error;
      const fs::path candidate = referring_file.parent_path() / to_path(place);  // an absolute path stays itself
      if (fs::is_regular_file(candidate, error) && std::ranges::find(files, candidate) == files.end())
        files.push_back(candidate);
    }
  return files;
}

std::optional<std::string> measurement_identifier(const Metadata& metadata) {
  if (auto run = raw_text(metadata, "experiment:run identifier")) return run;
  const auto time = raw_text(metadata, "experiment:time"), date = raw_text(metadata, "experiment:date"),
             setup = raw_text(metadata, "setup:identifier");
  if (!time || !date || !setup) return std::nullopt;
  return as_uuid(md5(fmt::format("{}_{}_{}", *time, *date, *setup)));
}

bool same_measurement(const Metadata& referring, const Metadata& basin, bool mapped) {
  const auto ours = measurement_identifier(referring), theirs = measurement_identifier(basin);
  if (!ours || !theirs) return true;
  return mapped ? ours->starts_with(*theirs) : *ours == *theirs;
}

}  // namespace rheocyte
