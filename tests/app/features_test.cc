// `rheocyte features` writes all features of the shape beside the recording, and says what is missing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "extract_fixture.h"

namespace rheocyte::features_test {
namespace {

class Features : public testing::Test {
 protected:
  test::Ended features(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {RHEOCYTE, "features"});
    return test::run({arguments});
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  double value(const std::string& file, const std::string& feature, std::size_t event) const {
    return test::column(Recording(folder_ / file), feature)[event];
  }

  /// A rectangle of 12 by 6 pixels, and an empty mask; stored is another area.
  void write_rectangle(const std::string& name, const std::function<void(test::RecordingWriter&)>& more = {}) const {
    constexpr hsize_t height = 20, width = 30;
    std::vector<std::uint8_t> masks(2 * height * width, 0);
    for (hsize_t y = 5; y < 11; ++y)
      for (hsize_t x = 7; x < 19; ++x) masks[y * width + x] = 255;
    test::RecordingWriter writer(folder_ / name);
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 80});
    writer.scalar("deform", {0.03, 0.03});
    writer.images("mask", masks, height, width);
    if (more) more(writer);
  }

  test::ScratchFolder folder_;
};

TEST_F(Features, ARectangleHasThoseOfARectangle) {
  // Outlines run through the centres of pixels: 11 by 5; its size counts whole pixels.
  write_rectangle("a.rtdc");
  const auto ended = features({path("a.rtdc")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("1 of 2 events"), std::string::npos) << ended.out;
  const std::string made = "a_features_rheocyte.rtdc";
  const double px = 0.34;
  for (const auto& [feature, wanted] :
       std::vector<std::pair<const char*, double>>{{"area_cvx", 55},
                                                   {"area_msd", 55},
                                                   {"area_ratio", 1},
                                                   {"area_um_raw", 55 * px * px},
                                                   {"aspect", 2},
                                                   {"deform", 1 - 2 * std::sqrt(std::numbers::pi * 55) / 32},
                                                   {"eccentr_prnc", std::sqrt(1 - 25.0 / 121)},
                                                   {"inert_ratio_cvx", 2.2},
                                                   {"inert_ratio_prnc", 2.2},
                                                   {"per_ratio", 1},
                                                   {"per_um_raw", 32 * px},
                                                   {"pos_x", 12.5 * px},
                                                   {"pos_y", 7.5 * px},
                                                   {"size_x", 12 * px},
                                                   {"tilt", 0},
                                                   {"volume", std::numbers::pi * 2.5 * 2.5 * 11 * px * px * px}})
    EXPECT_NEAR(value(made, feature, 0), wanted, 1e-6 * std::max(1.0, wanted)) << feature;
  EXPECT_NEAR(value(made, "area_um", 0), 55 * px * px, 1e-5);  // the mask's, not the stored one
  EXPECT_TRUE(std::isnan(value(made, "area_um", 1)));
  EXPECT_EQ(features({path("a.rtdc")}).exit_code, 0);  // its own result may be replaced
}

TEST_F(Features, HowAnOutlineLiesToTheFlowIsToldWhereItIsWhole) {
  // A sheared rectangle: its flanks rise by one pixel in three; the second touches the border, which is reported, and
  // has no features.
  constexpr hsize_t height = 40, width = 60;
  std::vector<std::uint8_t> masks(2 * height * width, 0);
  for (hsize_t x = 0; x < 36; ++x)
    for (hsize_t y = 0; y < 12; ++y) {
      masks[(10 + y + x / 3) * width + 12 + x] = 255;
      masks[height * width + (10 + y + x / 3) * width + x] = 255;
    }
  {
    test::RecordingWriter writer(folder_ / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("userdef0", {1, 2});
    writer.images("mask", masks, height, width);
  }
  const auto ended = features({path("a.rtdc")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("25 features of 1 of 2 events"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("1 event is left out, because its outline touches the edge of the picture"),
            std::string::npos);
  const Recording made(folder_ / "a_features_rheocyte.rtdc");
  const auto column = [&](const std::string& role) {
    return test::column(made, made.metadata().text("user:rheocyte " + role).value_or("missing"));
  };
  EXPECT_EQ(made.metadata().text("user:rheocyte sine_mode_2"), "userdef1") << "userdef0 is the recording's own";
  EXPECT_NEAR(column("flank_slope")[0], 1.0 / 3, 0.02);  // of pixels
  EXPECT_GT(column("sine_mode_2")[0], 0.05);
  for (const auto* role : {"sine_mode_2", "sine_mode_3", "sine_mode_4", "flank_slope"})
    EXPECT_TRUE(std::isnan(column(role)[1])) << role;
  EXPECT_TRUE(std::isnan(test::column(made, "area_um")[1]));
}

TEST_F(Features, WhatIsMissingIsSaid) {
  {
    test::RecordingWriter writer(folder_ / "scalars.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80});
    writer.scalar("deform", {0.03});
  }
  const auto scalars = features({path("scalars.rtdc")});
  EXPECT_EQ(scalars.exit_code, 2);
  EXPECT_NE(scalars.err.find("neither contours nor masks"), std::string::npos) << scalars.err;
  write_rectangle("pixels.rtdc", [](auto& writer) { ::H5Adelete(writer.root(), "imaging:pixel size"); });
  const auto pixels = features({path("pixels.rtdc")});
  EXPECT_EQ(pixels.exit_code, 2);
  EXPECT_NE(pixels.err.find("--pixel-size-um"), std::string::npos) << pixels.err;
  EXPECT_EQ(features({path("pixels.rtdc"), "--pixel-size-um", "0.34"}).exit_code, 0);
}

TEST_F(Features, FilesOfOthersAreNotReplaced) {
  write_rectangle("a.rtdc");
  write_rectangle("a_features_rheocyte.rtdc");  // by another program
  const auto ended = features({path("a.rtdc")});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("was not written by rheocyte"), std::string::npos) << ended.err;
  EXPECT_EQ(value("a_features_rheocyte.rtdc", "area_um", 0), 80);
}

}  // namespace
}  // namespace rheocyte::features_test
