// Cells that the edge of the picture cuts off are left out wherever outlines are read, and their number is named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiment/population_events.h"
#include "extract/course_events.h"
#include "extract/extraction.h"
#include "extract/moduli_recording.h"
#include "measurement/mask_from_outline.h"
#include "measurement/recording_writer.h"
#include "report/features_recording.h"

namespace rheocyte::cut_outlines_test {
namespace {

constexpr int events = 12, cut_events = 4;
constexpr ImageSize picture{100, 70};
const std::string words = "4 events are left out, because their outlines touch the edge of the picture";

/// The part of a mask that is left where the picture begins so many pixels later.
void cut_off(std::span<std::uint8_t> mask, std::size_t columns, std::size_t rows) {
  for (std::size_t y = 0; y < picture.height; ++y)
    for (std::size_t x = 0; x < picture.width; ++x)
      mask[y * picture.width + x] =
          x + columns < picture.width && y + rows < picture.height ? mask[(y + rows) * picture.width + x + columns] : 0;
}

class CutOutlines : public ::testing::Test {
 protected:
  /// Cells of 6.3 um; of the last ones a quarter lies beyond the left or the upper edge, if that is wanted.
  std::filesystem::path recording(bool with_cut, bool with_features = false) const {
    std::array<double, mode_count> modes{0.02, 0.06};
    const double radius_px = 6.3 / 0.34;
    std::vector<std::uint8_t> masks(events * picture.pixels());
    std::vector<double> x_um, area(events, 120), deformation(events, 0.012);
    for (std::size_t i = 0; i < events; ++i) {
      const auto mask = std::span(masks).subspan(i * picture.pixels(), picture.pixels());
      const double at = 40 + 0.3 * double(i);
      const auto outline = outline_of_modes(modes, std::numbers::pi * radius_px * radius_px, 400);
      EXPECT_TRUE(fill_mask(outline.rowwise() + Eigen::RowVector2d(at, 35), picture, mask));
      const auto beyond = std::size_t(1.5 * radius_px);
      if (with_cut && i >= events - cut_events) cut_off(mask, i % 2 ? 40 - beyond / 2 : 0, i % 2 ? 0 : 35 - beyond / 2);
      x_um.push_back(0.34 * at);
    }
    const auto file =
        folder_ / (std::string(with_cut ? "cut" : "whole") + (with_features ? "_features" : "") + ".rtdc");
    test::RecordingWriter writer(file);
    test::write_usual_metadata(writer);
    writer.scalar("pos_x", x_um);
    writer.scalar("pos_y", std::vector<double>(events, 12));
    if (with_features) {
      writer.scalar("area_um", area);
      writer.scalar("deform", deformation);
    }
    writer.images("mask", masks, picture.height, picture.width);
    return file;
  }
  static bool are_named(const std::vector<std::string>& warnings) {
    return std::ranges::any_of(warnings, [](const std::string& w) { return w.find(words) != std::string::npos; });
  }
  static constexpr auto quiet = [](double) {};
  test::ScratchFolder folder_;
};

TEST_F(CutOutlines, HaveNoModulusAndAStateOfTheirOwn) {
  // Also where area and deformation are stored; the other events have what they have without them, digit for digit.
  const ModulusTables tables("");
  for (const bool with_features : {false, true}) {
    const Recording whole(recording(false, with_features)), cut(recording(true, with_features));
    Extraction of_whole(whole, {}, tables), of_cut(cut, {}, tables);
    const EventBlock all = of_whole.compute(0, events), left = of_cut.compute(0, events);
    for (std::size_t i = 0; i < events; ++i) {
      const bool is_cut = i >= events - cut_events;
      EXPECT_EQ(left.state[i] == ModulusState::cut, is_cut) << i;
      EXPECT_EQ(std::isfinite(left.young_modulus_kPa[i]), !is_cut) << i << ": " << name_of(left.state[i]);
      if (is_cut) {
        EXPECT_TRUE(std::isnan(left.mode_3[i]) && std::isnan(left.elongation.modulus_kPa[i])) << i;
      } else {
        EXPECT_EQ(left.young_modulus_kPa[i], all.young_modulus_kPa[i]) << i;
      }
    }
    EXPECT_EQ(of_cut.summary().counts[std::size_t(ModulusState::cut)], std::size_t(cut_events));
    EXPECT_NE(in_one_line(of_cut.summary()).find("4 cut by the edge"), std::string::npos);
  }
}

TEST_F(CutOutlines, AreNoEventsOfPopulationsAndCourses) {
  const PopulationEvents population = read_population_events(recording(true), {}, StiffnessMeasure::asymmetry, quiet);
  EXPECT_EQ(population.events(), std::size_t(events - cut_events));
  EXPECT_TRUE(are_named(population.warnings));
  const CourseEvents course = read_course_events(recording(true), {}, quiet);
  EXPECT_EQ(course.events.size(), std::size_t(events - cut_events));
  EXPECT_TRUE(are_named(remarks(course)));
  EXPECT_FALSE(are_named(remarks(read_course_events(recording(false), {}, quiet))));
}

// Inertia, temperatures and the like are said of a recording, whichever command reads it.
TEST_F(CutOutlines, AreRemarkedOnByEveryCommandAlikeAsIsInertia) {
  MeasuringOptions measuring;
  measuring.viscosity_mPas = 1;
  measuring.flow_rate_ul_s = 0.4;
  const auto file = recording(true);
  const Recording opened(file);
  const ModulusTables tables("");
  ExtractOptions options;
  options.measuring = measuring;
  Extraction extraction(opened, options, tables);
  extraction.compute(0, events);
  const auto said = remarks(extraction.summary());
  ASSERT_GE(said.size(), 2U);
  EXPECT_TRUE(are_named(said));
  EXPECT_NE(said.back().find("12 events have Reynolds numbers above 3, up to "), std::string::npos) << said.back();
  EXPECT_EQ(said, remarks(read_population_events(file, measuring, StiffnessMeasure::asymmetry, quiet)));
  EXPECT_EQ(said, remarks(read_course_events(file, measuring, quiet)));
}

TEST_F(CutOutlines, HaveNoFeatures) {
  const auto place = folder_ / "features.rtdc";
  const FeaturesSummary summary = features_of_recording(recording(true), place, place, {}, quiet);
  EXPECT_EQ(summary.cut, std::size_t(cut_events));
  EXPECT_EQ(summary.with_outline, std::size_t(events - cut_events));
}

TEST_F(CutOutlines, HaveAStatusOfTheirOwnAmongModuliOfBulkAndCortex) {
  class Statuses : public ModuliConsumer {
   public:
    void begin(const Recording&, const std::vector<std::string>&) override {}
    void take(std::size_t, const ModuliBlock& block) override {
      for (const ModuliEstimate& e : block.estimates) all.push_back(e.status);
    }
    void end(const std::vector<std::string>&) override {}
    std::vector<ModuliStatus> all;
  } told;
  ModuliOptions options;
  options.axial_tension_Pa = 0;
  const ModuliSummary summary = moduli_of_recording(recording(true), options, ModuliTables(options), 1, told, quiet);
  ASSERT_EQ(told.all.size(), std::size_t(events));
  EXPECT_EQ(std::ranges::count(told.all, ModuliStatus::cut), cut_events);
  EXPECT_EQ(summary.counts[std::size_t(ModuliStatus::no_data)], 0U);
  EXPECT_TRUE(are_named(summary.warnings));
}

}  // namespace
}  // namespace rheocyte::cut_outlines_test
