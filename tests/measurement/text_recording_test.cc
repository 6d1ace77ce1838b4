// A table of events as text is a recording like others, with what it lacks named.
#include "measurement/text_recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "case/user_error.h"
#include "measurement/recording.h"
#include "measurement/recording_columns.h"
#include "measurement/recording_writer.h"
#include "measurement/shape_source.h"

namespace rheocyte::text_recording_test {
namespace {

using test::column;

using test::ScratchFolder;

std::filesystem::path written(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string refusal_of(const std::filesystem::path& file) {
  try {
    const Recording recording(file);
  } catch (const UserError& error) {
    return error.what();
  }
  return "opened";
}

TEST(TextRecording, FeaturesAndMetadataAreThoseOfTheTable) {
  const ScratchFolder folder;
  const Recording recording(
      written(folder / "a.CSV",
              "# setup:flow rate = 0.04\n# experiment:event count = 9\narea_um,deform,Time\n50,0.01,1\n60,,2\n"));
  EXPECT_EQ(recording.events(), 2U);
  EXPECT_EQ(recording.scalar_names(), (std::vector<std::string>{"Time", "area_um", "deform"}));
  EXPECT_EQ(column(recording, "area_um"), (std::vector<double>{50, 60}));
  EXPECT_TRUE(std::isnan(column(recording, "deform")[1]));
  EXPECT_EQ(recording.metadata().number("setup:flow rate"), 0.04);
  EXPECT_TRUE(recording.remarks().empty()) << "a table of a part of the events counts its own";
  EXPECT_FALSE(recording.has_contours() || recording.image_size("mask") || recording.is_single_precision("deform"));
}

TEST(TextRecording, MetadataHaveTheTypesOfTheFieldsPrograms) {
  const ScratchFolder folder;
  const Recording recording(
      written(folder / "a.csv",
              "# setup:channel width = 20.0\n# imaging:roi size x = 80\n# experiment:sample = 012\n"
              "# experiment:date = 2016-01-29\n# setup:medium = nan\narea_um\n1\n"));
  const auto& values = recording.metadata().values();
  EXPECT_EQ(std::get<double>(values.at("setup:channel width")), 20);
  EXPECT_EQ(std::get<double>(values.at("imaging:roi size x")), 80);
  EXPECT_EQ(std::get<std::string>(values.at("experiment:sample")), "012");
  EXPECT_EQ(std::get<std::string>(values.at("experiment:date")), "2016-01-29");
  EXPECT_EQ(std::get<std::string>(values.at("setup:medium")), "nan");
}

TEST(TextRecording, SeveralAreOpenAtOnce) {
  const ScratchFolder folder;
  const Recording first(written(folder / "a.csv", "area_um\n1\n")), second(written(folder / "b.tsv", "area_um\n2\n"));
  EXPECT_EQ(column(first, "area_um"), std::vector<double>{1});
  EXPECT_EQ(column(second, "area_um"), std::vector<double>{2});
}

TEST(TextRecording, ATomlFileOfItsNameGivesTheSetUp) {
  const ScratchFolder folder;
  const auto file = written(folder / "a.csv", "# setup:channel width = 20.0\narea_um\n1\n");
  const auto toml = written(folder / "a.toml",
                            "[setup]\n\"channel width\" = 20.0\n\"flow rate\" = 0.04\nmedium = \"CellCarrier\"\n"
                            "[experiment]\nsample = \"\xC2\xB5\"\n");
  const Recording recording(file);
  EXPECT_EQ(recording.metadata().number("setup:flow rate"), 0.04);
  EXPECT_EQ(recording.metadata().text("setup:medium"), "CellCarrier");
  EXPECT_EQ(recording.metadata().text("experiment:sample"), "\xC2\xB5");
  EXPECT_EQ(recording.files_of_basins(), std::vector<std::filesystem::path>{toml});
  written(toml, "[setup]\n\"channel width\" = 30\n");
  EXPECT_EQ(refusal_of(file),
            toml.string() + ": setup:channel width is \"30\", but elsewhere \"20.0\"; keep one of them.");
  written(toml, "[setpu]\nmedium = \"water\"\n");
  EXPECT_EQ(refusal_of(file),
            toml.string() + ": setpu is no section of a set-up; there are [setup], [imaging], [experiment].");
  written(toml, "[setup]\nflow.rate = 0.04\n");
  EXPECT_EQ(refusal_of(file),
            toml.string() + ": [setup] flow must be a number or a text; names with blanks stand in quotes.");
}

TEST(TextRecording, FilesThatAreNoTextAreNamedForWhatTheyAre) {
  const ScratchFolder folder;
  const auto expect_refusal = [&](const std::string& name, const std::string& bytes, const std::string& words) {
    const auto file = written(folder / name, bytes);
    const std::string sentence = refusal_of(file);
    EXPECT_TRUE(sentence.starts_with(file.string() + ": ")) << sentence;
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  expect_refusal("excel.csv", "PK\x03\x04more", "is a workbook");
  expect_refusal("old.xls", "\xD0\xCF\x11\xE0\xA1\xB1", "is a workbook");
  expect_refusal("utf16.txt",
                 "\xFF\xFE"
                 "a",
                 "UTF-16");
  expect_refusal("zeros.tsv", std::string("a\0b", 3), "is not text");
  expect_refusal("a.parquet", "PAR1", "read_parquet('");
  expect_refusal("renamed.csv", "PAR1", "Parquet");
  expect_refusal("none.csv", "", "is empty");
  expect_refusal("header.csv", "area_um,deform\n", "contains no events");
  expect_refusal("cells.rtdc", "area_um,deform\n1,2\n", "is not an HDF5 file");
  EXPECT_NE(refusal_of(folder / "missing.csv").find("there is no such file"), std::string::npos);
}

TEST(TextRecording, ColumnsOfOtherNamesAreTold) {
  const ScratchFolder folder;
  const Recording recording(written(folder / "a.csv", "Area,deform,Circ. (raw)\n1,2,3\n"));
  try {
    const ShapeSource shapes(recording, 0.34);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.what(),
              (folder / "a.csv").string() +
                  ": has no column area_um; its columns are Area, deform; columns that are left out: Circ. (raw) (no "
                  "name of a feature). Name columns as dclab does: area_um is in um2, deform is 1 - circularity.");
  }
}

}  // namespace
}  // namespace rheocyte::text_recording_test
