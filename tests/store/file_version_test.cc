// A file's version changes with whatever may change its content, and with nothing else.
#include "store/file_version.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <fstream>

namespace rheocyte::file_version_test {
namespace {

namespace fs = std::filesystem;

class FileVersion : public testing::Test {
 protected:
  FileVersion() {
    std::string name = (fs::temp_directory_path() / "rheocyte-version-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~FileVersion() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  fs::path folder_;
};

TEST_F(FileVersion, StaysWhileTheFileIsOnlyRead) {
  write("a", "one");
  const std::string before = file_version(folder_ / "a");
  std::string text;
  std::ifstream(folder_ / "a") >> text;
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(file_version(folder_ / "a"), before);
}

TEST_F(FileVersion, ChangesWithAContentOfTheSameLengthAndATimeThatIsSetBack) {
  write("a", "one");
  const auto time = fs::last_write_time(folder_ / "a");
  const std::string before = file_version(folder_ / "a");
  write("a", "two");
  fs::last_write_time(folder_ / "a", time);
  EXPECT_NE(file_version(folder_ / "a"), before);
}

TEST_F(FileVersion, ChangesWithAnotherFileInItsPlace) {
  write("a", "one");
  write("b", "one");
  fs::last_write_time(folder_ / "b", fs::last_write_time(folder_ / "a"));
  const std::string before = file_version(folder_ / "a");
  fs::rename(folder_ / "b", folder_ / "a");
  EXPECT_NE(file_version(folder_ / "a"), before);
}

TEST_F(FileVersion, OfAFolderIsThatOfItsFiles) {
  write("a", "one");
  fs::create_directory(folder_ / "sub");
  const std::string before = file_version(folder_);
  write("sub/b", "two");
  EXPECT_EQ(file_version(folder_), before);
  write("b", "two");
  EXPECT_NE(file_version(folder_), before);
}

TEST_F(FileVersion, OfSeveralPlacesHoldsThatOfEachAndNothingForWhatIsNotThere) {
  write("a", "one");
  write("b", "two");
  EXPECT_EQ(file_version(folder_ / "none"), "");
  const std::array<fs::path, 3> places{folder_ / "a", folder_ / "none", folder_ / "b"};
  EXPECT_EQ(file_version(places), file_version(places[0]) + file_version(places[2]));
}

}  // namespace
}  // namespace rheocyte::file_version_test
