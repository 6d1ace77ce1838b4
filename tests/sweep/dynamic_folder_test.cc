// The folder in which a dynamic table is computed: what is done is known, what is not done is done once.
#include "sweep/dynamic_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "../refusal.h"
#include "../table/invented_dynamic.h"
#include "sweep/follow_course.h"

namespace rheocyte::dynamic_folder_test {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;

class DynamicFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "rheocyte-dynamic-XXXXXX").string();
    folder_ = fs::path(::mkdtemp(name.data()));
    fs::remove(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

/// 2 x 2 x 2 cells at few places: some seconds.
DynamicSpec small_spec() {
  return parse_dynamic_spec(
      test::dynamic_spec_text, "spec.toml",
      std::vector<std::string>{"dynamic.radii=2", "dynamic.moduli=2", "dynamic.times=2", "dynamic.places=4",
                               "dynamic.last_um=60", "dynamic.checks=0", "dynamic.min_young_modulus_kPa=6",
                               "dynamic.min_time_ms=0.5", "time.degree=2", "time.accuracy=1e-3"});
}

TEST_F(DynamicFolderTest, AnInterruptedComputationGoesOnAndEndsWithAllCells) {
  std::atomic<bool> stop = true;
  EXPECT_FALSE(work_on(DynamicFolder(folder_, small_spec()), 1, {}, stop));
  stop = false;
  {
    const DynamicFolder folder(folder_, small_spec());
    EXPECT_LT(folder.done(), folder.pieces());
    EXPECT_TRUE(work_on(folder, 2, {}, stop));
    auto courses = folder.courses();
    EXPECT_TRUE(failed(courses).empty());
    const DynamicTable table = folder.finish(std::move(courses));
    // Every cell of a soft and a stiff kind grows more asymmetric on its way, the soft one more.
    EXPECT_GT(table.value(CourseMeasure::mode_3, {8, 6, 0.5}, 60), table.value(CourseMeasure::mode_3, {8, 6, 0.5}, 10));
    EXPECT_GT(table.value(CourseMeasure::mode_3, {8, 6, 0.5}, 60),
              table.value(CourseMeasure::mode_3, {8, 20, 0.5}, 60));
  }
  EXPECT_EQ(DynamicFolder(folder_, small_spec()).done(), 8);
  EXPECT_EQ(read_dynamic_table(folder_).spec().identifier, "invented");
}

TEST_F(DynamicFolderTest, SeveralProcessesShareOneAndDoEachCellOnce) {
  // Two folders of one process have locks of their own, as those of two processes have.
  const DynamicFolder one(folder_, small_spec()), other(folder_, small_spec());
  Claim claim = one.claim(3);
  EXPECT_FALSE(other.claim(3));
  EXPECT_TRUE(other.claim(4));
  const std::atomic<bool> stop = false;
  claim = Claim();
  bool is_complete = false;
  std::thread beside([&] { is_complete = work_on(other, 1, {}, stop); });
  EXPECT_TRUE(work_on(one, 1, {}, stop));
  beside.join();
  EXPECT_TRUE(is_complete);
  EXPECT_EQ(one.done(), 8);
  EXPECT_EQ(to_bytes(one.courses()[5], ""), to_bytes(other.courses()[5], ""));
}

TEST_F(DynamicFolderTest, AFolderOfAnEarlierVersionGoesOn) {
  // It holds the spec and records, and nothing that says which program has begun it.
  const DynamicSpec spec = small_spec();
  fs::create_directories(folder_ / "cells");
  std::ofstream(folder_ / "spec.toml") << to_toml(spec);
  std::ofstream(folder_ / "cells" / "cell-00002.cbor", std::ios::binary)
      << to_bytes(test::invented_course(spec, cells_of(spec)[2]), spec_hash(spec));
  EXPECT_EQ(DynamicFolder(folder_, spec).done(), 1);
}

TEST(Rank, UsesTheProcessorsThatItIsGiven) {
  const Rank rank{1, 2};
  EXPECT_GE(available_processors(), available_processors(rank));
  ::setenv("SLURM_CPUS_PER_TASK", "2", 1);
  EXPECT_EQ(available_processors(rank), std::min(2, available_processors()));
  ::setenv("SLURM_CPUS_PER_TASK", "no number", 1);
  EXPECT_EQ(available_processors(rank), 1);
  ::unsetenv("SLURM_CPUS_PER_TASK");
}

TEST(FollowCourse, ACellBeyondTheLimitAgainstWrinklesHasNoCourse) {
  // In time it is followed to its end; its shapes depend on the mesh, and a table must not hold them.
  const CellCourse soft = follow_course(small_spec(), {8, 2, 0.02}), stiff = follow_course(small_spec(), {8, 6, 0.02});
  EXPECT_EQ(soft.status, Status::surface_unstable) << soft.message;
  EXPECT_NE(soft.message.find("beyond the limit against short wrinkles"), std::string::npos) << soft.message;
  EXPECT_EQ(soft.value.size(), 0);
  EXPECT_EQ(stiff.status, Status::converged) << stiff.message;
}

TEST_F(DynamicFolderTest, ARecordOfAnotherCellIsRefused) {
  const DynamicSpec spec = small_spec();
  const auto cells = cells_of(spec);
  { DynamicFolder begun(folder_, spec); }
  const std::string bytes = to_bytes(test::invented_course(spec, cells[2]), spec_hash(spec));
  std::ofstream(folder_ / "cells" / "cell-00002.cbor", std::ios::binary) << bytes;
  EXPECT_EQ(DynamicFolder(folder_, spec).done(), 1);
  std::ofstream(folder_ / "cells" / "cell-00005.cbor", std::ios::binary) << bytes;
  EXPECT_NE(refusal_of([&] { DynamicFolder(folder_, spec); }).find("cell-00005.cbor: this record of a cell's way"),
            std::string::npos);
}

TEST_F(DynamicFolderTest, AFolderOfAnotherContractionOrOfSomethingElseIsRefused) {
  { DynamicFolder first(folder_, small_spec()); }
  const DynamicSpec other = parse_dynamic_spec(test::dynamic_spec_text, "spec.toml",
                                               std::vector<std::string>{"channel.profile.x_um=[60, 120]"});
  EXPECT_NE(refusal_of([&] { DynamicFolder(folder_, other); }).find("contains a table that was begun as"),
            std::string::npos);
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  std::ofstream(folder_ / "letter.txt") << "dear";
  EXPECT_NE(refusal_of([&] { DynamicFolder(folder_, other); }).find("contains other files"), std::string::npos);
  EXPECT_NE(refusal_of([&] { read_dynamic_table(folder_); }).find("there is no dynamic table here"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::dynamic_folder_test
