// A watch of the analysis of populations gets how far it is, and ends it at once.
#include "experiment/analyse_populations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "measurement/recording_writer.h"
#include "numeric/cell_random.h"

namespace rheocyte::analyse_populations_test {
namespace {

class AnalysePopulations : public testing::Test {
 protected:
  AnalysePopulations() {
    options_.by = "deformation";
    options_.jobs = 1;
    for (const std::size_t seed : {1, 2}) conditions_.front().recordings.push_back(written(seed));
  }

  /// Areas and deformations of cells as the flow alone makes them.
  std::filesystem::path written(std::size_t seed) const {
    const std::filesystem::path file = folder_ / (std::to_string(seed) + ".rtdc");
    test::RecordingWriter writer(file);
    test::write_usual_metadata(writer);
    std::vector<double> area, deformation;
    for (std::uint64_t k = 0; k < 60; ++k) {
      CellRandom random(seed, k, Purpose::population);
      area.push_back(120 + 10 * random.normal());
      deformation.push_back(0.02 + 0.003 * random.normal());
    }
    writer.scalar("area_um", area);
    writer.scalar("deform", deformation);
    return file;
  }

  test::ScratchFolder folder_;
  PopulationOptions options_;
  std::vector<PopulationCondition> conditions_{{"a", {}}};
};

TEST_F(AnalysePopulations, TellsTheFractionOfAllRecordingsThatIsDone) {
  std::vector<double> told;
  const auto report = analyse(conditions_, options_, {.progress = [&](double fraction) { told.push_back(fraction); }});
  EXPECT_EQ(report.recordings.size(), 2U);
  EXPECT_EQ(report.conditions.front().recordings, 2U);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1);
  EXPECT_NE(std::ranges::find(told, 0.5), told.end()) << "one of two";
}

TEST_F(AnalysePopulations, StopsWhereItIsAsked) {
  double done = 0;
  const Watch watch{[&](double fraction) { done = fraction; }, [&] { return done >= 0.5; }};
  EXPECT_THROW(analyse(conditions_, options_, watch), StoppedBySignal);
  EXPECT_LT(done, 1);
}

TEST_F(AnalysePopulations, EndsWithWhatItsWatchThrows) {
  const Watch watch{.progress = [](double) { throw std::domain_error("of the watch"); }};
  EXPECT_THROW(analyse(conditions_, options_, watch), std::domain_error);
}

}  // namespace
}  // namespace rheocyte::analyse_populations_test
