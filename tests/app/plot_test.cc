// `rheocyte plot`: pictures of recordings, whole or not at all, and a sentence for what cannot be drawn.
#include <cmath>
#include <fstream>

#include "lookup_table_file.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"
#include "robustness/run_program.h"

namespace rheocyte::plot_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;

class Plot : public testing::Test {
 protected:
  Plot() {
    test::write_lookup_table(folder_ / "table.txt");
    write_recording("a.rtdc", "channel");
  }

  void write_recording(const std::string& name, const std::string& region) const {
    RecordingWriter writer(folder_ / name);
    test::write_usual_metadata(writer);
    ::H5Adelete(writer.root(), "setup:chip region");
    writer.text("setup:chip region", region);
    std::vector<double> area, deformation;
    for (int i = 0; i < 400; ++i) {
      area.push_back(80 + 20 * std::sin(1.7 * i));
      deformation.push_back(i % 50 == 0 ? NAN : 0.04 + 0.02 * std::cos(2.3 * i));
    }
    writer.scalar("area_um", area);
    writer.scalar("deform", deformation);
  }

  test::Ended plot(std::vector<std::string> arguments,
                   const std::map<std::string, std::string>& environment = {}) const {
    arguments.insert(arguments.begin(), {RHEOCYTE, "plot"});
    auto all = environment;
    all.try_emplace("TMPDIR", path("."));
    return test::run({arguments, all});
  }

  void expect_refusal(const std::vector<std::string>& arguments, const std::string& words) const {
    test::expect_sentence(plot(arguments), words);
    expect_no_leftovers();
  }

  void expect_no_leftovers() const {
    for (const auto& entry : fs::directory_iterator(folder_ / "."))
      EXPECT_FALSE(entry.path().filename().string().starts_with("rheocyte-plot-")) << entry.path();
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  test::ScratchFolder folder_;
};

TEST_F(Plot, WritesBothPicturesBesideTheRecording) {
  const auto before = test::content_of(folder_ / "a.rtdc");
  const auto ended = plot({path("a.rtdc"), "--table", path("table.txt")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(test::content_of(folder_ / "a_rheocyte.png").starts_with("\x89PNG"));
  const auto svg = test::content_of(folder_ / "a_rheocyte.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(test::content_of(folder_ / "a.rtdc"), before) << "the input is never changed";
  expect_no_leftovers();
  ASSERT_EQ(plot({path("a.rtdc"), "--table", path("table.txt"), "-o", path("again.svg")}).exit_code, 0);
  EXPECT_EQ(test::content_of(folder_ / "again.svg"), svg) << "the same picture each time, at the name that was given";
}

TEST_F(Plot, PicturesOfOthersAreNotReplaced) {
  std::ofstream(folder_ / "a_rheocyte.svg") << "<svg>theirs</svg>";
  expect_refusal({path("a.rtdc")}, "already exists and was not written by rheocyte; give another name with -o");
  EXPECT_EQ(test::content_of(folder_ / "a_rheocyte.svg"), "<svg>theirs</svg>");
  EXPECT_FALSE(fs::exists(folder_ / "a_rheocyte.png"));
  for (int call = 0; call < 2; ++call)
    EXPECT_EQ(plot({path("a.rtdc"), "-o", path("own")}).exit_code, 0) << "its own are";
}

TEST_F(Plot, NeedsNoTable) {
  const auto ended = plot({path("a.rtdc"), "-o", path("out"), "--quiet"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out + ended.err, "");
  EXPECT_TRUE(fs::exists(folder_ / "out.png"));
}

TEST_F(Plot, WithoutATableTheLinesAreThoseOfTheProgramsOwn) {
  ASSERT_EQ(plot({path("a.rtdc"), "-o", path("own")}).exit_code, 0);
  ASSERT_EQ(plot({path("a.rtdc"), "-o", path("named"), "--table", "HE-3D-MC049-26"}).exit_code, 0);
  ASSERT_EQ(plot({path("a.rtdc"), "-o", path("none"), "--no-lines"}).exit_code, 0);
  EXPECT_EQ(test::content_of(folder_ / "own.svg"), test::content_of(folder_ / "named.svg"));
  EXPECT_NE(test::content_of(folder_ / "own.svg"), test::content_of(folder_ / "none.svg"));
  {
    RecordingWriter writer(folder_ / "bare.rtdc");
    writer.scalar("area_um", {80, 90, 100});
    writer.scalar("deform", {0.02, 0.03, 0.04});
  }
  const auto bare = plot({path("bare.rtdc")});
  EXPECT_EQ(bare.exit_code, 0) << bare.err;
  EXPECT_NE(bare.err.find("drawn without isoelasticity lines"), std::string::npos) << bare.err;
  EXPECT_EQ(bare.err.find(".rtdc:"), bare.err.rfind(".rtdc:")) << "the recording is named once: " << bare.err;
  EXPECT_NE(bare.err.find("--channel-width-um"), std::string::npos) << bare.err;
}

TEST_F(Plot, OtherFeaturesAndGates) {
  const auto turned = plot({path("a.rtdc"), "-o", path("all"), "--x", "deform", "--y", "area_um"});
  ASSERT_EQ(turned.exit_code, 0);
  EXPECT_NE(turned.err.find("no isoelasticity lines are drawn: they are those of area_um (to the right) and deform "
                            "(upwards), not of deform and area_um."),
            std::string::npos)
      << turned.err;
  const auto gated = plot({path("a.rtdc"), "-o", path("gated"), "--min", "area_um=85", "--max", "deform=0.05"});
  ASSERT_EQ(gated.exit_code, 0) << gated.err;
  EXPECT_TRUE(fs::exists(folder_ / "gated.png"));
  const std::string a = path("a.rtdc");
  expect_refusal({a, "--x", "volume"}, "has no feature volume");
  expect_refusal({a, "--x", "volume", "--levels", "1"}, "--levels and --x or --y contradict");
  expect_refusal({a, "--min", "area_um"}, "give a feature and a number");
  expect_refusal({a, "--min", "area_um=5", "--max", "area_um=4"}, "contradict each other");
  expect_refusal({a, "--max", "bright=4"}, "has no feature bright, for which --max gives a limit");
  expect_refusal({a, "--polygon", "area_um,deform=40,0.01:90,0.01"}, "three corners");
  expect_refusal({a, "--polygon", "area_um,bright=1,2:3,4:5,6"}, "has no feature bright, which --polygon names");
  expect_refusal({a, "--polygon", "area_um,deform=1,2:3,4:5,6"}, "no event inside the gates has area_um and deform");
  expect_refusal({a, "--min", "area_um=500"}, "no event inside the gates has area_um and deform");
}

TEST_F(Plot, SeveralRecordingsAndTheReservoirShareOnePicture) {
  write_recording("b.rtdc", "reservoir");
  const auto ended = plot({path("a.rtdc"), path("b.rtdc"), "--table", path("table.txt"), "-o", path("out")});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("b.rtdc: was recorded in the reservoir"), std::string::npos) << ended.err;
}

TEST_F(Plot, WhatCannotBeDrawnIsSaid) {
  const std::string a = path("a.rtdc"), table = path("table.txt");
  expect_refusal({path("none.rtdc")}, "no such file");
  expect_refusal({path(".")}, "is a folder; give recordings");
  expect_refusal({a, "--table", path("none.txt")}, "there is no such file");
  expect_refusal({a, "--lines", table}, "need a text \"lut identifier\"");
  expect_refusal({a, "--levels", "1,2", "--lines", table}, "--levels and --lines contradict");
  expect_refusal({a, "--no-lines", "--table", table}, "--no-lines and --table contradict");
  expect_refusal({a, "--table", table, "--levels", "1,-2"}, "positive moduli");
  expect_refusal({a, "--table", table, "--viscosity-mPas", "5", "--medium", "water"}, "contradict each other");
  expect_refusal({a, "-o", path(".")}, "is a folder; give a name");
  expect_refusal({a, "-o", path("nowhere/out")}, "there is no such folder");
  {
    RecordingWriter writer(folder_ / "empty.rtdc");
    writer.scalar("area_um", {NAN, 1});
    writer.scalar("deform", {0.1, NAN});
  }
  expect_refusal({path("empty.rtdc")}, "nothing to draw");
  expect_refusal({path("empty.rtdc"), "--table", table}, "--channel-width-um");
  EXPECT_FALSE(fs::exists(folder_ / "a_rheocyte.png"));
}

TEST_F(Plot, AMissingPythonPackageIsNamed) {
  const auto ended = plot({path("a.rtdc"), "-o", path("out")}, {{"RHEOCYTE_PYTHON", "/nowhere"}});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("No module named"), std::string::npos) << ended.err;
  expect_no_leftovers();
}

TEST_F(Plot, RealRecordingsAreDrawn) {
  RHEOCYTE_NEED_REFERENCE("rtdc/example.rtdc");
  const auto reference = test::reference_folder();
  const auto ended =
      plot({(reference / "rtdc/example.rtdc").string(), (reference / "rtdc/mask_with_artefact.rtdc").string(),
            (reference / "rtdc/wide_channel_issue_212.rtdc").string(), "--table",
            (reference / "lut_LE-2D-FEM-19.txt").string(), "--temperature", "23", "-o", path("out")});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(fs::exists(folder_ / "out.svg"));
}

}  // namespace
}  // namespace rheocyte::plot_test
