// `rheocyte extract`: moduli as the formulas say, results beside or in a folder, and a sentence for everything else.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "extract_fixture.h"
#include "measurement/reference_files.h"
#include "store/scratch.h"

namespace rheocyte::extract_test {
namespace {

namespace fs = std::filesystem;
using test::column;
using test::RecordingWriter;
using Extract = test::ExtractFixture;

TEST_F(Extract, GivesEachEventItsModulusOrItsReason) {
  write_recording("a.rtdc");
  const auto before = test::content_of(folder_ / "a.rtdc");
  const auto ended = extract({path("a.rtdc"), "--viscosity-mPas", "15", "--no-pixelation"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(test::content_of(folder_ / "a.rtdc"), before) << "the input is never changed";
  EXPECT_NE(ended.out.find("1 of 6 events"), std::string::npos) << ended.out;
  const Recording companion(folder_ / "a_rheocyte.rtdc");
  const auto moduli = column(companion, "emodulus");
  EXPECT_NEAR(moduli[0], 0.001 * 80 / 0.04, 1e-12) << "a point of the table";
  for (int i = 1; i < 6; ++i) EXPECT_TRUE(std::isnan(moduli[i]));
  EXPECT_EQ(column(companion, "userdef0"), (std::vector<double>{0, 2, 3, 4, 5, 1}))
      << "valid, too small, too large, too stiff, too soft, no data";
}

TEST_F(Extract, WritesATableOfEventsAndOneOfRecordings) {
  write_recording("a.rtdc");
  write_recording("b.rtdc");
  const auto ended = extract({path("a.rtdc"), path("b.rtdc"), "-o", path("out"), "--viscosity-mPas", "15"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  std::istringstream events(test::content_of(folder_ / "out/b_rheocyte.tsv"));
  int lines = 0;
  for (std::string line; std::getline(events, line);) lines += !line.starts_with('#');
  EXPECT_EQ(lines, 1 + 6);
  const auto summary = test::content_of(folder_ / "out/rheocyte_summary.tsv");
  EXPECT_EQ(test::events_in_summary(folder_ / "out/rheocyte_summary.tsv", path("b.rtdc")), "6") << summary;
  EXPECT_NE(summary.find("TEST"), std::string::npos);
}

TEST_F(Extract, TakesTemperatureFromEventsMetadataOrTheCommandLine) {
  write_recording("a.rtdc", [](RecordingWriter& writer) {
    writer.scalar("temp", {30, 30, 30, 30, 30, 30}, H5T_IEEE_F32LE);
  });
  const auto modulus = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{path("a.rtdc")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(extract(arguments).exit_code, 0);
    return column(Recording(folder_ / "a_rheocyte.rtdc"), "emodulus")[0];
  };
  const double by_event = modulus({}), by_metadata = modulus({"--temperature", "metadata"});
  EXPECT_GT(by_metadata, by_event) << "colder liquid is more viscous";
  EXPECT_EQ(by_event, modulus({"--temperature", "feature"}));
  EXPECT_NEAR(by_event, modulus({"--temperature", "30"}), 1e-12);
  EXPECT_NEAR(by_metadata, modulus({"--temperature", "23"}), 1e-12);
}

TEST_F(Extract, UsesMasksWhereNothingElseTellsTheShape) {
  std::vector<std::uint8_t> mask(40 * 60, 0);
  for (int y = 10; y < 30; ++y)
    for (int x = 10; x < 40; ++x) mask[y * 60 + x] = 255;
  {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.images("mask", mask, 40, 60);
  }
  ASSERT_EQ(extract({path("a.rtdc")}).exit_code, 0);
  const auto text = test::content_of(folder_ / "a_rheocyte.tsv");
  EXPECT_NE(text.find("area from mask"), std::string::npos);
  EXPECT_NE(text.find("\n1\t63.6956\t"), std::string::npos) << "29 x 19 pixels of 0.34 um\n" << text;
  fs::remove(folder_ / "a.rtdc");
  const Recording alone(folder_ / "a_rheocyte.rtdc");
  EXPECT_NEAR(column(alone, "area_um")[0] / 63.6956, 1, test::single_precision) << "also without the original";
  EXPECT_TRUE(alone.has_scalar("deform"));
}

TEST_F(Extract, RedCellsDoNotTellInWhichDirectionTheOthersMove) {
  // Ten cells towards -x, and as many three times as long as wide that point the other way, more strongly.
  const auto closed = [](const std::function<std::pair<double, double>(double)>& point) {
    std::vector<int> xy;
    for (int i = 0; i < 120; ++i) {
      const auto [x, y] = point(2 * std::numbers::pi * i / 120);
      xy.push_back(static_cast<int>(std::lround(100 + x)));
      xy.push_back(static_cast<int>(std::lround(40 + y)));
    }
    return xy;
  };
  {
    RecordingWriter writer(folder_ / "v.rtdc");
    test::write_usual_metadata(writer);
    for (int event = 0; event < 10; ++event) {
      writer.contour(closed([&](double t) {
        const double r = (13 + 0.1 * event) * (1 - 0.08 * std::cos(3 * t));
        return std::pair{r * std::cos(t), r * std::sin(t)};
      }));
      writer.contour(closed([](double t) {
        return std::pair{21 * std::cos(t), 7 * std::sin(t) * (1 - 0.4 * std::cos(t))};
      }));
    }
  }
  const auto ended = test::run({{RHEOCYTE, "extract", path("v.rtdc")}});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("E by the outlines of 10 events"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("10 events are as small and long as red cells"), std::string::npos) << ended.out;
}

TEST_F(Extract, ABadRecordingDoesNotKeepTheOthersBack) {
  write_recording("a.rtdc");
  std::ofstream(folder_ / "b.rtdc") << "no recording";
  write_recording("c.rtdc");
  const auto ended = extract({path("a.rtdc"), path("b.rtdc"), path("c.rtdc"), "-o", path("out")});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("b.rtdc: is not an HDF5 file"), std::string::npos) << ended.err;
  EXPECT_TRUE(fs::exists(folder_ / "out/c_rheocyte.rtdc"));
  EXPECT_FALSE(fs::exists(folder_ / "out/b_rheocyte.rtdc"));
  EXPECT_NE(test::content_of(folder_ / "out/rheocyte_summary.tsv").find("is not an HDF5 file"), std::string::npos);
}

TEST_F(Extract, AllEventsOutsideTheTableIsExitCode3) {
  {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {5, 6});
    writer.scalar("deform", {0.1, 0.1});
  }
  const auto ended = extract({path("a.rtdc")});
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.err.find("all events lie outside the table TEST"), std::string::npos) << ended.err;
}

TEST_F(Extract, WhatIsMissingIsNamedWithTheOptionThatGivesIt) {
  const auto without = [&](const std::string& key, const std::string& words) {
    {
      RecordingWriter writer(folder_ / "a.rtdc");
      test::write_usual_metadata(writer);
      ::H5Adelete(writer.root(), key.c_str());
      writer.scalar("area_um", {80});
      writer.scalar("deform", {0.03});
    }
    expect_refusal({path("a.rtdc")}, words);
  };
  without("setup:channel width", "--channel-width-um");
  without("setup:flow rate", "--flow-rate-ul-s");
  without("imaging:pixel size", "--pixel-size-um");
  without("setup:medium", "--viscosity-mPas");
  without("setup:temperature", "--temperature");
}

TEST_F(Extract, RecordingsOfTheReservoirAreRefused) {
  {
    RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    ::H5Adelete(writer.root(), "setup:chip region");
    writer.text("setup:chip region", "Reservoir");
    writer.scalar("area_um", {80});
    writer.scalar("deform", {0.03});
  }
  expect_refusal({path("a.rtdc")}, "was recorded in the reservoir");
}

TEST_F(Extract, ContradictingAndWrongOptionsAreRefused) {
  write_recording("a.rtdc");
  const std::string file = path("a.rtdc");
  expect_refusal({file, "--viscosity-mPas", "5", "--medium", "water"}, "--viscosity-mPas and --medium contradict");
  expect_refusal({file, "--viscosity-mPas", "5", "--temperature", "23"},
                 "--viscosity-mPas and --temperature contradict");
  expect_refusal({file, "--viscosity-mPas", "-5"},
                 "--viscosity-mPas -5 is outside its range 0.001 .. 1e7 mPa s (viscosity of the liquid)");
  expect_refusal({file, "--channel-width-um", "0"}, "--channel-width-um 0 is outside its range 1 .. 10000 um");
  expect_refusal({file, "--temperature", "warm"}, "degrees Celsius, feature or metadata");
  expect_refusal({file, "--temperature", "feature"}, "no temperature of each event");
  expect_refusal({file, "--medium", "soup"}, "the medium \"soup\" has no known viscosity");
  expect_refusal({file, "--medium", "Cellcarier"}, "did you mean CellCarrier?");
  expect_refusal({file, "--viscosity-model", "guess"}, "unknown viscosity model guess");
  expect_refusal({file, "--medium", "0.83% MC-PBS", "--viscosity-model", "herold-2017"}, "does not know 0.83%");
  expect_refusal({path("none.rtdc")}, "no such file");
  const auto no_table = test::run({{RHEOCYTE, "extract", file, "--table", path("none.txt")}});
  EXPECT_EQ(no_table.exit_code, 2);
  EXPECT_NE(no_table.err.find("there is no such file or table"), std::string::npos) << no_table.err;
  const std::map<std::string, std::string> without_dclab{
      {"PYTHONPATH", ""}, {"VIRTUAL_ENV", ""}, {"CONDA_PREFIX", ""}, {"HOME", ""}};
  const auto published = test::run({{RHEOCYTE, "extract", file, "--table", "LE-2D-FEM-19"}, without_dclab});
  if (published.exit_code != 0) {  // else the system itself has a dclab
    EXPECT_NE(published.err.find("come with dclab (pip install dclab), which was searched for in PYTHONPATH"),
              std::string::npos)
        << published.err;
  }
}

TEST_F(Extract, QuietIsQuietAboutFormerNamesToo) {
  write_recording("a.rtdc");
  EXPECT_NE(extract({path("a.rtdc"), "--viscosity", "15"}).err.find("is now called --viscosity-mPas"),
            std::string::npos);
  const auto quiet = extract({path("a.rtdc"), "--viscosity", "15", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Extract, ATemperatureOutsideTheModelIsAWarning) {
  write_recording("a.rtdc");
  const auto ended = extract({path("a.rtdc"), "--temperature", "15"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.err.find("15 degC is outside 22 to 37 degC"), std::string::npos) << ended.err;
}

TEST_F(Extract, TablesOfAnInstalledDclabAreFoundByTheirIdentifier) {
  write_recording("a.rtdc");
  const fs::path tables = folder_ / "env/lib/python3.11/site-packages/dclab/features/emodulus";
  fs::create_directories(tables);
  test::write_lookup_table(tables / "lut_TEST.txt");
  const std::map<std::string, std::string> environment{{"VIRTUAL_ENV", path("env")}};
  const auto found = test::run({{RHEOCYTE, "extract", path("a.rtdc"), "--table", "TEST"}, environment});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  // So are those of the python3 that a shell would start.
  fs::create_directories(folder_ / "env/bin");
  test::write_file(folder_ / "env/bin/python3", "#!/bin/sh\n");
  fs::permissions(folder_ / "env/bin/python3", fs::perms::owner_all);
  const auto by_path =
      test::run({{RHEOCYTE, "extract", path("a.rtdc"), "--table", "TEST"}, {{"PATH", path("env/bin")}}});
  EXPECT_EQ(by_path.exit_code, 0) << by_path.err;
  const auto misspelt = test::run({{RHEOCYTE, "extract", path("a.rtdc"), "--table", "TESD"}, environment});
  EXPECT_NE(misspelt.err.find("did you mean"), std::string::npos) << misspelt.err;
}

TEST_F(Extract, AFullDiskLeavesNoTornFiles) {
  write_recording("a.rtdc");
  const std::vector<std::string> arguments{RHEOCYTE,    "extract", path("a.rtdc"),   "-o",
                                           path("out"), "--table", path("table.txt")};
  const auto ended = test::run({arguments, {}, 8000});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
  for (const auto& entry : fs::directory_iterator(folder_ / "out"))
    EXPECT_EQ(entry.path().filename(), "rheocyte_summary.tsv");
}

TEST_F(Extract, FilesOfOthersInThePlaceOfResultsAreKept) {
  write_recording("a.rtdc");
  for (const std::string name : {"a_rheocyte.tsv", "a_rheocyte.rtdc"}) {
    test::write_file(folder_ / name, "my own notes");
    const auto ended = extract({path("a.rtdc")});
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_NE(ended.err.find(name + ": already exists and was not written by rheocyte"), std::string::npos)
        << ended.err;
    EXPECT_EQ(test::content_of(folder_ / name), "my own notes");
    fs::remove(folder_ / name);
  }
  for (int i = 0; i < 2; ++i) {  // our own are replaced
    const auto again = extract({path("a.rtdc")});
    EXPECT_EQ(again.exit_code, 0) << again.err;
  }
}

TEST_F(Extract, OfTwoCallsAtATimeTheFilesOfOneAreLeft) {
  write_recording("a.rtdc");
  const auto call = [&](const char* viscosity) {
    return "\"$0\" extract --quiet " + path("a.rtdc") + " --no-pixelation --table " + path("table.txt") +
           " --viscosity-mPas " + viscosity;
  };
  const std::string both = call("15") + " & one=$!; " + call("10") + " & other=$!; wait $one && wait $other";
  for (int round = 0; round < 10; ++round) {
    const auto ended = test::run({{"/bin/sh", "-c", both, RHEOCYTE}});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const double modulus = column(Recording(folder_ / "a_rheocyte.rtdc"), "emodulus")[0];
    const bool thin = test::content_of(folder_ / "a_rheocyte.tsv").find("# viscosity: 10 mPa s") != std::string::npos;
    EXPECT_NEAR(modulus / (0.001 * 80 / 0.04 * (thin ? 10.0 / 15 : 1)), 1, test::single_precision) << round;
  }
  for (const auto& entry : fs::directory_iterator(folder_ / ""))
    EXPECT_EQ(entry.path().string().find("/."), std::string::npos);
}

TEST_F(Extract, WhatAKilledCallHasLeftIsRemovedByTheNext) {
  write_recording("a.rtdc");
  const fs::path left = scratch_beside(folder_ / "a_rheocyte.rtdc"),
                 of_another_machine = folder_ / ".a_rheocyte.rtdc.rheocyte-0123456789ab0123456789ab";
  for (const fs::path& file : {left, of_another_machine}) test::write_file(file, "half of a file");
  EXPECT_EQ(extract({path("a.rtdc")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(of_another_machine)) << "may be in use, as locks need not hold between machines";
}

TEST_F(Extract, StopsWhenTheUserWantsAndLeavesNothingUnfinished) {
  write_recording("a.rtdc");
  std::ofstream(folder_ / "0.rtdc") << "no recording";  // its sentence is the sign that the work has begun
  std::vector<std::string> arguments{RHEOCYTE,  "extract",         "-o",          path("out"),
                                     "--table", path("table.txt"), path("0.rtdc")};
  for (int i = 0; i < 2000; ++i) {
    arguments.push_back(path("copy" + std::to_string(i) + ".rtdc"));
    fs::create_hard_link(folder_ / "a.rtdc", arguments.back());
  }
  const auto ended = test::run({.arguments = arguments, .signal = SIGINT});
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  for (const auto& entry : fs::directory_iterator(folder_ / "out"))
    EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

TEST_F(Extract, GivesTheModuliThatARealRecordingHolds) {
  RHEOCYTE_NEED_REFERENCE("rtdc/wide_channel_issue_212.rtdc");
  // Stored by dclab from the same table and viscosity model.
  const auto original = test::reference_folder() / "rtdc/wide_channel_issue_212.rtdc";
  const auto table = test::reference_folder() / "lut_LE-2D-FEM-19.txt";
  const auto ended = test::run({{RHEOCYTE, "extract", original.string(), "-o", path("out"), "--table", table.string(),
                                 "--viscosity-model", "herold-2017"}});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto ours = column(Recording(folder_ / "out/wide_channel_issue_212_rheocyte.rtdc"), "emodulus");
  const auto theirs = column(Recording(original), "emodulus");
  // dclab computed the viscosity in single precision, because the temperatures are.
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], theirs[i], 1e-6 * theirs[i]);
}

}  // namespace
}  // namespace rheocyte::extract_test
