#include "measurement/text_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>

#include "case/joined.h"
#include "case/refuse_path.h"
#include "case/toml_json.h"
#include "case/user_error.h"
#include "measurement/hdf5_writing.h"
#include "measurement/metadata.h"
#include "measurement/text_table.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t max_text_bytes = std::size_t{1} << 31U;
constexpr std::array<std::string_view, 3> set_up_sections{"setup", "imaging", "experiment"};
constexpr TextKind set_up{"set-up", "set-up", "cells.toml", "", true};

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

/// "[setup]", and in it "flow rate" = 0.04.
void add_set_up(const fs::path& toml, MetadataTexts& metadata) {
  const std::string name = one_line(toml.string(), 300);
  const Json all = json_of_toml(read_case_text(toml, set_up), name, set_up);
  for (const auto& [section, keys] : all.items()) {
    if (std::ranges::find(set_up_sections, section) == set_up_sections.end() || !keys.is_object())
      throw UserError(fmt::format("{}: {} is no section of a set-up; there are [{}].", name, one_line(section, 60),
                                  joined(set_up_sections, "], [")));
    for (const auto& [key, value] : keys.items()) {
      if (value.is_structured())
        throw UserError(fmt::format("{}: [{}] {} must be a number or a text; names with blanks stand in quotes.", name,
                                    section, one_line(key, 60)));
      add_metadata(metadata, fmt::format("{}:{}", section, key), value_text(value), name);
    }
  }
}

void refuse_other_text(const fs::path& file, std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    refuse_path(file, "is text in UTF-16; save it as CSV in UTF-8.");
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    refuse_path(file,
                "is not text; tables of events have one line per event, and names of HDF5 recordings end in .rtdc.");
}

/// Never on the disk. HDF5 takes open files of one name for the same one.
Hdf5Handle file_in_memory() {
  static std::atomic<unsigned> files = 0;
  const Hdf5Handle access(::H5Pcreate(H5P_FILE_ACCESS));
  ::H5Pset_fapl_core(access.get(), written_chunk_bytes, false);
  const std::string name = fmt::format("rheocyte table of events in memory {}", files++);
  return Hdf5Handle(::H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()));
}

bool write_column(hid_t group, const TextTable::Column& column) {
  const hsize_t events = column.values.size();
  const Hdf5Handle space(::H5Screate_simple(1, &events, nullptr));
  const Hdf5Handle dataset(::H5Dcreate2(group, column.feature.c_str(), H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT));
  return dataset &&
         ::H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) >= 0;
}

/// In the type that the field's programs give it. What begins with further zeros is a name of figures.
bool write_value(hid_t file, const std::string& key, const std::string& text) {
  const auto number = Metadata(std::map<std::string, Metadata::Value>{{key, text}}).number(key);
  const bool is_name = text.size() > 1 && text[0] == '0' && std::isdigit(static_cast<unsigned char>(text[1])) != 0;
  if (!number || !std::isfinite(*number) || is_name) return write_text(file, key, text);
  if (text.find_first_not_of("-0123456789") != std::string::npos || std::abs(*number) > 1e15)
    return write_attribute(file, key, H5T_NATIVE_DOUBLE, &*number);
  const auto whole = static_cast<std::int64_t>(*number);
  return write_attribute(file, key, H5T_NATIVE_INT64, &whole);
}

Hdf5Handle written(const TextTable& table) {
  Hdf5Handle file = file_in_memory();
  const Hdf5Handle group(::H5Gcreate2(file.get(), "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  bool good = file && group;
  for (const auto& column : table.columns) good = good && write_column(group.get(), column);
  for (const auto& [key, value] : table.metadata) good = good && write_value(file.get(), key, value);
  return good ? std::move(file) : Hdf5Handle();
}

}  // namespace

OpenedRecording open_text_recording(const fs::path& file) {
  OpenedRecording opened;
  TextTable table;
  {
    const std::string text = content_of_file(file, max_text_bytes);
    refuse_other_text(file, text);
    table = parse_text_table(text, one_line(file.string(), 300));
  }
  const fs::path toml = fs::path(file).replace_extension(".toml");
  std::error_code error;
  if (fs::exists(toml, error)) {
    add_set_up(toml, table.metadata);
    opened.others.push_back(toml);
  }
  // Often that of the recording of which the table has a part.
  table.metadata.erase("experiment:event count");
  if (!table.left_out.empty())
    opened.remarks.push_back(fmt::format("columns that are left out: {}.", joined(table.left_out, ", ")));
  opened.file = written(table);
  if (!opened.file) refuse_path(file, "cannot be kept in memory; it is too large, or has metadata that HDF5 refuses.");
  return opened;
}

}  // namespace rheocyte
