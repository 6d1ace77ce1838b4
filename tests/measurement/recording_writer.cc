#include "measurement/recording_writer.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <iostream>

#include "measurement/hdf5_handle.h"

namespace rheocyte::test {

namespace {

hid_t good(hid_t id, const std::string& what) {
  if (id < 0) {
    std::cerr << "the test cannot write " << what << "\n";
    std::abort();
  }
  return id;
}

Hdf5Handle layout(const Storage& storage, std::vector<hsize_t> extent) {
  Hdf5Handle properties(::H5Pcreate(H5P_DATASET_CREATE));
  if (storage.rows_per_chunk == 0) return properties;
  extent[0] = storage.rows_per_chunk;
  ::H5Pset_chunk(properties.get(), static_cast<int>(extent.size()), extent.data());
  const unsigned level = 5;
  switch (storage.filter) {
    case Storage::Filter::gzip: ::H5Pset_deflate(properties.get(), level); break;
    case Storage::Filter::szip: ::H5Pset_szip(properties.get(), H5_SZIP_NN_OPTION_MASK, 8); break;
    case Storage::Filter::zstd: ::H5Pset_filter(properties.get(), 32015, H5Z_FLAG_MANDATORY, 1, &level); break;
    case Storage::Filter::none: break;
  }
  if (storage.checksum) ::H5Pset_fletcher32(properties.get());
  return properties;
}

Hdf5Handle creating_groups() {
  Hdf5Handle links(::H5Pcreate(H5P_LINK_CREATE));
  ::H5Pset_create_intermediate_group(links.get(), 1);
  return links;
}

struct Data {
  hid_t file_type, memory_type;
  std::vector<hsize_t> extent;
  const void* values;
};

void write(hid_t file, const std::string& path, const Data& data, const Storage& storage = {}) {
  std::vector<hsize_t> greatest = data.extent;
  if (storage.rows_per_chunk > 0) greatest[0] = H5S_UNLIMITED;
  const Hdf5Handle space(::H5Screate_simple(static_cast<int>(greatest.size()), data.extent.data(), greatest.data()));
  const Hdf5Handle properties = layout(storage, data.extent), links = creating_groups();
  const Hdf5Handle dataset(good(
      ::H5Dcreate2(file, path.c_str(), data.file_type, space.get(), links.get(), properties.get(), H5P_DEFAULT), path));
  good(::H5Dwrite(dataset.get(), data.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values), path);
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file) {
  prepare_hdf5();
  file_ = good(::H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), file.string());
  const Hdf5Handle events(good(::H5Gcreate2(file_, "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "events"));
}

RecordingWriter::~RecordingWriter() { ::H5Fclose(file_); }

void RecordingWriter::attribute(hid_t object, const std::string& key, hid_t type, const void* value) {
  const Hdf5Handle space(::H5Screate(H5S_SCALAR));
  const Hdf5Handle attribute(good(::H5Acreate2(object, key.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), key));
  good(::H5Awrite(attribute.get(), type, value), key);
}

void RecordingWriter::number(const std::string& key, double value) { attribute(file_, key, H5T_NATIVE_DOUBLE, &value); }

void RecordingWriter::integer(const std::string& key, int value) { attribute(file_, key, H5T_NATIVE_INT, &value); }

void RecordingWriter::truth(const std::string& key, bool value) {
  const Hdf5Handle type(::H5Tenum_create(H5T_NATIVE_INT8));
  const signed char no = 0, yes = 1, stored = value ? yes : no;
  ::H5Tenum_insert(type.get(), "FALSE", &no);
  ::H5Tenum_insert(type.get(), "TRUE", &yes);
  attribute(file_, key, type.get(), &stored);
}

void RecordingWriter::text_at(hid_t object, const std::string& key, const std::string& value) {
  const Hdf5Handle type(::H5Tcopy(H5T_C_S1));
  ::H5Tset_size(type.get(), H5T_VARIABLE);
  ::H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const char* pointer = value.c_str();
  attribute(object, key, type.get(), static_cast<const void*>(&pointer));
}

void RecordingWriter::text(const std::string& key, const std::string& value) { text_at(file_, key, value); }

void RecordingWriter::fixed_text(const std::string& key, const std::string& value) {
  const Hdf5Handle type(::H5Tcopy(H5T_C_S1));
  ::H5Tset_size(type.get(), value.size());
  ::H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  attribute(file_, key, type.get(), value.data());
}

void RecordingWriter::polygon(const std::string& key, const std::vector<double>& xy) {
  const hsize_t extent[] = {xy.size() / 2, 2};
  const Hdf5Handle space(::H5Screate_simple(2, extent, nullptr));
  const Hdf5Handle attribute(
      good(::H5Acreate2(file_, key.c_str(), H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT, H5P_DEFAULT), key));
  good(::H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, xy.data()), key);
}

void RecordingWriter::scalar(const std::string& feature, const std::vector<double>& values, hid_t type,
                             const Storage& storage, const std::string& group) {
  write(file_, group + "/" + feature, {type, H5T_NATIVE_DOUBLE, {values.size()}, values.data()}, storage);
}

void RecordingWriter::images(const std::string& feature, const std::vector<std::uint8_t>& pixels, hsize_t height,
                             hsize_t width, const Storage& storage, const std::string& group) {
  write(file_, group + "/" + feature,
        {H5T_STD_U8LE, H5T_NATIVE_UINT8, {pixels.size() / (height * width), height, width}, pixels.data()}, storage);
}

void RecordingWriter::index_of_cropped(const std::string& feature, const std::vector<int>& table,
                                       const std::string& background) {
  const std::string path = "basin_events/" + feature;
  write(file_, path + "/index", {H5T_STD_I64LE, H5T_NATIVE_INT, {table.size() / 5, 5}, table.data()});
  if (background.empty()) return;
  const Hdf5Handle group(good(::H5Gopen2(file_, path.c_str(), H5P_DEFAULT), path));
  text_at(group.get(), "inverse_background_feature", background);
}

void RecordingWriter::contour(const std::vector<int>& xy, hid_t type) {
  write(file_, "events/contour/" + std::to_string(contours_++), {type, H5T_NATIVE_INT, {xy.size() / 2, 2}, xy.data()});
}

void RecordingWriter::lines(const std::string& path, const std::vector<std::string>& lines) {
  std::size_t longest = 100;
  for (const auto& line : lines) longest = std::max(longest, line.size());
  std::vector<char> characters(longest * lines.size(), '\0');
  for (std::size_t i = 0; i < lines.size(); ++i)
    std::memcpy(characters.data() + i * longest, lines[i].data(), lines[i].size());
  const Hdf5Handle type(::H5Tcopy(H5T_C_S1));
  ::H5Tset_size(type.get(), longest);
  write(file_, path, {type.get(), type.get(), {lines.size()}, characters.data()});
}

void write_usual_metadata(RecordingWriter& writer) {
  writer.text("experiment:date", "2026-01-31");
  writer.text("experiment:time", "12:34:56");
  writer.text("experiment:sample", "test");
  writer.integer("experiment:run index", 1);
  writer.number("imaging:pixel size", 0.34);
  writer.number("setup:channel width", 20);
  writer.fixed_text("setup:chip region", "channel");
  writer.number("setup:flow rate", 0.04);
  writer.text("setup:medium", "CellCarrier");
  writer.number("setup:temperature", 23);
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "rheocyte-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) std::abort();
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace rheocyte::test
