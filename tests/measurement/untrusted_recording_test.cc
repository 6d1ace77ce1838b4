// A recording is believed in nothing that it cannot hold: links, pieces that are absent, claims and maps of events.
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <numeric>

#include "case/user_error.h"
#include "measurement/hdf5_handle.h"
#include "measurement/recording.h"
#include "measurement/recording_columns.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"

namespace rheocyte::untrusted_recording_test {
namespace {

namespace fs = std::filesystem;
using test::column;
using test::RecordingWriter;
using test::remarks_contain;
using test::ScratchFolder;
using test::Storage;

std::string sentence_for(const fs::path& file) {
  try {
    const Recording recording(file);
  } catch (const UserError& error) {
    return error.what();
  }
  return "opened";
}

TEST(UntrustedRecording, LinksToOtherFilesAreNotFollowed) {
  const ScratchFolder folder;
  {
    RecordingWriter secret(folder / "secret.h5");
    secret.scalar("area_um", {1, 2});
  }
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);  // opened, it would block for ever
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2});
    const auto link = [&](const char* file, const char* target, const char* name) {
      ASSERT_GE(::H5Lcreate_external((folder / file).c_str(), target, writer.root(), name, H5P_DEFAULT, H5P_DEFAULT),
                0);
    };
    link("secret.h5", "/events/area_um", "events/area_um");
    link("secret.h5", "/events", "other");
    link("pipe", "/events/volume", "events/volume");
    link("pipe", "/contour", "events/contour");
    link("pipe", "/basins", "basins");
    ::H5Lcreate_soft("/other/area_um", writer.root(), "events/area_cvx", H5P_DEFAULT, H5P_DEFAULT);
  }
  const Recording recording(folder / "a.rtdc");
  for (const char* feature : {"area_um", "area_cvx", "volume"}) EXPECT_FALSE(recording.has_scalar(feature)) << feature;
  EXPECT_FALSE(recording.has_contours());
  EXPECT_TRUE(remarks_contain(recording, "area_um is a link to another file, which is not followed"));
  EXPECT_EQ(column(recording, "deform"), (std::vector<double>{0.1, 0.2}));
  {
    RecordingWriter writer(folder / "b.rtdc");
    ::H5Ldelete(writer.root(), "events", H5P_DEFAULT);
    ::H5Lcreate_external((folder / "pipe").c_str(), "/events", writer.root(), "events", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_NE(sentence_for(folder / "b.rtdc").find("keeps its events in another file"), std::string::npos);
}

TEST(UntrustedRecording, VirtualDataOpenNoOtherFile) {
  const ScratchFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2});
    const hsize_t extent = 2, unlimited = H5S_UNLIMITED, start = 0, one = 1;
    const Hdf5Handle space(::H5Screate_simple(1, &extent, &unlimited)),
        there(::H5Screate_simple(1, &extent, &unlimited));
    const Hdf5Handle shape(::H5Pcreate(H5P_DATASET_CREATE));
    ::H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &start, nullptr, &unlimited, &one);
    ::H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, &start, nullptr, &unlimited, &one);
    ::H5Pset_virtual(shape.get(), space.get(), (folder / "pipe").c_str(), "/x", there.get());
    const Hdf5Handle made(::H5Dcreate2(writer.root(), "events/area_um", H5T_IEEE_F64LE, space.get(), H5P_DEFAULT,
                                       shape.get(), H5P_DEFAULT));
  }
  EXPECT_FALSE(Recording(folder / "a.rtdc").has_scalar("area_um"));
}

TEST(UntrustedRecording, WhatWasNeverWrittenIsNoNumber) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2, 0.3});
    const auto declare = [&](const char* name, hsize_t chunk) {
      const hsize_t extent = 3;
      const Hdf5Handle space(::H5Screate_simple(1, &extent, nullptr)), shape(::H5Pcreate(H5P_DATASET_CREATE));
      if (chunk > 0) ::H5Pset_chunk(shape.get(), 1, &chunk);
      const Hdf5Handle made(
          ::H5Dcreate2(writer.root(), name, H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, shape.get(), H5P_DEFAULT));
      ASSERT_TRUE(made);
    };
    declare("events/area_um", 0);
    declare("events/volume", 2);
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_THROW(column(recording, "area_um"), UserError);
  EXPECT_THROW(column(recording, "volume"), UserError);
}

TEST(UntrustedRecording, EnumerationsKeepTheirSign) {
  const ScratchFolder folder;
  const std::array<std::int8_t, 3> stored{-1, 0, 1};
  {
    RecordingWriter writer(folder / "a.rtdc");
    const Hdf5Handle type(::H5Tenum_create(H5T_STD_I8LE));
    const char* const names[] = {"MINUS", "ZERO", "PLUS"};
    for (std::size_t i = 0; i < stored.size(); ++i) ::H5Tenum_insert(type.get(), names[i], &stored[i]);
    writer.scalar("deform", {0.1, 0.2, 0.3});
    const hsize_t extent = stored.size();
    const Hdf5Handle space(::H5Screate_simple(1, &extent, nullptr)), one(::H5Screate(H5S_SCALAR));
    const Hdf5Handle data(
        ::H5Dcreate2(writer.root(), "events/userdef1", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    ASSERT_GE(::H5Dwrite(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data()), 0);
    const Hdf5Handle attribute(
        ::H5Acreate2(writer.root(), "user:direction", type.get(), one.get(), H5P_DEFAULT, H5P_DEFAULT));
    ASSERT_GE(::H5Awrite(attribute.get(), type.get(), stored.data()), 0);
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_EQ(column(recording, "userdef1"), (std::vector<double>{-1, 0, 1}));
  EXPECT_EQ(recording.metadata().number("user:direction"), -1);
}

// Looked for one by one from the first on, these pieces would take a minute.
TEST(UntrustedRecording, AHundredThousandPiecesAreReadAndTold) {
  const ScratchFolder folder;
  std::vector<double> values(300'000);
  std::iota(values.begin(), values.end(), 1.0);
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", values, H5T_IEEE_F64LE, {Storage::Filter::none, true, 3});
  }
  Recording recording(folder / "a.rtdc");
  int pieces = 0;  // of about 1 MiB
  recording.on_piece([&] { ++pieces; });
  EXPECT_EQ(column(recording, "deform"), values);
  EXPECT_GE(pieces, 3) << "of 2.4 MB";
}

TEST(UntrustedRecording, MoreEventsThanItsBytesCanHoldAreRefused) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    const Storage packed{Storage::Filter::zstd, false, 1 << 17};
    for (const char* feature : {"deform", "area_um"})
      writer.scalar(feature, std::vector<double>(1 << 20, 0.1), H5T_IEEE_F64LE, packed);
  }
  ASSERT_LT(fs::file_size(folder / "a.rtdc"), 20'000U);
  EXPECT_NE(sentence_for(folder / "a.rtdc").find("claims 1048576 events, more than its"), std::string::npos);
}

TEST(UntrustedRecording, EventsThatABasinDoesNotHaveEmptyNoOthers) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "original.rtdc");
    writer.text("experiment:time", "12:34:56");
    writer.scalar("deform", {0.0, 0.1, 0.2, 0.3});
    writer.images("mask", {10, 11, 12, 13}, 1, 1);
    for (int i = 0; i < 4; ++i) writer.contour({i, i});
  }
  {
    RecordingWriter writer(folder / "subset.rtdc");
    writer.text("experiment:time", "12:34:56");
    const std::vector<std::int64_t> map{-1, 0, 1, INT64_MIN, INT64_MAX, 3, -7, 2, 1};
    const hsize_t extent = map.size();
    writer.scalar("userdef0", std::vector<double>(map.size(), 1));
    const Hdf5Handle space(::H5Screate_simple(1, &extent, nullptr));
    const Hdf5Handle data(::H5Dcreate2(writer.root(), "events/basinmap0", H5T_STD_I64LE, space.get(), H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT));
    ASSERT_GE(::H5Dwrite(data.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, map.data()), 0);
    writer.lines("basins/x", {R"({"type": "file", "format": "hdf5", "name": "raw", "paths": ["original.rtdc"],)",
                              R"("mapping": "basinmap0"})"});
  }
  const Recording recording(folder / "subset.rtdc");
  const double none = NAN;
  const std::vector<double> wanted{none, 0.0, 0.1, none, none, 0.3, none, 0.2, 0.1};
  const auto deformation = column(recording, "deform");
  std::vector<std::uint8_t> masks(wanted.size());
  recording.read_images("mask", 0, wanted.size(), masks);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const int event = static_cast<int>(std::lround(10 * wanted[i]));
    const bool there = !std::isnan(wanted[i]);
    EXPECT_EQ(there, !std::isnan(deformation[i])) << i;
    if (there) {
      EXPECT_EQ(deformation[i], wanted[i]) << i;
    }
    EXPECT_EQ(masks[i], there ? 10 + event : 0) << i;
    EXPECT_EQ(recording.read_contour(i).size(), there ? 1U : 0U) << i;
  }
}

}  // namespace
}  // namespace rheocyte::untrusted_recording_test
