#include "measurement/hdf5_reading.h"

#include <cstring>
#include <functional>

#include "measurement/hdf5_numbers.h"
#include "measurement/zstd_filter.h"

namespace rheocyte {

namespace {

bool is_kind(hid_t object, H5I_type_t kind) { return ::H5Iget_type(object) == kind; }

herr_t refuse_link(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) { return -1; }

// A link to another file would let a recording read any of them, and wait at a pipe that never answers.
hid_t within_the_file() {
  static const Hdf5Handle access = [] {
    Hdf5Handle links(::H5Pcreate(H5P_LINK_ACCESS));
    ::H5Pset_elink_cb(links.get(), refuse_link, nullptr);
    return links;
  }();
  return access.get();
}

Hdf5Handle open_object(hid_t parent, const std::string& name, H5I_type_t kind) {
  if (::H5Lexists(parent, name.c_str(), within_the_file()) <= 0) return {};
  Hdf5Handle object(::H5Oopen(parent, name.c_str(), within_the_file()));
  if (!object || !is_kind(object.get(), kind)) return {};
  return object;
}

struct CollectedNames {
  std::vector<std::string> names;
  bool too_many = false;
};

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* data) {
  auto& collected = *static_cast<CollectedNames*>(data);
  if (collected.names.size() >= reading_limits.names) {
    collected.too_many = true;
    return 1;
  }
  if (std::strlen(name) <= reading_limits.name_length) collected.names.emplace_back(name);
  return 0;
}

std::string text_of(const char* data, std::size_t longest) { return {data, ::strnlen(data, longest)}; }

// Texts of one attribute or dataset: `read` fills a buffer with elements of the given type.
using Reader = std::function<bool(hid_t type, void* buffer)>;

std::optional<std::vector<std::string>> texts(hid_t type, hid_t space, const Reader& read) {
  const hssize_t count = ::H5Sget_simple_extent_npoints(space);
  if (count < 0 || static_cast<std::size_t>(count) > reading_limits.text_lines) return std::nullopt;
  std::vector<std::string> lines;
  if (count == 0) return lines;
  const Hdf5Handle memory_type(::H5Tcopy(type));
  if (::H5Tis_variable_str(type) > 0) {
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    if (!read(memory_type.get(), static_cast<void*>(pointers.data()))) return std::nullopt;
    for (const char* text : pointers) lines.push_back(text ? text_of(text, reading_limits.text_length) : "");
    ::H5Dvlen_reclaim(memory_type.get(), space, H5P_DEFAULT, static_cast<void*>(pointers.data()));
    return lines;
  }
  const std::size_t size = ::H5Tget_size(type);
  if (size == 0 || size > reading_limits.text_length || size * static_cast<std::size_t>(count) > (64U << 20U))
    return std::nullopt;
  std::vector<char> characters(size * static_cast<std::size_t>(count));
  if (!read(memory_type.get(), characters.data())) return std::nullopt;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    lines.push_back(text_of(characters.data() + i * size, size));
  return lines;
}

std::optional<Metadata::Value> value_of(hid_t attribute) {
  const Hdf5Handle type(::H5Aget_type(attribute)), space(::H5Aget_space(attribute));
  if (!type || !space || ::H5Sget_simple_extent_npoints(space.get()) != 1) return std::nullopt;
  if (const auto number = number_in(attribute)) return *number;
  if (::H5Tget_class(type.get()) != H5T_STRING) return std::nullopt;
  const auto lines = texts(type.get(), space.get(), [&](hid_t memory_type, void* buffer) {
    return ::H5Aread(attribute, memory_type, buffer) >= 0;
  });
  return lines && lines->size() == 1 ? std::optional<Metadata::Value>(lines->front()) : std::nullopt;
}

herr_t collect_attribute(hid_t object, const char* name, const H5A_info_t*, void* data) {
  auto& values = *static_cast<std::map<std::string, Metadata::Value>*>(data);
  if (values.size() >= reading_limits.text_lines) return 1;
  if (std::strlen(name) > reading_limits.name_length) return 0;
  const Hdf5Handle attribute(::H5Aopen(object, name, H5P_DEFAULT));
  if (!attribute) return 0;
  if (auto value = value_of(attribute.get())) values.emplace(name, std::move(*value));
  return 0;
}

}  // namespace

void prepare_hdf5() {
  static const bool done = [] {
    ::H5dont_atexit();  // what could not be written whole would be closed then (measurement/written_file.h)
    ::H5open();
    ::H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    register_zstd_filter();
    return true;
  }();
  static_cast<void>(done);
}

Hdf5Handle open_group(hid_t parent, const std::string& name) { return open_object(parent, name, H5I_GROUP); }

Hdf5Handle open_dataset(hid_t parent, const std::string& name) { return open_object(parent, name, H5I_DATASET); }

std::optional<std::vector<std::string>> member_names(hid_t group) {
  CollectedNames collected;
  if (::H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &collected) < 0) return std::nullopt;
  if (collected.too_many) return std::nullopt;
  return std::move(collected.names);
}

std::optional<std::vector<std::string>> read_lines(hid_t dataset, std::uintmax_t file_bytes) {
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  if (!properties || !lies_in_the_file(properties.get())) return std::nullopt;
  const Hdf5Handle space(::H5Dget_space(dataset)), type(::H5Dget_type(dataset));
  if (!space || !type || ::H5Tget_class(type.get()) != H5T_STRING) return std::nullopt;
  const double bytes =
      static_cast<double>(::H5Sget_simple_extent_npoints(space.get())) * static_cast<double>(::H5Tget_size(type.get()));
  if (bytes > reading_limits.max_compression * static_cast<double>(file_bytes)) return std::nullopt;
  return texts(type.get(), space.get(), [&](hid_t memory_type, void* buffer) {
    return ::H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer) >= 0;
  });
}

bool leads_to_another_file(hid_t parent, const std::string& name) {
  H5L_info_t link{};
  return ::H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0 &&
         ::H5Lget_info(parent, name.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_EXTERNAL;
}

Metadata read_attributes(hid_t object) {
  std::map<std::string, Metadata::Value> values;
  ::H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &values);
  return Metadata(std::move(values));
}

}  // namespace rheocyte
