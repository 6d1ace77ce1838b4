#include "measurement/companion_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "measurement/basin.h"
#include "measurement/hdf5_reading.h"
#include "measurement/hdf5_writing.h"

namespace rheocyte {

struct CompanionFeature {
  Hdf5Handle dataset;
  Hdf5Handle original = {};  ///< to be copied
  Extremes extremes;
};

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_attribute = 1 << 20;
constexpr const char* version_key = "setup:software version";
constexpr const char* count_key = "experiment:event count";

// The sections that dclab knows; an attribute in any other makes a file unreadable for it.
constexpr std::array<std::string_view, 9> sections{"calculation",    "experiment",    "fluorescence", "imaging",
                                                   "online_contour", "online_filter", "pipeline",     "qpi",
                                                   "setup"};

bool is_kept(std::string_view key) {
  const auto colon = key.find(':');
  if (colon == std::string_view::npos || key.find(':', colon + 1) != std::string_view::npos) return false;
  if (key == version_key || key == count_key || key.starts_with("calculation:emodulus")) return false;
  const auto section = key.substr(0, colon);
  return section == "user" || std::ranges::find(sections, section) != sections.end();
}

// Copies an attribute with its type and shape; what cannot be copied is left out.
herr_t copy_attribute(hid_t from, const char* name, const H5A_info_t*, void* target) {
  if (std::strlen(name) > reading_limits.name_length || !is_kept(name)) return 0;
  const Hdf5Handle source(::H5Aopen(from, name, H5P_DEFAULT));
  const Hdf5Handle file_type(source ? ::H5Aget_type(source.get()) : -1),
      space(source ? ::H5Aget_space(source.get()) : -1);
  if (!file_type || !space) return 0;
  const Hdf5Handle type(::H5Tcopy(file_type.get()));
  const hssize_t count = ::H5Sget_simple_extent_npoints(space.get());
  const std::size_t size = type ? ::H5Tget_size(type.get()) : 0;
  if (count < 1 || size == 0 || static_cast<std::size_t>(count) > max_attribute / size) return 0;
  std::vector<unsigned char> values(static_cast<std::size_t>(count) * size);
  if (::H5Aread(source.get(), type.get(), values.data()) < 0) return 0;
  const Hdf5Handle copy(
      ::H5Acreate2(*static_cast<const hid_t*>(target), name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
  if (copy) ::H5Awrite(copy.get(), type.get(), values.data());
  ::H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, values.data());
  return 0;
}

// One chunk after the other as it is stored. (H5Ocopy writes past the end of its memory when it meets a chunk that was
// read before and that compresses to less than its size: HDF5 1.10.)
bool copy_chunks(hid_t original, hid_t copy, hsize_t rows, hsize_t chunk) {
  std::vector<unsigned char> bytes;
  for (hsize_t row = 0; row < rows; row += chunk) {
    hsize_t size = 0;
    std::uint32_t skipped_filters = 0;
    if (::H5Dget_chunk_storage_size(original, &row, &size) < 0) return false;
    if (size == 0) continue;  // never written
    bytes.resize(size);
    if (::H5Dread_chunk(original, H5P_DEFAULT, &row, &skipped_filters, bytes.data()) < 0 ||
        ::H5Dwrite_chunk(copy, H5P_DEFAULT, skipped_filters, &row, size, bytes.data()) < 0)
      return false;
  }
  return true;
}

// As it is stored, without its attributes. All of it has been read, and thus checked, by now.
bool copy_original(CompanionFeature& feature, WrittenFile& file, const std::string& path) {
  const hid_t original = feature.original.get();
  const Hdf5Handle type(::H5Dget_type(original)), space(::H5Dget_space(original)),
      properties(::H5Dget_create_plist(original));
  hsize_t rows = 0, chunk = 0;
  if (::H5Sget_simple_extent_dims(space.get(), &rows, nullptr) != 1 || ::H5Pget_chunk(properties.get(), 1, &chunk) != 1)
    return false;
  feature.dataset = file.dataset(path, type.get(), space.get(), properties.get());
  if (!feature.dataset || !copy_chunks(original, feature.dataset.get(), rows, chunk)) return false;
  feature.original = {};
  return true;
}

}  // namespace

struct CompanionFile::Content {
  Content(const fs::path& path, std::size_t count) : file(path), events(count) {}

  /// Declares numbers of a type of the file.
  void add(const std::string& feature, hid_t type) {
    const hsize_t extent = events, unlimited = H5S_UNLIMITED;
    const hsize_t chunk = std::clamp<hsize_t>(extent, 10, written_chunk_bytes / ::H5Tget_size(type));
    const Hdf5Handle space(::H5Screate_simple(1, &extent, &unlimited)), properties = compressed({&chunk, 1});
    const Hdf5Handle access(::H5Pcreate(H5P_DATASET_ACCESS));
    ::H5Pset_chunk_cache(access.get(), 521, 4 * written_chunk_bytes, 1.0);
    CompanionFeature& added = features[feature];
    added.dataset = file.dataset("events/" + feature, type, space.get(), properties.get(), access.get());
    file.check(bool(added.dataset), feature);
  }

  WrittenFile file;
  std::size_t events;
  std::map<std::string, CompanionFeature> features;
};

CompanionFile::CompanionFile(const fs::path& file, const Recording& original, const std::string& program)
    : content_(std::make_unique<Content>(file, original.events())) {
  Content& c = *content_;
  hid_t target = c.file.get();
  ::H5Aiterate2(original.root(), H5_INDEX_NAME, H5_ITER_INC, nullptr, copy_attribute, &target);
  const auto events = static_cast<std::int64_t>(c.events);
  const auto version = original.metadata().text(version_key);
  bool good = write_attribute(target, count_key, H5T_NATIVE_INT64, &events);
  good = good && write_text(target, version_key, version ? *version + " | " + program : program);
  const Hdf5Handle group(::H5Gcreate2(target, "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  c.file.check(good && group, "the metadata");
}

CompanionFile::~CompanionFile() = default;

void CompanionFile::add_user_metadata(const std::string& key, const std::string& text) {
  const std::string name = "user:" + key;
  ::H5Adelete(content_->file.get(), name.c_str());  // a companion of a companion
  content_->file.check(write_text(content_->file.get(), name, text), name);
}

void CompanionFile::add_feature(const std::string& feature) { content_->add(feature, H5T_IEEE_F32LE); }

void CompanionFile::add_feature_of(const Recording& original, const std::string& feature) {
  const auto dataset = original.compressed_scalar(feature);
  if (!dataset) return content_->add(feature, original.has_scalar(feature) ? H5T_IEEE_F64LE : H5T_IEEE_F32LE);
  ::H5Iinc_ref(*dataset);
  content_->features[feature].original = Hdf5Handle(*dataset);
}

void CompanionFile::write(const std::string& feature, std::size_t first, std::span<const double> values) {
  Content& c = *content_;
  CompanionFeature& target = c.features.at(feature);
  target.extremes.add(values);
  if (target.original) return;
  const hsize_t start = first, count = values.size();
  const Hdf5Handle space(::H5Dget_space(target.dataset.get())), memory(::H5Screate_simple(1, &count, nullptr));
  const bool good =
      ::H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &start, nullptr, &count, nullptr) >= 0 &&
      ::H5Dwrite(target.dataset.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()) >= 0;
  c.file.check(good, feature);
}

void CompanionFile::add_log(const std::string& name, const std::vector<std::string>& lines) {
  content_->file.check(write_lines(content_->file, "logs/" + name, broken_lines(lines)), "the log");
}

void CompanionFile::add_basin(const std::vector<std::string>& paths) {
  content_->file.check(write_lines(content_->file, "basins/original", file_basin_lines("original recording", paths)),
                       "the basin");
}

void CompanionFile::close() {
  Content& c = *content_;
  for (auto& [name, feature] : c.features)
    if (feature.original) c.file.check(copy_original(feature, c.file, "events/" + name), name);
  for (const auto& [name, feature] : c.features)
    c.file.check(write_extremes(feature.dataset.get(), feature.extremes), name);
  c.features.clear();
  c.file.close();
}

bool has_log(const Recording& recording, const std::string& name) {
  return ::H5Lexists(recording.root(), "logs", H5P_DEFAULT) > 0 &&
         ::H5Lexists(recording.root(), ("logs/" + name).c_str(), H5P_DEFAULT) > 0;
}

}  // namespace rheocyte
