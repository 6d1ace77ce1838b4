// A file is there whole or not at all, and what others have put there stays theirs.
#include "store/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <set>

#include "case/user_error.h"
#include "store/own_file.h"

namespace rheocyte::atomic_file_test {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  AtomicFileTest() : folder_(scratch_beside(fs::temp_directory_path() / "whole-file-test")) {
    fs::create_directory(folder_);
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename());
    return names;
  }

  fs::path folder_;
};

TEST_F(AtomicFileTest, ReplacesAnOlderFileAndLeavesNothingElse) {
  for (const std::string text : {"first", "second"}) {
    EXPECT_EQ(write_atomically(folder_ / "a.txt", text), 0);
    EXPECT_EQ(content(folder_ / "a.txt"), text);
  }
  EXPECT_EQ(names(), std::set<std::string>{"a.txt"});
}

TEST_F(AtomicFileTest, WhatIsNotPublishedLeavesNoTrace) {
  write_atomically(folder_ / "a.txt", "old");
  {
    const AtomicFile file(folder_ / "a.txt");
    std::ofstream(file.scratch()) << "half of the n";
    EXPECT_EQ(names().size(), 2U);
  }
  EXPECT_EQ(names(), std::set<std::string>{"a.txt"});
  EXPECT_EQ(content(folder_ / "a.txt"), "old");
}

TEST_F(AtomicFileTest, PublishedItStandsInItsPlace) {
  AtomicFile file(folder_ / "a.txt");
  std::ofstream(file.scratch()) << "new";
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
  file.publish();
  EXPECT_EQ(content(folder_ / "a.txt"), "new");
  EXPECT_EQ(names().size(), 1U);
}

TEST_F(AtomicFileTest, HiddenNamesDifferAndTellTheirPlace) {
  const fs::path place = folder_ / "a.b.txt";
  const auto one = scratch_beside(place), other = scratch_beside(place);
  EXPECT_NE(one, other);
  EXPECT_EQ(place_of(one), place);
  for (const char* name : {"a.txt", ".a.txt", ".a.rheocyte-", ".a.rheocyte-12345678901g", ".rheocyte-123456789012"})
    EXPECT_EQ(place_of(folder_ / name), folder_ / name);
}

TEST_F(AtomicFileTest, WhatAKilledProcessHasLeftIsRemovedAndWhatIsInUseIsNot) {
  const fs::path other = scratch_beside(folder_ / "b.txt"), folder = scratch_beside(folder_ / "c");
  std::ofstream(other) << "half of the n";
  fs::create_symlink("a.txt", scratch_beside(folder_ / "d.txt"));
  fs::create_directory(folder);
  std::ofstream(folder_ / ".hidden.rheocyte-of-mine") << "notes";
  const Scratch in_use = new_scratch_file(folder_ / "e.txt");
  EXPECT_FALSE(fs::exists(other));
  const pid_t child = ::fork();
  if (child == 0) ::_exit(write_atomically(folder_ / "a.txt", "new"));  // another process looks for left-overs again
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(in_use.path));
  EXPECT_TRUE(fs::exists(folder)) << "may hold what a user wants";
  EXPECT_TRUE(fs::exists(folder_ / ".hidden.rheocyte-of-mine"));
  EXPECT_EQ(names().size(), 5U);
}

TEST_F(AtomicFileTest, WhatComesToItsPlaceMeanwhileIsKept) {
  const fs::path place = folder_ / "a.txt";
  AtomicFile file(place, [&] { check_replaceable(place, "# mine", Foreign::keep); });
  write_atomically(place, "notes of somebody");
  EXPECT_THROW(file.publish(), UserError);
  EXPECT_EQ(content(place), "notes of somebody");
}

TEST_F(AtomicFileTest, ALinkStaysALink) {
  write_atomically(folder_ / "a.txt", "# mine: old");
  fs::create_symlink(folder_ / "a.txt", folder_ / "link.txt");
  replace_own_file(folder_ / "link.txt", "# mine: new", "# mine", Foreign::keep);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(content(folder_ / "a.txt"), "# mine: new");
}

TEST_F(AtomicFileTest, FilesOfOthersAreKept) {
  write_atomically(folder_ / "a.txt", "notes of somebody");
  EXPECT_THROW(replace_own_file(folder_ / "a.txt", "# mine", "# mine", Foreign::keep), UserError);
  EXPECT_EQ(content(folder_ / "a.txt"), "notes of somebody");
  replace_own_file(folder_ / "a.txt", "# mine", "# mine", foreign(true));
  EXPECT_EQ(content(folder_ / "a.txt"), "# mine");
}

TEST_F(AtomicFileTest, AFolderThatIsMissingGivesASentence) {
  EXPECT_THROW(AtomicFile(folder_ / "missing/a.txt"), UserError);
  EXPECT_EQ(write_atomically(folder_ / "missing/a.txt", "x"), ENOENT);
}

}  // namespace
}  // namespace rheocyte::atomic_file_test
