#include "measurement/recording_file.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "measurement/basin.h"
#include "measurement/hdf5_writing.h"

namespace rheocyte {

struct GrowingFeature {
  Hdf5Handle dataset;
  hsize_t events = 0;
  Extremes extremes;  // of scalars only
};

namespace {

namespace fs = std::filesystem;

hid_t stored_type(const std::string& feature) {
  if (feature == "index") return H5T_STD_U32LE;
  return feature == "frame" || feature.starts_with("basinmap") ? H5T_STD_U64LE : H5T_IEEE_F64LE;
}

// Without it the field's programs would show an array of numbers, not pictures.
bool mark_as_images(hid_t dataset) {
  const auto text = [&](const char* name, const std::string& value) {
    const Hdf5Handle type(::H5Tcopy(H5T_C_S1));
    ::H5Tset_size(type.get(), value.size());
    ::H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    return write_attribute(dataset, name, type.get(), value.data());
  };
  return text("CLASS", "IMAGE") && text("IMAGE_VERSION", "1.2") && text("IMAGE_SUBCLASS", "IMAGE_GRAYSCALE");
}

// Extends the dataset by `count` rows and writes them.
bool append_rows(GrowingFeature& feature, std::vector<hsize_t> extent, hid_t type, const void* values) {
  std::vector<hsize_t> start(extent.size(), 0), total = extent;
  start[0] = feature.events;
  total[0] += feature.events;
  if (::H5Dset_extent(feature.dataset.get(), total.data()) < 0) return false;
  const int rank = static_cast<int>(extent.size());
  const Hdf5Handle space(::H5Dget_space(feature.dataset.get())),
      memory(::H5Screate_simple(rank, extent.data(), nullptr));
  if (::H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) < 0 ||
      ::H5Dwrite(feature.dataset.get(), type, memory.get(), space.get(), H5P_DEFAULT, values) < 0)
    return false;
  feature.events = total[0];
  return true;
}

}  // namespace

struct RecordingFile::Content {
  explicit Content(const fs::path& path) : file(path) {}

  WrittenFile file;
  std::map<std::string, GrowingFeature> features;

  // `extent` of one chunk; the dataset is empty at first.
  GrowingFeature& feature(const std::string& name, hid_t type, std::vector<hsize_t> extent) {
    const auto [there, is_new] = features.try_emplace(name);
    if (!is_new) return there->second;
    const Hdf5Handle properties = compressed(extent);
    const int rank = static_cast<int>(extent.size());
    std::vector<hsize_t> greatest = extent;
    extent[0] = 0;
    greatest[0] = H5S_UNLIMITED;
    const Hdf5Handle space(::H5Screate_simple(rank, extent.data(), greatest.data()));
    const Hdf5Handle access(::H5Pcreate(H5P_DATASET_ACCESS));
    ::H5Pset_chunk_cache(access.get(), 521, 4 * written_chunk_bytes, 1.0);
    there->second.dataset = file.dataset("events/" + name, type, space.get(), properties.get(), access.get());
    file.check(bool(there->second.dataset), name);
    return there->second;
  }
};

RecordingFile::RecordingFile(const fs::path& file) : content_(std::make_unique<Content>(file)) {
  const Hdf5Handle group(::H5Gcreate2(content_->file.get(), "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  content_->file.check(bool(group), "the file");
}

RecordingFile::~RecordingFile() = default;

void RecordingFile::add_metadata(const std::string& key, double value) {
  content_->file.check(write_attribute(content_->file.get(), key, H5T_NATIVE_DOUBLE, &value), key);
}

void RecordingFile::add_metadata(const std::string& key, std::int64_t value) {
  content_->file.check(write_attribute(content_->file.get(), key, H5T_NATIVE_INT64, &value), key);
}

void RecordingFile::add_metadata(const std::string& key, const std::string& text) {
  content_->file.check(write_text(content_->file.get(), key, text), key);
}

void RecordingFile::append(const std::string& name, std::span<const double> values) {
  if (values.empty()) return;
  constexpr hsize_t chunk =
      1 << 14;  // 128 KiB: small recordings stay small, HDF5 pads the last chunk before compressing
  GrowingFeature& feature = content_->feature(name, stored_type(name), {chunk});
  content_->file.check(append_rows(feature, {values.size()}, H5T_NATIVE_DOUBLE, values.data()), name);
  feature.extremes.add(values);
}

void RecordingFile::append_images(const std::string& name, ImageSize size, std::span<const std::uint8_t> pixels) {
  const hsize_t count = pixels.size() / size.pixels();
  assert(count * size.pixels() == pixels.size());
  if (count == 0) return;
  const hsize_t chunk = std::max<hsize_t>(10, written_chunk_bytes / size.pixels());
  const bool is_new = !content_->features.contains(name);
  GrowingFeature& feature = content_->feature(name, H5T_STD_U8LE, {chunk, size.height, size.width});
  if (is_new) content_->file.check(mark_as_images(feature.dataset.get()), name);
  std::vector<std::uint8_t> masks;
  if (name == "mask") {
    masks.assign(pixels.begin(), pixels.end());
    for (auto& pixel : masks) pixel = pixel ? 255 : 0;
  }
  const void* const values = name == "mask" ? masks.data() : pixels.data();
  content_->file.check(append_rows(feature, {count, size.height, size.width}, H5T_NATIVE_UINT8, values), name);
}

void RecordingFile::add_basin(const fs::path& recording, const std::string& map) {
  const auto lines = file_basin_lines("original", {recording.string()}, map);
  content_->file.check(write_lines(content_->file, "basins/original", lines), "the basin");
}

void RecordingFile::add_log(const std::string& name, const std::vector<std::string>& lines) {
  content_->file.check(write_lines(content_->file, "logs/" + name, broken_lines(lines)), "the log");
}

void RecordingFile::close() {
  Content& c = *content_;
  const hsize_t events = c.features.empty() ? 0 : c.features.begin()->second.events;
  add_metadata("experiment:event count", static_cast<std::int64_t>(events));
  for (const auto& [name, feature] : c.features) {
    assert(feature.events == events);
    c.file.check(write_extremes(feature.dataset.get(), feature.extremes), name);
  }
  c.features.clear();
  c.file.close();
}

}  // namespace rheocyte
