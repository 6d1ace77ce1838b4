#include "store/scratch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

namespace rheocyte {
namespace {

namespace fs = std::filesystem;

TEST(Scratch, FoldersStandWhileOthersRemoveWhatIsLeftOver) {
  const fs::path place = fs::path(testing::TempDir()) / "scratch-race" / "files";
  fs::create_directories(place.parent_path());
  std::atomic<bool> is_over = false;
  // A folder is no one's for the moment between its making and its claim.
  std::thread other([&] {
    while (!is_over)
      for (const Scratch& left : left_over_folders(place)) fs::remove_all(left.path);
  });
  int made = 0, standing = 0;
  for (int i = 0; i < 3000; ++i) {
    const Scratch scratch = new_scratch_folder(place);
    made += scratch.failed == 0;
    standing += fs::is_directory(scratch.path);
    remove_scratch(scratch);
  }
  is_over = true;
  other.join();
  EXPECT_EQ(made, 3000);
  EXPECT_EQ(standing, 3000);
  fs::remove_all(place.parent_path());
}

}  // namespace
}  // namespace rheocyte
