// `rheocyte moduli` from a recording with masks to the table of events.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "../robustness/run_program.h"
#include "../table/invented_combined.h"
#include "measurement/recording_writer.h"
#include "synth/pixel_picture.h"

namespace rheocyte::test {
namespace {

namespace fs = std::filesystem;

constexpr int events = 40;
constexpr double pixel_um = 0.34;

/// All alike, at random places between the pixels.
void write_recording(const fs::path& file, const Eigen::MatrixX2d& outline_um) {
  const ImageSize size{120, 70};
  std::vector<std::uint8_t> all, mask(size.pixels());
  std::mt19937 engine(3);
  std::uniform_real_distribution place(-0.5, 0.5);
  for (int i = 0; i < events; ++i) {
    const Eigen::RowVector2d middle(60 + place(engine), 35 + place(engine));
    ASSERT_TRUE(fill_mask((outline_um / pixel_um).rowwise() + middle, size, mask));
    all.insert(all.end(), mask.begin(), mask.end());
  }
  RecordingWriter writer(file);
  write_usual_metadata(writer);
  writer.integer("experiment:event count", events);
  writer.scalar("index", std::vector<double>(events, 1));
  writer.images("mask", all, size.height, size.width);
}

class ModuliCommand : public testing::Test {
 protected:
  void SetUp() override {
    const CombinedTable& table = whole_combined_table();
    fs::create_directory(table_folder());
    write_file(table_folder() / "spec.toml", to_toml(table.spec));
    write_file(table_folder() / combined_table_name(table.spec), combined_table_csv(table));
    write_recording(recording(), invented_outline({7, 0.5, 0.15}, 1.2));
  }
  fs::path table_folder() const { return folder_.path() / "table"; }
  fs::path recording() const { return folder_.path() / "M1.rtdc"; }
  Ended moduli(std::vector<std::string> more) const {
    std::vector<std::string> all{RHEOCYTE, "moduli", recording().string(), "--table"};
    all.insert(all.end(), more.begin(), more.end());
    return run({all});
  }

  TemporaryFolder folder_;
};

TEST_F(ModuliCommand, TheCellsOfARecordingHaveTheirModuli) {
  // 40 pictures of E = 0.6 kPa, E2D = 4.2 mN/m at twice the table's viscosity, at three tensions in the table: means
  // within 10 % of twice the moduli (single ones have about 10 and 20 %).
  const Ended ended = moduli({table_folder().string(), "--viscosity", "30", "--fit-tension"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  std::istringstream lines(content_of(folder_.path() / "M1_moduli.tsv"));
  std::string line;
  int count = 0;
  double young = 0, stiffness = 0;
  while (std::getline(lines, line)) {
    if (line.starts_with('#') || line.starts_with("event")) continue;
    std::istringstream fields(line);
    std::vector<double> numbers(12);
    for (double& number : numbers) fields >> number;
    young += numbers[3] / events;
    stiffness += numbers[9] / events;
    ++count;
  }
  EXPECT_EQ(count, events);
  EXPECT_NEAR(young / 1.2, 1, 0.1);
  EXPECT_NEAR(stiffness / 2.4, 1, 0.1);
}

TEST_F(ModuliCommand, WhatCannotBeUsedIsRefused) {
  // One sentence and exit code 2: no table, no option, no viscosity.
  for (const auto& [options, words] :
       {std::pair(std::vector<std::string>{(folder_.path() / "none").string()}, "there is no table"),
        {{table_folder().string(), "--viscosity", "-1"}, "--viscosity must be a positive number"},
        {{table_folder().string(), "--pixel-size", "0"}, "--pixel-size must be a positive number"}}) {
    const Ended ended = moduli(options);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
    EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace rheocyte::test
