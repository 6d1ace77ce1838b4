// What stands in the folder of the results of `rheocyte population`: files of others stay, an older result is replaced
// as a whole or not at all.
#include <gtest/gtest.h>

#include <map>

#include "population_fixture.h"

namespace rheocyte::test::population_folder_test {
namespace {

namespace fs = std::filesystem;

class PopulationFolderOf : public population_test::PopulationCommand {
 protected:
  void SetUp() override {
    PopulationCommand::SetUp();
    synth("A1.rtdc", {"recording.cells=80"});
  }
  Ended population(const fs::path& recording, const std::string& folder, const std::vector<std::string>& more = {},
                   long max_file_bytes = -1) const {
    std::vector<std::string> arguments{RHEOCYTE, "population", "--condition", "a=" + recording.string(),
                                       "-o",     folder,       "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run({.arguments = arguments, .max_file_bytes = max_file_bytes, .folder = folder_.path()});
  }
  std::map<std::string, std::string> contents(const std::string& folder) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_.path() / folder))
      found[entry.path().filename().string()] = content_of(entry.path());
    return found;
  }
  void make(const std::string& folder, const std::string& name, const std::string& content = "mine") const {
    fs::create_directories(folder_.path() / folder);
    write_file(folder_.path() / folder / name, content);
  }
};

TEST_F(PopulationFolderOf, FilesOfOthersInPlacesThatAreNotWrittenStay) {
  const std::vector<std::string> names{"population.png",   "population.svg",  "population-checks.png",
                                       "events_notes.tsv", "events_b_1.rtdc", "notes.txt"};
  for (const std::string& name : names) make("fig", name);
  ASSERT_EQ(population("A1.rtdc", "fig", {"--no-picture"}).exit_code, 0);
  for (const std::string& name : names) EXPECT_EQ(contents("fig").at(name), "mine") << name;
  EXPECT_TRUE(contents("fig").contains("population.json"));
}

TEST_F(PopulationFolderOf, FilesOfOthersInPlacesThatWouldBeWrittenAreNamedAndStay) {
  for (const std::string name : {"population.json", "population.tsv", "population.png", "population-checks.svg",
                                 "events_a_1.tsv", "events_a_1.rtdc"}) {
    make(name + ".of", name);
    expect_sentence(population("A1.rtdc", name + ".of"), name + ": already exists and was not written by rheocyte");
    EXPECT_EQ(contents(name + ".of"), (std::map<std::string, std::string>{{name, "mine"}}));
  }
}

TEST_F(PopulationFolderOf, ARecordingIsNeverReplacedByItsResult) {
  fs::copy_file(folder_.path() / "A1.rtdc", folder_.path() / "events_a_1.rtdc");
  const std::string before = content_of(folder_.path() / "events_a_1.rtdc");
  expect_sentence(population("events_a_1.rtdc", "."), "events_a_1.rtdc: is one of the given recordings");
  expect_sentence(population("A1.rtdc", "."),
                  "events_a_1.rtdc: already exists and was not written by rheocyte population");
  EXPECT_EQ(content_of(folder_.path() / "events_a_1.rtdc"), before);
  EXPECT_FALSE(fs::exists(folder_.path() / "population.json"));
}

TEST_F(PopulationFolderOf, AResultAsRecordingIsNotRemovedAsAnEarlierOne) {
  ASSERT_EQ(population("A1.rtdc", "out", {"--no-picture"}).exit_code, 0);
  const std::string before = contents("out").at("events_a_1.rtdc");
  const Ended ended = call({"population", "--condition", "b=out/events_a_1.rtdc", "-o", "out", "--no-picture"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(contents("out").at("events_a_1.rtdc"), before);
  EXPECT_FALSE(contents("out").contains("events_a_1.tsv"));
}

TEST_F(PopulationFolderOf, AFullDiskLeavesTheOlderResultAsItWas) {
  ASSERT_EQ(population("A1.rtdc", "out").exit_code, 0);
  const auto before = contents("out");
  for (const std::string name : {"population.json", "population.tsv", "events_a_1.tsv", "events_a_1.rtdc"})
    EXPECT_TRUE(before.contains(name)) << name;
  synth("B1.rtdc", {"recording.cells=90", "recording.seed=4"});
  // Files end within the companion, within the table of events, within population.json.
  for (const long most : {100L, 1000L, 3000L, 6000L}) {
    const Ended ended = population("B1.rtdc", "out", {"--no-picture"}, most);
    EXPECT_EQ(ended.exit_code, 2) << most << ' ' << ended.err;
    EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
    EXPECT_EQ(contents("out"), before) << most;
  }
}

TEST_F(PopulationFolderOf, PicturesAndEventsOfAnEarlierCallGo) {
  ASSERT_EQ(population("A1.rtdc", "out").exit_code, 0);
  for (const std::string name : {"population.png", "population.svg", "population-checks.png"})
    ASSERT_TRUE(contents("out").contains(name)) << name;
  ASSERT_EQ(call({"population", "--condition", "b=A1.rtdc", "-o", "out", "--quiet", "--no-picture"}).exit_code, 0);
  std::vector<std::string> names;
  for (const auto& [name, content] : contents("out")) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"events_b_1.rtdc", "events_b_1.tsv", "population.json", "population.tsv"}));
}

TEST_F(PopulationFolderOf, NamesOfRecordingsMayHaveCommas) {
  for (const char* const name : {"cells, 5 % serum.rtdc", "b,c,d.rtdc"})
    fs::rename(folder_.path() / "A1.rtdc", folder_.path() / name),
        synth("A1.rtdc", {"recording.cells=80", "recording.seed=9"});
  synth("A1.rtdc", {"recording.cells=80", "recording.seed=11"});
  const Ended ended = call({"population", "--condition", "a=cells, 5 % serum.rtdc,A1.rtdc,b,c,d.rtdc", "--no-picture"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto recordings = record()["recordings"];
  ASSERT_EQ(recordings.size(), 3U);
  EXPECT_TRUE(std::string(recordings[0]["recording"]).ends_with("cells, 5 % serum.rtdc"));
  EXPECT_TRUE(std::string(recordings[2]["recording"]).ends_with("b,c,d.rtdc"));
  expect_sentence(call({"population", "--condition", "a=A1.rtdc,,b,c,d.rtdc"}), "the name of a recording is empty");
  expect_sentence(call({"population", "--condition", "a=A1.rtdc,no,such.rtdc"}), "no: there is no such file");
}

}  // namespace
}  // namespace rheocyte::test::population_folder_test
