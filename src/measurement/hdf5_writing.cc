#include "measurement/hdf5_writing.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "case/utf8.h"
#include "measurement/zstd_filter.h"

namespace rheocyte {

namespace {

constexpr unsigned compression_level = 5;  // that which the field's checker wants

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(::H5Tcopy(H5T_C_S1));
  ::H5Tset_size(type.get(), size);
  ::H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  return type;
}

}  // namespace

bool write_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle space(::H5Screate(H5S_SCALAR));
  const Hdf5Handle attribute(::H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT));
  return attribute && ::H5Awrite(attribute.get(), type, value) >= 0;
}

bool write_text(hid_t object, const std::string& name, const std::string& text) {
  Hdf5Handle type(::H5Tcopy(H5T_C_S1));
  ::H5Tset_size(type.get(), H5T_VARIABLE);
  ::H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const char* pointer = text.c_str();
  return write_attribute(object, name, type.get(), static_cast<const void*>(&pointer));
}

Hdf5Handle compressed(std::span<const hsize_t> chunk) {
  Hdf5Handle properties(::H5Pcreate(H5P_DATASET_CREATE));
  ::H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  ::H5Pset_filter(properties.get(), zstd_filter_number, H5Z_FLAG_MANDATORY, 1, &compression_level);
  ::H5Pset_fletcher32(properties.get());
  ::H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

bool is_compressed(hid_t dataset) {
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  if (!properties || ::H5Pget_layout(properties.get()) != H5D_CHUNKED) return false;
  unsigned flags = 0, level = 0;
  std::size_t count = 1, none = 0;
  return ::H5Pget_filter_by_id2(properties.get(), zstd_filter_number, &flags, &count, &level, 0, nullptr, nullptr) >=
             0 &&
         count == 1 && level >= compression_level &&
         ::H5Pget_filter_by_id2(properties.get(), H5Z_FILTER_FLETCHER32, &flags, &none, nullptr, 0, nullptr, nullptr) >=
             0;
}

bool write_lines(WrittenFile& file, const std::string& path, const std::vector<std::string>& lines) {
  std::size_t longest = longest_log_line;
  for (const auto& line : lines) longest = std::max(longest, line.size());
  std::vector<char> characters(longest * lines.size(), '\0');
  for (std::size_t i = 0; i < lines.size(); ++i)
    std::memcpy(characters.data() + i * longest, lines[i].data(), lines[i].size());
  const hsize_t extent = lines.size();
  const Hdf5Handle type = text_type(longest), space(::H5Screate_simple(1, &extent, nullptr));
  const hsize_t chunk = std::max<hsize_t>(extent, 1);
  const Hdf5Handle dataset = file.dataset(path, type.get(), space.get(), compressed({&chunk, 1}).get());
  return dataset && ::H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()) >= 0;
}

std::vector<std::string> broken_lines(const std::vector<std::string>& lines) {
  std::vector<std::string> broken;
  for (const auto& any : lines) {
    const std::string line = valid_utf8(any);
    std::size_t at = 0;
    do {
      std::size_t end = std::min(at + longest_log_line, line.size());
      if (end < line.size()) end = start_of_character(line, end);
      broken.push_back(line.substr(at, end - at));
      at = end;
    } while (at < line.size());
  }
  return broken;
}

void Extremes::add(std::span<const double> values) {
  for (const double value : values) {
    const bool counts = std::isfinite(value);
    least = counts && value < least ? value : least;
    greatest = counts && value > greatest ? value : greatest;
    sum += counts ? value : 0;
    count += counts;
  }
}

bool write_extremes(hid_t dataset, const Extremes& extremes) {
  if (extremes.count == 0) return true;
  const double mean = extremes.sum / static_cast<double>(extremes.count);
  const Hdf5Handle type(::H5Dget_type(dataset));
  const bool is_single = ::H5Tequal(type.get(), H5T_IEEE_F32LE) > 0;
  const auto write = [&](const char* name, double value) {
    const auto rounded = static_cast<float>(value);
    return is_single ? write_attribute(dataset, name, H5T_NATIVE_FLOAT, &rounded)
                     : write_attribute(dataset, name, H5T_NATIVE_DOUBLE, &value);
  };
  return write("min", extremes.least) && write("max", extremes.greatest) &&
         write_attribute(dataset, "mean", H5T_NATIVE_DOUBLE, &mean);
}

}  // namespace rheocyte
