// A companion holds the results, the metadata of the original and the way to it, and nothing that dclab cannot open.
#include "measurement/companion_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "case/user_error.h"
#include "case/utf8.h"
#include "measurement/hdf5_reading.h"
#include "measurement/hdf5_writing.h"
#include "measurement/recording_columns.h"
#include "measurement/recording_writer.h"

namespace rheocyte::companion_file_test {
namespace {

using test::column;
using test::RecordingWriter;
using test::ScratchFolder;

void write_original(const std::filesystem::path& file) {
  RecordingWriter writer(file);
  test::write_usual_metadata(writer);
  writer.integer("experiment:event count", 99);
  writer.text("setup:software version", "ShapeIn 2.0.6 | dclab 0.18.0");
  writer.truth("online_contour:no absdiff", true);
  writer.polygon("online_filter:area_um,deform polygon points", {0, 0, 1, 0, 1, 1});
  writer.text("user:note", "kept");
  // dclab cannot open a file with one of these.
  writer.text("generator", "x");
  writer.text("unknown:key", "x");
  writer.text("setup:a:b", "x");
  // Settings for a modulus that is not ours.
  writer.text("calculation:emodulus lut", "LE-2D-FEM-19");
  writer.scalar("area_um", {10, 20, 30});
  writer.scalar("deform", {0.1, 0.2, 0.3});
}

TEST(CompanionFile, ResultsAreWrittenInSinglePrecisionAndItsExtremesAreThoseOfTheFile) {
  const ScratchFolder folder;
  write_original(folder / "a.rtdc");
  const std::vector<double> values{0.1, 1.0 / 3, NAN};
  {
    const Recording original(folder / "a.rtdc");
    CompanionFile companion(folder / "b.rtdc", original, "rheocyte 1.2.3");
    companion.add_feature("emodulus");
    companion.write("emodulus", 0, values);
    companion.close();
  }
  EXPECT_EQ(column(Recording(folder / "b.rtdc"), "emodulus")[1], 1.0F / 3);
  const Hdf5Handle file(::H5Fopen((folder / "b.rtdc").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  const Hdf5Handle dataset(::H5Dopen2(file.get(), "events/emodulus", H5P_DEFAULT)), type(::H5Dget_type(dataset.get()));
  EXPECT_EQ(::H5Tget_size(type.get()), sizeof(float));
  const auto extreme = [&](const char* name) {
    const Hdf5Handle attribute(::H5Aopen(dataset.get(), name, H5P_DEFAULT));
    double value = 0;
    ::H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value);
    return value;
  };
  EXPECT_EQ(extreme("min"), 0.1F);
  EXPECT_EQ(extreme("max"), 1.0F / 3);
}

TEST(CompanionFile, TogetherWithTheOriginalItIsTheWholeRecording) {
  const ScratchFolder folder;
  write_original(folder / "a.rtdc");
  {
    const Recording original(folder / "a.rtdc");
    CompanionFile companion(folder / "b.rtdc", original, "rheocyte 1.2.3");
    companion.add_feature("emodulus");
    companion.write("emodulus", 1, std::vector<double>{2.5, NAN});
    companion.write("emodulus", 0, std::vector<double>{1.5});
    companion.add_user_metadata("rheocyte note", "text");
    companion.add_log("rheocyte", {"short", std::string(250, 'x')});
    companion.add_basin({"a.rtdc"});
    companion.close();
  }
  const Recording recording(folder / "b.rtdc");
  EXPECT_TRUE(recording.remarks().empty()) << recording.remarks().front();
  EXPECT_EQ(recording.events(), 3U);
  const auto moduli = column(recording, "emodulus");
  EXPECT_EQ(moduli[0], 1.5);
  EXPECT_EQ(moduli[1], 2.5);
  EXPECT_TRUE(std::isnan(moduli[2]));
  EXPECT_EQ(column(recording, "area_um"), (std::vector<double>{10, 20, 30}));
  const Metadata& metadata = recording.metadata();
  EXPECT_EQ(metadata.number("experiment:event count"), 3) << "that of the data";
  EXPECT_EQ(metadata.text("setup:software version"), "ShapeIn 2.0.6 | dclab 0.18.0 | rheocyte 1.2.3");
  EXPECT_EQ(metadata.text("setup:medium"), "CellCarrier");
  EXPECT_EQ(metadata.text("setup:chip region"), "channel");
  EXPECT_EQ(metadata.number("online_contour:no absdiff"), 1);
  EXPECT_EQ(metadata.text("user:note"), "kept");
  EXPECT_EQ(metadata.text("user:rheocyte note"), "text");
  for (const char* key : {"generator", "unknown:key", "setup:a:b", "calculation:emodulus lut"})
    EXPECT_FALSE(metadata.has(key)) << key;
}

TEST(CompanionFile, TypesOfMetadataAreThoseOfTheOriginal) {
  const ScratchFolder folder;
  write_original(folder / "a.rtdc");
  CompanionFile(folder / "b.rtdc", Recording(folder / "a.rtdc"), "rheocyte").close();
  const Hdf5Handle file(::H5Fopen((folder / "b.rtdc").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  const auto type_of = [&](const char* name) {
    const Hdf5Handle attribute(::H5Aopen(file.get(), name, H5P_DEFAULT)), type(::H5Aget_type(attribute.get()));
    return ::H5Tget_class(type.get());
  };
  EXPECT_EQ(type_of("online_contour:no absdiff"), H5T_ENUM);
  EXPECT_EQ(type_of("experiment:run index"), H5T_INTEGER);
  EXPECT_EQ(type_of("setup:channel width"), H5T_FLOAT);
  const Hdf5Handle polygon(::H5Aopen(file.get(), "online_filter:area_um,deform polygon points", H5P_DEFAULT));
  double points[6] = {};
  ASSERT_TRUE(polygon);
  ::H5Aread(polygon.get(), H5T_NATIVE_DOUBLE, points);
  EXPECT_EQ(points[5], 1);
}

TEST(CompanionFile, FeaturesAreCompressedCheckedAndCarryTheirExtremes) {
  const ScratchFolder folder;
  write_original(folder / "a.rtdc");
  CompanionFile companion(folder / "b.rtdc", Recording(folder / "a.rtdc"), "rheocyte");
  companion.add_feature("emodulus");
  companion.write("emodulus", 0, std::vector<double>{3, NAN, 1});
  companion.close();
  const Hdf5Handle file(::H5Fopen((folder / "b.rtdc").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  const Hdf5Handle dataset(::H5Dopen2(file.get(), "events/emodulus", H5P_DEFAULT));
  const Hdf5Handle properties(::H5Dget_create_plist(dataset.get()));
  unsigned flags = 0;
  std::size_t values = 0, no_values = 0;
  ASSERT_EQ(::H5Pget_nfilters(properties.get()), 2);
  EXPECT_EQ(::H5Pget_filter2(properties.get(), 0, &flags, &values, nullptr, 0, nullptr, nullptr), 32015);
  EXPECT_EQ(::H5Pget_filter2(properties.get(), 1, &flags, &no_values, nullptr, 0, nullptr, nullptr),
            H5Z_FILTER_FLETCHER32);
  const Metadata extremes = read_attributes(dataset.get());
  EXPECT_EQ(extremes.number("min"), 1);
  EXPECT_EQ(extremes.number("max"), 3);
  EXPECT_EQ(extremes.number("mean"), 2);
}

/// The bytes of a feature's numbers in memory, as they are stored.
std::size_t stored_width(const std::filesystem::path& path, const std::string& feature) {
  const Hdf5Handle file(::H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  const Hdf5Handle dataset(::H5Dopen2(file.get(), ("events/" + feature).c_str(), H5P_DEFAULT));
  return ::H5Tget_size(Hdf5Handle(::H5Dget_type(dataset.get())).get());
}

TEST(CompanionFile, FeaturesOfTheOriginalAreTakenOverAsTheyAreStored) {
  // Where they are compressed as a companion wants it, in the original's precision; else they are written again. Both
  // ways carry the same numbers and their extremes.
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {10, 20, 30}, H5T_IEEE_F32LE, {test::Storage::Filter::zstd, true, 2});
    writer.scalar("deform", {0.25, NAN, 0.5}, H5T_IEEE_F32LE, {test::Storage::Filter::zstd, false, 2});
  }
  {
    const Recording original(folder / "a.rtdc");
    CompanionFile companion(folder / "b.rtdc", original, "rheocyte");
    for (const char* feature : {"area_um", "deform"}) {
      companion.add_feature_of(original, feature);
      companion.write(feature, 0, column(original, feature));
    }
    companion.close();
  }
  EXPECT_EQ(stored_width(folder / "b.rtdc", "area_um"), 4U) << "taken over";
  EXPECT_EQ(stored_width(folder / "b.rtdc", "deform"), 8U) << "without checksums in the original";
  for (const auto& [feature, max] : {std::pair("area_um", 30.0), std::pair("deform", 0.5)}) {
    const Hdf5Handle file(::H5Fopen((folder / "b.rtdc").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    const Hdf5Handle dataset(::H5Dopen2(file.get(), (std::string("events/") + feature).c_str(), H5P_DEFAULT));
    EXPECT_EQ(read_attributes(dataset.get()).number("max"), max) << feature;
  }
  const Recording recording(folder / "b.rtdc");
  EXPECT_EQ(column(recording, "area_um"), (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(column(recording, "deform")[2], 0.5);
  EXPECT_TRUE(std::isnan(column(recording, "deform")[1]));
}

TEST(CompanionFile, FeaturesOfManyChunksAreTakenOverWhole) {
  // Chunks that were read before, that compress well, and that differ in size.
  std::vector<double> values(5000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i < 3000 ? 20 : std::sin(double(i));
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", values, H5T_IEEE_F64LE, {test::Storage::Filter::zstd, true, 300});
  }
  {
    const Recording original(folder / "a.rtdc");
    CompanionFile companion(folder / "b.rtdc", original, "rheocyte");
    companion.add_feature_of(original, "area_um");
    companion.write("area_um", 0, column(original, "area_um"));
    companion.close();
  }
  EXPECT_EQ(column(Recording(folder / "b.rtdc"), "area_um"), values);
}

TEST(CompanionFile, LogsAndTheBasinAreCompressedToo) {
  // dclab's check of integrity counts every dataset.
  const ScratchFolder folder;
  write_original(folder / "a.rtdc");
  CompanionFile companion(folder / "b.rtdc", Recording(folder / "a.rtdc"), "rheocyte");
  companion.add_log("a-log", {"one", "two"});
  companion.add_basin({"a.rtdc"});
  companion.close();
  const Hdf5Handle file(::H5Fopen((folder / "b.rtdc").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  for (const std::string group : {"logs", "basins"}) {
    const auto names = member_names(open_group(file.get(), group).get());
    ASSERT_TRUE(names && names->size() == 1) << group;
    const Hdf5Handle dataset = open_dataset(file.get(), group + "/" + names->front());
    EXPECT_EQ(::H5Pget_nfilters(Hdf5Handle(::H5Dget_create_plist(dataset.get())).get()), 2) << group;
  }
}

TEST(CompanionFile, LinesOfLogsAreBrokenBetweenCharacters) {
  std::string text;
  for (int i = 0; i < 150; ++i) text += i % 2 ? "\xC3\xBC" : "a";
  std::string joined;
  for (const auto& line : broken_lines({text})) {
    EXPECT_LE(line.size(), longest_log_line);
    EXPECT_EQ(first_bad_byte(line), std::string_view::npos) << line;
    joined += line;
  }
  EXPECT_EQ(joined, text);
  EXPECT_EQ(broken_lines({"", "recording: Z\xFCrich"}), (std::vector<std::string>{"", "recording: Z?rich"}));
}

TEST(CompanionFile, WhereNothingCanBeWrittenTheUserIsTold) {
  const ScratchFolder folder;
  write_original(folder / "a.rtdc");
  const Recording original(folder / "a.rtdc");
  EXPECT_THROW(CompanionFile(folder / "none/b.rtdc", original, "rheocyte"), UserError);
}

}  // namespace
}  // namespace rheocyte::companion_file_test
