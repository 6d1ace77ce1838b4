// Which of the given files are recordings, and where their results and the table of all of them go.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "extract_fixture.h"

namespace rheocyte::extract_places_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;
using ExtractPlaces = test::ExtractFixture;

TEST_F(ExtractPlaces, SearchesFoldersAndKeepsTheirNames) {
  fs::create_directories(folder_ / "data/day1");
  fs::create_directories(folder_ / "data/day2");
  write_recording("data/day1/M1.rtdc");
  write_recording("data/day2/M1.rtdc");
  EXPECT_EQ(extract({"-r", path("data"), "-o", path("out")}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/day1/M1_rheocyte.rtdc"));
  EXPECT_TRUE(fs::exists(folder_ / "out/day2/M1_rheocyte.rtdc"));
  // Results beside the recordings are no recordings of the next call.
  EXPECT_EQ(extract({"-r", path("data")}).exit_code, 0);
  const auto again = extract({"-r", path("data")});
  EXPECT_NE(again.out.find("2 of 2 recordings"), std::string::npos) << again.out;
  expect_refusal({path("data")}, "give -r");
}

TEST_F(ExtractPlaces, ResultsAmongTheGivenFilesAreNoRecordings) {
  write_recording("a.rtdc");
  EXPECT_EQ(extract({path("a.rtdc")}).exit_code, 0);
  const auto again = extract({path("a.rtdc"), path("a_rheocyte.rtdc"), path("a.rtdc")});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.out.find("1 of 1 recordings"), std::string::npos) << again.out;
  EXPECT_NE(again.err.find("a_rheocyte.rtdc: is a result of this program and was skipped."), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "a_rheocyte_rheocyte.rtdc"));
  expect_refusal({path("a_rheocyte.rtdc")},
                 "is a result of this program, according to its name; give the original recording");
}

TEST_F(ExtractPlaces, RecordingsOfOneNameAreToldApartByTheirFolders) {
  for (const std::string day : {"day1", "day2"}) {
    fs::create_directories(folder_ / day);
    write_recording(day + "/M1.rtdc");
  }
  write_recording("M2.rtdc");
  const auto ended =
      extract({path("day1/M1.rtdc"), path("day2/M1.rtdc"), path("M2.rtdc"), "-o", path("out"), "--quiet"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const std::string name : {"day1_M1", "day2_M1", "M2"})
    EXPECT_TRUE(fs::exists(folder_ / ("out/" + name + "_rheocyte.rtdc"))) << name;
}

TEST_F(ExtractPlaces, FoldersWithoutResultsAreNotLeftBehind) {
  fs::create_directories(folder_ / "data/day1");
  fs::create_directories(folder_ / "data/day2");
  std::ofstream(folder_ / "data/day1/bad.rtdc") << "no recording";
  write_recording("data/day2/good.rtdc");
  EXPECT_EQ(extract({"-r", path("data"), "-o", path("out")}).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out/day1"));
  EXPECT_TRUE(fs::exists(folder_ / "out/day2/good_rheocyte.rtdc"));
}

/// Whatever ends first, and however: results, sentences and summary are those of one recording after another.
TEST_F(ExtractPlaces, RecordingsThatAreReadAtOnceAreToldOfInTheirOrder) {
  std::vector<std::string> files;
  for (int i = 0; i < 9; ++i) {
    const std::string name = "M" + std::to_string(i) + ".rtdc";
    if (i == 2) std::ofstream(folder_ / name) << "no recording";
    if (i != 2 && i != 5) write_recording(name);  // there is no M5
    files.push_back(path(name));
  }
  const auto extract_with = [&](const std::string& jobs, const std::string& out) {
    std::vector<std::string> arguments = files;
    arguments.insert(arguments.end(), {"-j", jobs, "-o", path(out)});
    return extract(arguments);
  };
  const auto content = [&](const std::string& name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto one = extract_with("1", "one"), some = extract_with("4", "some");
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_EQ(some.exit_code, 2);
  const auto in = [&](std::string text, const std::string& folder) {
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.replace(at, folder.size(), "X");
    return text;
  };
  EXPECT_EQ(in(one.out, path("one")), in(some.out, path("some")));
  EXPECT_EQ(one.err, some.err);
  EXPECT_NE(some.out.find("7 of 9 recordings"), std::string::npos) << some.out;
  EXPECT_EQ(content("one/rheocyte_summary.tsv"), content("some/rheocyte_summary.tsv"));
  for (const int i : {0, 1, 3, 4, 6, 7, 8}) {
    const std::string table = "/M" + std::to_string(i) + "_rheocyte.tsv";
    EXPECT_EQ(content("one" + table), content("some" + table));
    EXPECT_FALSE(content("some" + table).empty());
  }
  expect_refusal({path("M0.rtdc"), "-j", "0"}, "jobs");
}

TEST_F(ExtractPlaces, ForARecordingThatIsNotThereNothingIsMade) {
  expect_refusal({path("nofolder/sub/M1.rtdc")}, "M1.rtdc: there is no such file.");
  EXPECT_FALSE(fs::exists(folder_ / "nofolder"));
  const auto address = test::run({{RHEOCYTE, "extract", "https://host/a/b?id=1"}, {}, -1, folder_ / ""});
  EXPECT_EQ(address.exit_code, 2);
  EXPECT_NE(address.err.find("is an address on a network; download the recording"), std::string::npos) << address.err;
  EXPECT_FALSE(fs::exists(folder_ / "https:"));
  const auto kept_one = test::run({{RHEOCYTE, "extract", "https:/host/a/b"}, {}, -1, folder_ / ""});
  EXPECT_NE(kept_one.err.find("is an address on a network"), std::string::npos) << kept_one.err;
  expect_refusal({path("M0.rtdc"), "--polygon", "all.so2"}, "is a session of DCscope; export its polygon filters");
  EXPECT_FALSE(fs::exists(folder_ / "rheocyte_summary.tsv"));
}

TEST_F(ExtractPlaces, AFileWhoseNameLooksLikeAnOptionIsToldTheWayOut) {
  write_recording("-M1.rtdc");
  const auto run_here = [&](const std::string& file) {
    return test::run({{RHEOCYTE, "extract", file, "--table", path("table.txt")}, {}, -1, folder_ / ""});
  };
  const auto refused = run_here("-M1.rtdc");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("the file -M1.rtdc is given as ./-M1.rtdc"), std::string::npos) << refused.err;
  EXPECT_EQ(run_here("./-M1.rtdc").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "-M1_rheocyte.rtdc"));
}

TEST_F(ExtractPlaces, OneTableTakesTheRecordingsOfAllCallsIntoAFolder) {
  for (const std::string name : {"a.rtdc", "b.rtdc", "a.rtdc"}) {
    write_recording(name);
    EXPECT_EQ(extract({path(name), "-o", path("out")}).exit_code, 0);
  }
  const auto summary = test::content_of(folder_ / "out/rheocyte_summary.tsv");
  EXPECT_EQ(std::ranges::count(summary, '\n'), 3) << summary;
  EXPECT_NE(summary.find("\tsample\tdate\ttime\trun_index\tchip\t"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\ttest\t2026-01-31\t12:34:56\t1\t\t"), std::string::npos) << summary;
}

TEST_F(ExtractPlaces, AForeignFileInThePlaceOfTheTableIsNamedBeforeAnythingIsComputed) {
  write_recording("a.rtdc");
  test::write_file(folder_ / "rheocyte_summary.tsv", "my own notes");
  expect_refusal({path("a.rtdc")}, "rheocyte_summary.tsv: already exists and was not written by rheocyte");
  EXPECT_EQ(test::content_of(folder_ / "rheocyte_summary.tsv"), "my own notes");
  EXPECT_FALSE(fs::exists(folder_ / "a_rheocyte.rtdc"));
}

TEST_F(ExtractPlaces, WithoutAFolderForResultsTheTableLiesWhereAllRecordingsDo) {
  fs::create_directories(folder_ / "data/day1/early");
  fs::create_directories(folder_ / "data/day2");
  write_recording("data/day1/early/M1.rtdc");
  write_recording("data/day2/M2.rtdc");
  EXPECT_EQ(extract({"-r", path("data")}).exit_code, 0);
  EXPECT_EQ(test::events_in_summary(folder_ / "data/rheocyte_summary.tsv", "day1/early/M1.rtdc"), "6");
  EXPECT_EQ(extract({path("data/day1/early/M1.rtdc")}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "data/day1/early/rheocyte_summary.tsv"));
}

TEST_F(ExtractPlaces, NamesMayBeThoseOfTheCurrentFolder) {
  write_recording("a.rtdc");
  fs::create_directories(folder_ / "data");
  write_recording("data/b.rtdc");
  const auto here = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {RHEOCYTE, "extract", "--table", "table.txt"});
    const auto ended = test::run({.arguments = arguments, .folder = folder_ / "."});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  };
  here({"a.rtdc"});
  EXPECT_TRUE(fs::exists(folder_ / "a_rheocyte.rtdc"));
  here({"-r", "."});
  EXPECT_TRUE(fs::exists(folder_ / "data/b_rheocyte.rtdc"));
  const auto summary = test::content_of(folder_ / "rheocyte_summary.tsv");
  EXPECT_EQ(std::ranges::count(summary, '\n'), 3) << summary;
  EXPECT_EQ(test::events_in_summary(folder_ / "rheocyte_summary.tsv", "data/b.rtdc"), "6") << summary;
  here({"a.rtdc", "data/b.rtdc", "-o", "out"});
  EXPECT_TRUE(fs::exists(folder_ / "out/b_rheocyte.rtdc"));
}

TEST_F(ExtractPlaces, AResultOfAnotherRecordingOfTheSameNameIsKept) {
  write_recording("a.rtdc", [](RecordingWriter& writer) { writer.text("experiment:run identifier", "first"); });
  EXPECT_EQ(extract({path("a.rtdc"), "-o", path("out")}).exit_code, 0);
  write_recording("a.rtdc", [](RecordingWriter& writer) { writer.text("experiment:run identifier", "second"); });
  expect_refusal({path("a.rtdc"), "-o", path("out")}, "belongs to another recording of this name");
}

}  // namespace
}  // namespace rheocyte::extract_places_test
