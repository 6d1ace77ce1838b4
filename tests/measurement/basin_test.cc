// Features that a recording keeps in a basin are found there, for the right events; what does not belong is left out.
#include "measurement/basin.h"

#include <cmath>
#include <map>

#include "case/user_error.h"
#include "measurement/recording.h"
#include "measurement/recording_columns.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"
#include "measurement/shape_source.h"

namespace rheocyte::basin_test {
namespace {

using test::column;
using test::RecordingWriter;
using test::ScratchFolder;

void write_setup(RecordingWriter& writer, const std::string& time = "12:34:56") {
  writer.text("experiment:time", time);
  writer.text("experiment:date", "2026-01-31");
  writer.text("setup:identifier", "RC-ZMD");
}

void write_original(const std::filesystem::path& file, const std::string& time = "12:34:56") {
  RecordingWriter writer(file);
  write_setup(writer, time);
  writer.scalar("deform", {0.0, 0.1, 0.2, 0.3, 0.4, 0.5});
  writer.scalar("area_um", {0, 10, 20, 30, 40, 50});
  writer.images("mask", {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}, 1, 2);
  for (int i = 0; i < 6; ++i) writer.contour({i, i, i, 2 * i});
}

// By Python: uuid.UUID(hex=hashlib.md5(b"12:34:56_2026-01-31_RC-ZMD").hexdigest())
constexpr const char* identifier_of_setup = "ceb6fc8f-fe03-c501-f3b1-5285289dd7da";

TEST(Basin, ItsDefinitionSurvivesWritingAndReading) {
  std::string json;
  for (const auto& line : file_basin_lines("raw \"data\"", {"/a/b.rtdc", "b.rtdc"})) {
    EXPECT_EQ(line.find('\n'), std::string::npos);
    json += line + "\n";
  }
  const auto basin = read_basin_definition(json);
  ASSERT_TRUE(basin);
  EXPECT_EQ(basin->kind, BasinDefinition::Kind::file);
  EXPECT_EQ(basin->name, "raw \"data\"");
  EXPECT_EQ(basin->paths, (std::vector<std::string>{"/a/b.rtdc", "b.rtdc"}));
  EXPECT_FALSE(basin->features);
  EXPECT_TRUE(basin->mapping.empty());
}

TEST(Basin, BrokenAndRemoteDefinitionsAreNone) {
  EXPECT_FALSE(read_basin_definition("{"));
  EXPECT_FALSE(read_basin_definition("[1, 2]"));
  EXPECT_FALSE(read_basin_definition(R"({"type": "remote", "format": "http", "urls": ["x"]})"));
  EXPECT_FALSE(read_basin_definition(R"({"type": 3, "format": "hdf5"})"));
}

TEST(Basin, FoldersOfAPathMayBeSeparatedByBackslashes) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "raw");
  write_original(folder / "raw/original.rtdc");
  BasinDefinition basin;
  basin.paths = {"raw\\original.rtdc"};
  EXPECT_EQ(basin_files(basin, folder / "child.rtdc"),
            std::vector<std::filesystem::path>{folder / "raw/original.rtdc"});
}

TEST(Basin, FeaturesOfAnotherFileAreFoundBesideTheReferringOne) {
  const ScratchFolder folder;
  write_original(folder / "original.rtdc");
  {
    RecordingWriter writer(folder / "companion.rtdc");
    write_setup(writer);
    writer.scalar("emodulus", {1, 2, 3, 4, 5, 6});
    writer.scalar("area_um", {7, 7, 7, 7, 7, 7});
    writer.lines("basins/x", file_basin_lines("raw", {"/nowhere/original.rtdc", "original.rtdc"}));
  }
  const Recording recording(folder / "companion.rtdc");
  EXPECT_EQ(recording.events(), 6U);
  EXPECT_EQ(column(recording, "deform"), (std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(column(recording, "area_um"), std::vector<double>(6, 7)) << "the file's own comes first";
  EXPECT_EQ(recording.image_size("mask"), (ImageSize{2, 1}));
  EXPECT_EQ(recording.read_contour(3), (PixelContour{{3, 3}, {3, 6}}));
  EXPECT_FALSE(recording.has_scalar("volume"));
}

// In Latin-1, half of a character of UTF-8, from the end of the private use, and what looks like an escape.
TEST(Basin, NamesOfAnyBytesAreFoundAgain) {
  for (const std::string name :
       {"Z\xFCrich.rtdc", "\xC3.rtdc", "\xF4\x8F\xBE\xA9.rtdc", "\\udcfc.rtdc", "\xC3\xBC \xF0\x9F\x94\xAC.rtdc"}) {
    const ScratchFolder folder;
    write_original(folder / name);
    std::string json;
    for (const auto& line : file_basin_lines("raw", {name})) json += line + "\n";
    EXPECT_EQ(read_basin_definition(json).value().paths, std::vector<std::string>{name});
    {
      RecordingWriter writer(folder / "companion.rtdc");
      write_setup(writer);
      writer.lines("basins/x", file_basin_lines("raw", {name}));
    }
    EXPECT_TRUE(Recording(folder / "companion.rtdc").has_scalar("deform")) << name;
  }
  EXPECT_NE(file_basin_lines("raw", {"Z\xFCrich"})[8].find("Z\\udcfcrich"), std::string::npos)
      << "as Python writes the names of files (PEP 383)";
}

TEST(Basin, AMeasurementIsNamedByItsRunElseByTheDigestOfItsSetup) {
  std::map<std::string, Metadata::Value> values{
      {"experiment:time", "12:34:56"}, {"experiment:date", "2026-01-31"}, {"setup:identifier", "RC-ZMD"}};
  EXPECT_EQ(measurement_identifier(Metadata(values)), identifier_of_setup);
  values["experiment:run identifier"] = "";
  EXPECT_EQ(measurement_identifier(Metadata(values)), identifier_of_setup);
  values["experiment:run identifier"] = "mine";
  EXPECT_EQ(measurement_identifier(Metadata(values)), "mine");
  values = {{"experiment:time", "12:34:56"}};
  EXPECT_FALSE(measurement_identifier(Metadata(values))) << "incomplete";
}

TEST(Basin, AFilteredExportBelongsToItsOriginal) {
  // The field's programs append to the identifier of the original, also where that has none of its own.
  const ScratchFolder folder;
  write_original(folder / "original.rtdc");
  const auto events_of_export = [&](const std::string& identifier, const std::string& mapping) {
    {
      RecordingWriter writer(folder / "export.rtdc");
      write_setup(writer);
      writer.text("experiment:run identifier", identifier);
      writer.scalar("basinmap0", {5, 1}, H5T_STD_I64LE);
      writer.lines("basins/x", {R"({"type": "file", "format": "hdf5", "name": "raw", "paths": ["original.rtdc"],)",
                                R"("mapping": ")" + mapping + "\"}"});
    }
    const Recording recording(folder / "export.rtdc");
    return recording.has_scalar("deform") ? column(recording, "deform") : std::vector<double>();
  };
  const std::string identifier = identifier_of_setup;
  EXPECT_EQ(events_of_export(identifier + "_dclab-1a2b3c4", "basinmap0"), (std::vector<double>{0.5, 0.1}));
  EXPECT_TRUE(events_of_export("another_dclab-1a2b3c4", "basinmap0").empty());
  EXPECT_TRUE(events_of_export(identifier + "_dclab-1a2b3c4", "same").empty()) << "without a map, all of it must agree";
}

TEST(Basin, FilesWithoutAnIdentifierAreTakenAsTheyAre) {
  const ScratchFolder folder;
  write_original(folder / "original.rtdc");
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.text("experiment:time", "00:00:00");
    writer.scalar("userdef0", {1, 2, 3, 4, 5, 6});
    writer.lines("basins/x", file_basin_lines("raw", {"original.rtdc"}));
  }
  EXPECT_TRUE(Recording(folder / "a.rtdc").has_scalar("deform"));
}

TEST(Basin, TheNextPathIsTriedAfterAFileOfAnotherMeasurementAndTheFoldersOfOtherSystemsAreForgotten) {
  const ScratchFolder folder;
  write_original(folder / "other.rtdc", "00:00:00");
  write_original(folder / "original.rtdc");
  for (const std::string path : {"D:\\data\\day 1\\original.rtdc", "/moved/away/original.rtdc"}) {
    {
      RecordingWriter writer(folder / "a.rtdc");
      write_setup(writer);
      writer.scalar("userdef0", {1, 2, 3, 4, 5, 6});
      writer.lines("basins/x", file_basin_lines("raw", {"other.rtdc", path}));
    }
    const Recording recording(folder / "a.rtdc");
    EXPECT_TRUE(recording.has_scalar("deform")) << path;
    EXPECT_TRUE(recording.remarks().empty());
  }
}

TEST(Basin, TwoWaysToOneFileAreNoLoop) {
  const ScratchFolder folder;
  write_original(folder / "original.rtdc");
  for (const std::string name : {"b.rtdc", "a.rtdc"}) {  // a refers to b, too, as an export of an export does
    RecordingWriter writer(folder / name);
    write_setup(writer);
    writer.scalar("userdef0", {1, 2, 3, 4, 5, 6});
    if (name == "a.rtdc") writer.lines("basins/0", file_basin_lines("export", {"b.rtdc"}));
    writer.lines("basins/1", file_basin_lines("raw", {"original.rtdc"}));
  }
  const Recording recording(folder / "a.rtdc");
  EXPECT_TRUE(recording.remarks().empty());
  EXPECT_TRUE(recording.has_scalar("deform"));
}

TEST(Basin, AMapPicksTheEvents) {
  const ScratchFolder folder;
  write_original(folder / "original.rtdc");
  {
    RecordingWriter writer(folder / "subset.rtdc");
    write_setup(writer);
    writer.scalar("basinmap0", {5, 1, 2, 99}, H5T_STD_U64LE);
    writer.lines("basins/x", {R"({"type": "file", "format": "hdf5", "name": "raw", "paths": ["original.rtdc"],)",
                              R"("features": ["deform", "mask", "contour"], "mapping": "basinmap0"})"});
  }
  const Recording recording(folder / "subset.rtdc");
  EXPECT_EQ(recording.events(), 4U);
  const auto deformation = column(recording, "deform");
  EXPECT_EQ(std::vector<double>(deformation.begin(), deformation.begin() + 3), (std::vector<double>{0.5, 0.1, 0.2}));
  EXPECT_TRUE(std::isnan(deformation[3])) << "the basin has no such event";
  EXPECT_FALSE(recording.has_scalar("area_um")) << "not in the list of features";
  std::vector<std::uint8_t> pixels(2 * 4);
  recording.read_images("mask", 0, 4, pixels);
  EXPECT_EQ(pixels, (std::vector<std::uint8_t>{5, 5, 1, 1, 2, 2, 0, 0}));
  EXPECT_EQ(recording.read_contour(0), (PixelContour{{5, 5}, {5, 10}}));
  EXPECT_TRUE(recording.read_contour(3).empty());
}

TEST(Basin, InternalOnesLieInTheSameFile) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2, 0.3});
    writer.scalar("basinmap0", {0, 0, 1}, H5T_STD_I64LE);
    writer.scalar("temp", {22, 24}, H5T_IEEE_F32LE, {}, "basin_events");
    writer.lines("basins/x", {R"({"type": "internal", "format": "h5dataset", "name": "slow", "paths":)",
                              R"(["basin_events"], "features": ["temp"], "mapping": "basinmap0"})"});
  }
  EXPECT_EQ(column(Recording(folder / "a.rtdc"), "temp"), (std::vector<double>{22, 22, 24}));
}

TEST(Basin, ARemoteOneIsNamedAndNotRead) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    write_setup(writer);
    writer.scalar("userdef0", {1, 2, 3, 4, 5, 6});
    writer.lines("basins/0",
                 {R"({"type": "remote", "format": "http", "name": "store",)", R"("urls": ["https://x.org/a"]})"});
  }
  const Recording recording(folder / "a.rtdc");
  ASSERT_EQ(recording.remarks().size(), 1U);
  EXPECT_EQ(recording.remarks()[0],
            "the basin \"store (http)\" is not used: it is on a network, which is not read; download the file and "
            "refer to it, or put its features into the recording.");
  EXPECT_THROW(ShapeSource(recording, 0.34), UserError);
}

TEST(Basin, AKindOfTheFutureIsNotKnownAndNotBroken) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2});
    writer.lines("basins/0", {R"({"type": "internal", "format": "h5future", "name": "tiles", "paths": ["x"]})"});
    writer.lines("basins/1", {R"({"type": "file", "name": "no format", "paths": ["x"]})"});
  }
  EXPECT_EQ(
      Recording(folder / "a.rtdc").remarks(),
      (std::vector<std::string>{"the basin \"tiles (h5future)\" is not used: basins of this kind are not supported; "
                                "export the recording with all its features by the program that wrote it.",
                                "a basin is not used: its definition is broken."}));
}

// A background that many events share is stored once.
TEST(Basin, InternalOnesHoldPicturesToo) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", {0.1, 0.2, 0.3});
    writer.scalar("basinmap0", {0, 0, 1}, H5T_STD_I64LE);
    writer.images("image_bg", {1, 2, 3, 4}, 1, 2, {}, "basin_events");
    writer.lines("basins/x", {R"({"type": "internal", "format": "h5dataset", "name": "background", "paths":)",
                              R"(["basin_events"], "features": ["image_bg"], "mapping": "basinmap0"})"});
  }
  const Recording recording(folder / "a.rtdc");
  std::vector<std::uint8_t> pixels(6);
  recording.read_images("image_bg", 0, 3, pixels);
  EXPECT_EQ(pixels, (std::vector<std::uint8_t>{1, 2, 1, 2, 3, 4}));
  EXPECT_FALSE(recording.has_scalar("image_bg"));
}

TEST(Basin, AnotherMeasurementAMissingFileOrALoopIsARemark) {
  const ScratchFolder folder;
  write_original(folder / "other.rtdc", "00:00:00");
  {
    RecordingWriter writer(folder / "a.rtdc");
    write_setup(writer);
    writer.scalar("userdef0", {1, 2, 3, 4, 5, 6});
    writer.lines("basins/0", file_basin_lines("other", {"other.rtdc"}));
    writer.lines("basins/1", file_basin_lines("missing", {"missing.rtdc"}));
    writer.lines("basins/2", file_basin_lines("itself", {"a.rtdc"}));
  }
  const Recording recording(folder / "a.rtdc");
  ASSERT_EQ(recording.remarks().size(), 3U);
  EXPECT_NE(recording.remarks()[0].find("another measurement"), std::string::npos);
  EXPECT_NE(recording.remarks()[1].find("not found"), std::string::npos);
  EXPECT_NE(recording.remarks()[2].find("leads back"), std::string::npos);
  EXPECT_FALSE(recording.has_scalar("deform"));
}

}  // namespace
}  // namespace rheocyte::basin_test
