// A result takes its place as a whole, what killed calls have left goes, and files of the user are never out of sight.
#include "store/result_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "case/user_error.h"

namespace rheocyte::result_folder_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* own_result = "{\"program\": \"rheocyte\"}";

class ResultFolderTest : public testing::Test {
 protected:
  ResultFolderTest() : place_(scratch_beside(fs::temp_directory_path() / "result-folder-test")) {
    fs::create_directory(place_);
  }
  ~ResultFolderTest() override { fs::remove_all(place_); }

  fs::path result() const { return place_ / "result"; }
  static std::string content(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void publish(const std::string& text) const {
    ResultFolder folder(result());
    folder.write("result.json", own_result);
    folder.write("contour.csv", text);
    folder.publish();
  }
  // As a killed process leaves it.
  fs::path left_over(const std::string& file, const std::string& text) const {
    const fs::path folder = scratch_beside(result());
    fs::create_directory(folder);
    std::ofstream(folder / file) << text;
    return folder;
  }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(place_)) names.insert(entry.path().filename());
    return names;
  }

  fs::path place_;
};

TEST_F(ResultFolderTest, FilesOfTheUserAreKeptWithTheirFoldersAndLinks) {
  publish("first");
  std::ofstream(result() / "notes.txt") << "precious";
  fs::create_directories(result() / "mine/deep");
  std::ofstream(result() / "mine/deep/a.txt") << "deep";
  fs::create_symlink("nowhere", result() / "mine/link");
  for (const char* text : {"second", "third"}) {
    publish(text);
    EXPECT_EQ(content(result() / "contour.csv"), text);
    EXPECT_EQ(content(result() / "notes.txt"), "precious");
    EXPECT_EQ(content(result() / "mine/deep/a.txt"), "deep");
    EXPECT_EQ(fs::read_symlink(result() / "mine/link"), "nowhere");
    EXPECT_EQ(names(), std::set<std::string>{"result"});
  }
}

TEST_F(ResultFolderTest, OutlinesOfAnEarlierCellGoWithIt) {
  {
    ResultFolder folder(result());
    folder.write("result.json", own_result);
    for (const char* name : {"contour_side.csv", "contour_diagonal.csv", "contour_across.csv", "contour_offset.csv"})
      folder.write(name, "of a cell in a duct");
    folder.publish();
  }
  EXPECT_TRUE(fs::exists(result() / "contour_offset.csv"));
  publish("of one in a tube");
  for (const auto& entry : fs::directory_iterator(result()))
    EXPECT_FALSE(entry.path().filename().string().starts_with("contour_")) << entry.path();
}

TEST_F(ResultFolderTest, LeftOversGoAndOthersFilesInThemComeBack) {
  publish("first");
  const auto half = left_over("contour.csv", "half"), old = left_over("notes.txt", "precious");
  std::ofstream(old / "result.json") << own_result;
  publish("second");
  EXPECT_EQ(content(result() / "contour.csv"), "second");
  EXPECT_EQ(content(result() / "notes.txt"), "precious");
  EXPECT_EQ(names(), std::set<std::string>{"result"});
}

TEST_F(ResultFolderTest, AFileOfTheUsersThatExistsTwiceIsNeverThrownAway) {
  publish("first");
  std::ofstream(result() / "notes.txt") << "newer";
  const auto old = left_over("notes.txt", "older");
  publish("second");
  EXPECT_EQ(content(result() / "notes.txt"), "newer");
  EXPECT_EQ(content(old / "notes.txt"), "older");
}

TEST_F(ResultFolderTest, CheckpointsOfAKilledCallStayUntilThereIsANewResult) {
  const auto killed = left_over("checkpoint-1.bin", "state");
  {
    const ResultFolder unfinished(result());
    EXPECT_TRUE(fs::exists(killed));
    const auto found = interrupted_results(result());
    ASSERT_EQ(found.size(), 1U) << "the folder in use is none";
    EXPECT_EQ(found[0].path, killed);
    EXPECT_TRUE(interrupted_results(result()).empty()) << "claimed by the one above";
  }
  publish("whole");
  EXPECT_EQ(names(), std::set<std::string>{"result"});
}

TEST_F(ResultFolderTest, ALinkThatLeadsNowhereIsRefusedBeforeTheWork) {
  fs::create_symlink(place_ / "nowhere", result());
  EXPECT_THROW(check_result_folder(result()), UserError);
  EXPECT_THROW(check_result_folder(result() / ""), UserError);
  EXPECT_EQ(names(), std::set<std::string>{"result"});
}

}  // namespace
}  // namespace rheocyte::result_folder_test
