// The files of a result come to their places together, or none of them does.
#include "store/result_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "case/user_error.h"
#include "store/own_file.h"

namespace rheocyte::result_files_test {
namespace {

namespace fs = std::filesystem;

class ResultFilesTest : public testing::Test {
 protected:
  ResultFilesTest() : folder_(scratch_beside(fs::temp_directory_path() / "result-files-test")) {
    fs::create_directory(folder_);
  }
  ~ResultFilesTest() override { fs::remove_all(folder_); }
  std::string content(const std::string& name) const {
    std::ifstream stream(folder_ / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(folder_), {})); }

  fs::path folder_;
};

TEST_F(ResultFilesTest, NothingIsInItsPlaceBeforeAllAre) {
  put("a", "ours: old");
  ResultFiles result;
  result.add_text(folder_ / "a", "ours: new", "ours");
  result.add_text(folder_ / "b", "ours: new", "ours");
  EXPECT_EQ(content("a"), "ours: old");
  EXPECT_FALSE(fs::exists(folder_ / "b"));
  result.publish();
  EXPECT_EQ(content("a"), "ours: new");
  EXPECT_EQ(content("b"), "ours: new");
  EXPECT_EQ(files(), 2U);
}

TEST_F(ResultFilesTest, WhatOthersPutIntoThePlaceOfTheLastOneKeepsAllOut) {
  put("a", "ours: old");
  {
    ResultFiles result;
    result.add_text(folder_ / "a", "ours: new", "ours");
    result.add_text(folder_ / "b", "ours: new", "ours");
    put("b", "theirs");
    EXPECT_THROW(result.publish(), UserError);
  }
  EXPECT_EQ(content("a"), "ours: old");
  EXPECT_EQ(content("b"), "theirs");
  EXPECT_EQ(files(), 2U);
}

TEST_F(ResultFilesTest, PicturesOfOthersAreNotOurs) {
  const std::string png = "\x89PNG\r\n\x1a\n", text("Software\0rheocyte", 17);
  put("ours.png", png + text + std::string(5000, 'x'));
  put("late.png", png + std::string(5000, 'x') + text);
  put("ours.svg", "<svg><metadata><dc:title>rheocyte</dc:title></metadata></svg>");
  put("theirs.svg", "<svg><metadata><dc:title>Matplotlib</dc:title></metadata></svg>");
  put("ours.gif", "GIF89a!\xFE\x08rheocyte");
  put("theirs.gif", "GIF89a!\xFE\x05other");
  for (const char* const name : {"ours.png", "ours.svg", "ours.gif"})
    EXPECT_TRUE(is_own_picture(folder_ / name)) << name;
  for (const char* const name : {"late.png", "theirs.svg", "theirs.gif", "none.png"})
    EXPECT_FALSE(is_own_picture(folder_ / name)) << name;
}

}  // namespace
}  // namespace rheocyte::result_files_test
