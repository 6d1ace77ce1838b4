// Whatever types, filters and lengths a recording has, its numbers come out as they were put in.
#include "measurement/recording.h"

#include <cmath>
#include <fstream>

#include "case/user_error.h"
#include "measurement/basin.h"
#include "measurement/hdf5_handle.h"
#include "measurement/recording_columns.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"

namespace rheocyte::recording_test {
namespace {

using test::column;
using test::RecordingWriter;
using test::remarks_contain;
using test::ScratchFolder;
using test::Storage;

std::string sentence_for(const std::filesystem::path& file) {
  try {
    const Recording recording(file);
  } catch (const UserError& error) {
    return error.what();
  }
  return "opened";
}

TEST(Recording, NumbersOfEveryTypeAndFilterComeBackExactly) {
  const ScratchFolder folder;
  const std::vector<double> values{0, 1, 2, 3, 100, 127, 5, 6};  // fit into every type
  const std::vector<Storage> storages{{},
                                      {Storage::Filter::none, true, 3},
                                      {Storage::Filter::gzip, true, 3},
                                      {Storage::Filter::szip, false, 8},
                                      {Storage::Filter::zstd, true, 3},
                                      {Storage::Filter::zstd, false, 100}};
  const hid_t types[] = {H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_STD_I8LE, H5T_STD_U16BE, H5T_STD_I32LE, H5T_STD_U64LE};
  {
    RecordingWriter writer(folder / "a.rtdc");
    for (std::size_t s = 0; s < storages.size(); ++s)
      for (std::size_t t = 0; t < std::size(types); ++t)
        writer.scalar("f" + std::to_string(s) + "_" + std::to_string(t), values, types[t], storages[s]);
  }
  const Recording recording(folder / "a.rtdc");
  ASSERT_EQ(recording.events(), values.size());
  for (std::size_t s = 0; s < storages.size(); ++s)
    for (std::size_t t = 0; t < std::size(types); ++t)
      EXPECT_EQ(column(recording, "f" + std::to_string(s) + "_" + std::to_string(t)), values) << s << " " << t;
  std::vector<double> middle(3);
  recording.read_scalar("f4_0", 2, middle);
  EXPECT_EQ(middle, (std::vector<double>{2, 3, 100}));
}

TEST(Recording, MetadataOfEveryTypeAreRead) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1});
    writer.number("imaging:pixel size", 0.34);
    writer.integer("setup:channel width", 30);
    writer.truth("online_contour:no absdiff", true);
    writer.text("setup:medium", "CellCarrier");
    writer.fixed_text("setup:chip region", "channel");
    writer.text("setup:temperature", " 23.5 ");
    writer.polygon("online_filter:area_um,deform polygon points", {0, 0, 1, 0, 1, 1});
  }
  const Recording recording(folder / "a.rtdc");
  const Metadata& metadata = recording.metadata();
  EXPECT_EQ(metadata.number("imaging:pixel size"), 0.34);
  EXPECT_EQ(metadata.number("setup:channel width"), 30);
  EXPECT_EQ(metadata.number("online_contour:no absdiff"), 1);
  EXPECT_EQ(metadata.text("setup:medium"), "CellCarrier");
  EXPECT_EQ(metadata.text("setup:chip region"), "channel");
  EXPECT_EQ(metadata.number("setup:temperature"), 23.5) << "a number that was written as text";
  EXPECT_FALSE(metadata.number("setup:medium"));
  EXPECT_FALSE(metadata.has("online_filter:area_um,deform polygon points"));
  EXPECT_FALSE(metadata.text("setup:flow rate"));
}

TEST(Recording, FeaturesThatAreTooShortEndInNaNAndARemark) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.integer("experiment:event count", 7);
    writer.scalar("deform", {0.1, 0.2, 0.3});
    writer.scalar("area_um", {10, 20, 30});
    writer.scalar("temp", {23, 24});
    writer.scalar("frame", {1, 2, 3, 4});
    writer.images("mask", std::vector<std::uint8_t>(5 * 4 * 6, 255), 4, 6);
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_EQ(recording.events(), 3U);
  const auto temperature = column(recording, "temp");
  EXPECT_EQ(temperature[1], 24);
  EXPECT_TRUE(std::isnan(temperature[2]));
  EXPECT_EQ(column(recording, "frame"), (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(remarks_contain(recording, "experiment:event count is 7"));
  EXPECT_TRUE(remarks_contain(recording, "temp has 2 rows"));
  EXPECT_TRUE(remarks_contain(recording, "mask has 5 rows"));
}

TEST(Recording, PicturesAndContoursComeBackExactly) {
  const ScratchFolder folder;
  std::vector<std::uint8_t> pixels(7 * 5 * 8);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * 37);
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.images("image", pixels, 5, 8, {Storage::Filter::szip, true, 1});
    writer.images("mask", pixels, 5, 8, {Storage::Filter::zstd, true, 4});
    writer.contour({1, 1, 2, 1, 2, 2, 1, 2});
    writer.contour({}, H5T_STD_I64LE);
    writer.contour({-3, 4, 5, 6}, H5T_STD_I32BE);
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_EQ(recording.events(), 7U);
  for (const char* feature : {"image", "mask"}) {
    EXPECT_EQ(recording.image_size(feature), (ImageSize{8, 5}));
    std::vector<std::uint8_t> all(pixels.size()), piece(2 * 40);
    recording.read_images(feature, 0, 7, all);
    EXPECT_EQ(all, pixels) << feature;
    recording.read_images(feature, 3, 2, piece);
    EXPECT_TRUE(std::equal(piece.begin(), piece.end(), pixels.begin() + 3 * 40)) << feature;
    recording.read_images(feature, 6, 2, piece);
    EXPECT_EQ(piece[40], 0) << "beyond the last event";
  }
  EXPECT_EQ(recording.image_rows_per_chunk("mask"), 4U);
  EXPECT_EQ(recording.read_contour(0), (PixelContour{{1, 1}, {2, 1}, {2, 2}, {1, 2}}));
  EXPECT_TRUE(recording.read_contour(1).empty());
  EXPECT_EQ(recording.read_contour(2), (PixelContour{{-3, 4}, {5, 6}}));
  EXPECT_TRUE(recording.read_contour(3).empty());
}

TEST(Recording, WhatIsNoRecordingIsRefusedInOneSentence) {
  const ScratchFolder folder;
  EXPECT_NE(sentence_for(folder / "none.rtdc").find("no such file"), std::string::npos);
  EXPECT_NE(sentence_for(folder / "").find("not a file"), std::string::npos);
  std::ofstream(folder / "text.rtdc") << "area_um,deform\n1,2\n";
  EXPECT_NE(sentence_for(folder / "text.rtdc").find("not an HDF5 file"), std::string::npos);
  for (const auto& [name, words] : {std::pair("old.tdms", "convert it with dclab-tdms2rtdc"),
                                    std::pair("session.so2", "is a session of DCscope, not a recording"),
                                    std::pair("filters.poly", "give it with --polygon")}) {
    std::ofstream(folder / name) << "TDSm";
    EXPECT_NE(sentence_for(folder / name).find(words), std::string::npos) << name;
  }
  std::ofstream(folder / "empty.rtdc");
  EXPECT_NE(sentence_for(folder / "empty.rtdc").find("not an HDF5 file"), std::string::npos);
  { RecordingWriter writer(folder / "no-events.rtdc"); }
  EXPECT_NE(sentence_for(folder / "no-events.rtdc").find("no events"), std::string::npos);
  {
    RecordingWriter writer(folder / "cut.rtdc");
    writer.scalar("deform", std::vector<double>(10000, 0.1));
  }
  std::filesystem::resize_file(folder / "cut.rtdc", 40000);
  EXPECT_NE(sentence_for(folder / "cut.rtdc").find("damaged or incomplete"), std::string::npos);
}

TEST(Recording, AClaimOfMoreDataThanTheFileCanHoldIsNoFeature) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2});
    const hsize_t extent = 1ULL << 50, chunk = 1 << 20;
    const Hdf5Handle space(::H5Screate_simple(1, &extent, nullptr)), properties(::H5Pcreate(H5P_DATASET_CREATE));
    ::H5Pset_chunk(properties.get(), 1, &chunk);
    const Hdf5Handle bomb(::H5Dcreate2(writer.root(), "events/area_um", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT,
                                       properties.get(), H5P_DEFAULT));
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_EQ(recording.events(), 2U);
  EXPECT_FALSE(recording.has_scalar("area_um"));
  EXPECT_TRUE(remarks_contain(recording, "area_um contains no usable numbers"));
}

TEST(Recording, DataThatLieInOtherFilesAreNotFollowed) {
  const ScratchFolder folder;
  std::ofstream(folder / "secret") << "0123456789abcdef";
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2});
    const hsize_t extent = 2;
    const Hdf5Handle space(::H5Screate_simple(1, &extent, nullptr)), properties(::H5Pcreate(H5P_DATASET_CREATE));
    ::H5Pset_external(properties.get(), (folder / "secret").c_str(), 0, 16);
    const Hdf5Handle external(::H5Dcreate2(writer.root(), "events/area_um", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT,
                                           properties.get(), H5P_DEFAULT));
    ASSERT_TRUE(external);
    ::H5Lcreate_soft("/events/circ", writer.root(), "events/circ", H5P_DEFAULT, H5P_DEFAULT);  // leads to itself
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_FALSE(recording.has_scalar("area_um"));
  EXPECT_FALSE(recording.has_scalar("circ"));
  EXPECT_TRUE(recording.has_scalar("deform"));
}

TEST(Recording, ContoursAloneAreEvents) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    for (int i = 0; i < 3; ++i) writer.contour({i, i, i, 2 * i});
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_EQ(recording.events(), 3U);
  EXPECT_EQ(recording.read_contour(2), (PixelContour{{2, 2}, {2, 4}}));
}

TEST(Recording, OneThatIsBeingWrittenIsNotCalledDamaged) {
  const ScratchFolder folder;
  const Hdf5Handle newest(::H5Pcreate(H5P_FILE_ACCESS));
  ::H5Pset_libver_bounds(newest.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  const Hdf5Handle file(::H5Fcreate((folder / "a.rtdc").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, newest.get()));
  ASSERT_TRUE(file);
  ASSERT_GE(::H5Fstart_swmr_write(file.get()), 0);
  std::filesystem::copy_file(folder / "a.rtdc", folder / "seen.rtdc");  // as another process sees it
  try {
    const Recording recording(folder / "seen.rtdc");
    FAIL() << "it is open for writing";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("is open for writing"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace rheocyte::recording_test
