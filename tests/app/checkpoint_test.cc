// A checkpoint gives back every bit; a damaged or foreign one is refused by name.
#include "app/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "case/read_case.h"
#include "case/user_error.h"

namespace rheocyte::checkpoint_test {
namespace {

namespace fs = std::filesystem;

Case some_case(const std::vector<std::string>& settings = {}) {
  return read_case(fs::path(EXAMPLES) / "paper-cell-in-time.toml", settings);
}

Checkpoint some_checkpoint(double t_us = 12.5) {
  Checkpoint checkpoint;
  for (const double time : {0.3, 0.2}) {
    TimeLevel level{.time = time,
                    .unknowns = Eigen::VectorXd::LinSpaced(7, 0, 1),
                    .velocities = Eigen::VectorXd::LinSpaced(4, -1, 0.1),
                    .frame_acceleration = 0.7,
                    .position = 5.5,
                    .barycentre = 0.25,
                    .aside = -0.5,
                    .outward = Eigen::VectorXd::LinSpaced(2, 0.3, 0.4)};
    checkpoint.state.levels.push_back(level);
  }
  checkpoint.state.order = 2;
  checkpoint.state.steps_at_order = 3;
  checkpoint.state.next_step = 0.01;
  checkpoint.state.inlet_pressure = -0.125;
  checkpoint.record.rows = {{0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
                            {t_us, 0.1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  checkpoint.record.frames = {{0, 0, Eigen::MatrixX2d::Constant(5, 2, 1.0 / 3)}};
  return checkpoint;
}

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::temp_directory_path() / ("rheocyte-checkpoint-" + std::to_string(::getpid()));
    fs::create_directory(path_);
  }
  void TearDown() override { fs::remove_all(path_); }
  void write(int slot, const std::string& content) const {
    std::ofstream(path_ / checkpoint_file(slot), std::ios::binary) << content;
  }
  std::string refusal(const Case& c) const {
    try {
      read_checkpoint(path_, c);
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  }
  fs::path path_;
};

TEST_F(Folder, GivesBackEveryBit) {
  const Checkpoint written = some_checkpoint();
  write(1, encode_checkpoint(written, some_case()));
  const Checkpoint read = read_checkpoint(path_, some_case());
  ASSERT_EQ(read.state.levels.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(read.state.levels[i].time, written.state.levels[i].time);
    EXPECT_EQ(read.state.levels[i].unknowns, written.state.levels[i].unknowns);
    EXPECT_EQ(read.state.levels[i].velocities, written.state.levels[i].velocities);
    EXPECT_EQ(read.state.levels[i].frame_acceleration, 0.7);
    EXPECT_EQ(read.state.levels[i].position, 5.5);
    EXPECT_EQ(read.state.levels[i].barycentre, 0.25);
    EXPECT_EQ(read.state.levels[i].aside, -0.5);
    EXPECT_EQ(read.state.levels[i].outward, written.state.levels[i].outward);
  }
  EXPECT_EQ(read.state.next_step, 0.01);
  EXPECT_EQ(read.state.inlet_pressure, -0.125);
  EXPECT_EQ(history_csv(read.record), history_csv(written.record));
  EXPECT_EQ(contours_csv(read.record), contours_csv(written.record));
}

TEST_F(Folder, TheLaterOfBothSlotsCounts) {
  write(1, encode_checkpoint(some_checkpoint(20), some_case()));
  write(2, encode_checkpoint(some_checkpoint(10), some_case()));
  EXPECT_EQ(read_checkpoint(path_, some_case()).record.rows.back().t_us, 20);
}

TEST_F(Folder, ADamagedSlotLeavesTheOther) {
  // A flipped bit anywhere and any truncation is noticed; the other slot serves.
  const std::string good = encode_checkpoint(some_checkpoint(10), some_case());
  for (std::size_t i = 0; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = char(bad[i] ^ 4);
    write(1, bad);
    EXPECT_NE(refusal(some_case()).find("checkpoint-1.bin"), std::string::npos) << i;
    write(1, good.substr(0, i));
    EXPECT_NE(refusal(some_case()).find("checkpoint-1.bin"), std::string::npos) << i;
  }
  write(2, good);
  EXPECT_EQ(read_checkpoint(path_, some_case()).record.rows.back().t_us, 10);
}

TEST_F(Folder, AForeignOneIsRefusedByName) {
  // Another modulus is another case; another end is not, unless it lies before the checkpoint.
  write(2, encode_checkpoint(some_checkpoint(10), some_case()));
  EXPECT_NE(refusal(some_case({"cell.bulk.young_modulus_kPa=2"})).find("another case"), std::string::npos);
  EXPECT_EQ(refusal(some_case({"time.end_us=900"})), "accepted");
  EXPECT_NE(refusal(some_case({"time.end_us=9"})).find("already reached 10 us"), std::string::npos);
}

TEST_F(Folder, WithoutACheckpointIsRefused) {
  EXPECT_NE(refusal(some_case()).find("contains no checkpoint"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::checkpoint_test
