// Populations of cells with a cortex: what is reported if some or most of them are softer than those of the table.
#include "experiment/combined_populations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "infer/combined_moments.h"

namespace rheocyte::combined_populations_test {
namespace {

constexpr double pixel_um = 0.34, tension_ratio = 0.3;

/// Of one law but for the median of their stiffness, as the table and its straight continuation have them.
class CellsOfStiffnessInMemory : public ::testing::Test {
 protected:
  RecordingReport fitted(double stiffness_kPa) {
    CombinedLaw law;
    law.mean << std::log(6.5), std::log(stiffness_kPa), 0.44;
    law.tension_ratio = tension_ratio, law.ratio_spread = 0.06;
    law.axial_tension = 0.3, law.axial_spread = 0.02;
    law.root << 0.07, 0, 0, -0.02, 0.14, 0, -0.02, -0.02, 0.06;
    const PopulationEvents events = events_of(law.parameters());
    RecordingReport report;
    report.recording = "cells.rtdc";
    static_cast<RecordingFacts&>(report) = events;
    report.median_viscosity_mPas = events.flow().viscosity_mPas;
    report.table = "HC-2D-NH-26";
    CombinedPopulations(options_).fit(events, report, {});
    return report;
  }

 private:
  PopulationEvents events_of(const CombinedVector& law) const {
    const BulkCortexFit moduli(table_.between, table_.simulated, {features_of_contour(7), true, 0});
    PopulationEvents events;
    events.conditions.flow = {20, 0.04, 15, table_.simulated.exponent};
    events.pixel_size_um = pixel_um;
    events.has_outlines = true;
    events.greatest_area_um2 = HUGE_VAL;
    CombinedMoments model(moduli, {events.flow(), Section::tube, 1}, pixel_um);
    EXPECT_TRUE(model.render(law, 2000));
    for (const ShapeVector& shape : model.drawn(law, 400)) {
      events.number.push_back(double(events.number.size() + 1));
      const auto add = [&](SeenMeasure m, double value) { events.seen[std::size_t(m)].push_back(value); };
      add(SeenMeasure::area_um2, std::exp(shape(0)));
      add(SeenMeasure::deformation, shape(int(ShapeFeature::deformation)));
      add(SeenMeasure::inertia_ratio, 1 / std::sqrt(shape(int(ShapeFeature::moment_ratio))));
      for (int k = 2; k <= 7; ++k)
        events.seen[std::size_t(int(SeenMeasure::mode_2) + k - 2)].push_back(shape(feature_of_mode(k)));
      add(SeenMeasure::viscosity_mPas, 15);
    }
    return events;
  }

  PopulationOptions options_ = [] {
    PopulationOptions options;
    options.model = "cortex";
    options.table = SHIPPED_TABLES "/combined_HC-2D-NH-26.cbor";
    options.section = Section::tube;
    return options;
  }();
  ModuliTable table_{read_combined_table(SHIPPED_TABLES "/combined_HC-2D-NH-26.cbor")};
};

TEST_F(CellsOfStiffnessInMemory, WithinTheTableAreAllFittedThere) {
  const RecordingReport report = fitted(3.5);
  EXPECT_TRUE(report.failure.empty()) << report.failure;
  EXPECT_LT(report.beyond.on(TableSide::softer) + report.beyond.on(TableSide::longer), report.seen_events() / 100);
  // Bending of 3e4 kBT at the table's flow, which it multiplies by 2.5, is 0.1 % of it.
  const double truth = std::log(
      effective_modulus<double>({0.56 * 3.5, 0.44 * 3.5 * 6.5, 0.5, tension_ratio * 0.44 * 3.5 * 6.5, 0.3, 6.5}));
  const QuantityEstimate* effective = report.estimate(PopulationQuantity::effective_modulus);
  ASSERT_NE(effective, nullptr);
  EXPECT_NEAR(effective->mean.value, truth, 3 * std::hypot(std::sqrt(effective->mean.variance), 0.003));
  EXPECT_GT(effective->spread, 0.1);
}

/// Three standard errors of the events.
TEST_F(CellsOfStiffnessInMemory, SofterThanTheTableCountOnTheirSide) {
  const RecordingReport report = fitted(2.5);
  EXPECT_TRUE(report.failure.empty()) << report.failure;
  EXPECT_GT(report.beyond.on(TableSide::softer), report.seen_events() / 50);
  EXPECT_LT(report.beyond.on(TableSide::softer), report.seen_events() / 4);
  EXPECT_EQ(report.seen_events(),
            report.fitted_events + report.beyond.on(TableSide::smaller) + report.beyond.on(TableSide::larger))
      << "the table goes straight on to softer ones";
  EXPECT_NE(report.beyond.shares(report.seen_events()).find(" % softer"), std::string::npos);
  const QuantityEstimate* stiffness = report.estimate(PopulationQuantity::stiffness);
  ASSERT_NE(stiffness, nullptr);
  EXPECT_NEAR(stiffness->mean.value, std::log(2.5), 3 * std::sqrt(stiffness->mean.variance));
}

/// The bound holds, and is not beyond the stiffness of which a tenth are softer.
TEST_F(CellsOfStiffnessInMemory, MostlySofterThanTheTableHaveABoundAndNoNumber) {
  const RecordingReport report = fitted(0.9);
  EXPECT_NE(report.failure.find(" are softer"), std::string::npos) << report.failure;
  EXPECT_NE(report.failure.find("the median of E + E2D/r0 is below"), std::string::npos) << report.failure;
  EXPECT_TRUE(report.is_beyond) << "its condition would be a selection without it";
  EXPECT_TRUE(report.quantities.empty());
  ASSERT_TRUE(report.bound);
  EXPECT_EQ(report.bound->quantity, PopulationQuantity::stiffness);
  EXPECT_GT(report.bound->log, std::log(0.9));
  EXPECT_LT(report.bound->log, std::log(2.5));
}

}  // namespace
}  // namespace rheocyte::combined_populations_test
