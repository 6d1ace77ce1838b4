#include "infer/several_moduli.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../table/invented_combined.h"
#include "infer/rendered_errors.h"
#include "measurement/shape_in_pixels.h"

namespace rheocyte::several_moduli_test {
namespace {

using namespace test;

/// Small errors without correlation: of a shape that is known nearly exactly.
ShapeErrors fine_errors(double deviation = 1e-5) {
  ShapeErrors errors;
  errors.covariance.diagonal().setConstant(deviation * deviation);
  return errors;
}

/// E, E2D and tension of a cell of the invented table.
struct Cell {
  BranchPlace place;
  double stiffness;
  double young() const { return (1 - place.cortex_share) * stiffness; }
  double cortex() const { return place.cortex_share * stiffness * place.radius_um; }
  double tension() const { return place.tension_ratio * cortex(); }
};

class SeveralModuliOf : public testing::Test {
 protected:
  SeveralModuliOf() : between_(whole_combined_table()), simulated_(channel_flow_of(whole_combined_table().spec.base)) {}

  SeveralModuli estimator(std::vector<int> features, bool free_tension = false, double ratio = 0.15) const {
    return {between_, simulated_, {std::move(features), free_tension, ratio}};
  }

  /// Deformations of 0.01 .. 0.04.
  Cell random_cell(double ratio) {
    const auto uniform = [&](double least, double greatest) {
      return std::uniform_real_distribution(least, greatest)(engine_);
    };
    const double radius = uniform(5.5, 7.8);
    return {{radius, uniform(0.1, 0.9), ratio}, std::pow(radius / 8, 1.5) * uniform(1.2, 2)};
  }

  CombinedInterpolation between_;
  ChannelFlow simulated_;
  std::mt19937 engine_{1};
};

TEST_F(SeveralModuliOf, AnExactShapeGivesTheModuliBack) {
  // By the two measures of the paper's figure 9 and the area, by the volume, and by the whole contour: the table's own
  // interpolation, 3e-3 in d, leaves 1.5 % of the moduli.
  for (int trial = 0; trial < 20; ++trial) {
    const Cell cell = random_cell(0.15);
    MeasuredShape shape{invented_features(cell.place, cell.stiffness), fine_errors()};
    for (const auto& features : {features_of_figure(), features_of_contour()}) {
      const auto found = estimator(features).fit(shape, simulated_);
      EXPECT_NEAR(found.value(Modulus::young) / cell.young(), 1, 0.015) << sentence(found);
      EXPECT_NEAR(found.value(Modulus::cortex) / cell.cortex(), 1, 0.015) << sentence(found);
      EXPECT_NEAR(found.value(Modulus::tension) / cell.tension(), 1, 0.015);
    }
    const double r = cell.place.radius_um;
    shape.features(0) = std::log(4 * std::numbers::pi / 3 * r * r * r);
    shape.size_is_volume = true;
    const auto found = estimator(features_of_figure()).fit(shape, simulated_);
    EXPECT_NEAR(found.value(Modulus::young) / cell.young(), 1, 0.015);
    EXPECT_EQ(found.status, ModuliStatus::resolved);
  }
}

TEST_F(SeveralModuliOf, TheWholeContourGivesTheTensionToo) {
  // Three unknowns and a size from the area and five modes; the errors are those of the table.
  for (int trial = 0; trial < 20; ++trial) {
    Cell cell = random_cell(std::uniform_real_distribution(0.05, 0.25)(engine_));
    cell.place.cortex_share = std::max(cell.place.cortex_share, 0.4);
    const MeasuredShape shape{invented_features(cell.place, cell.stiffness), fine_errors(1e-4)};
    const auto found = estimator(features_of_contour(), true).fit(shape, simulated_);
    EXPECT_EQ(found.status, ModuliStatus::resolved) << sentence(found);
    EXPECT_NEAR(found.value(Modulus::young) / cell.young(), 1, 0.03);
    EXPECT_NEAR(found.value(Modulus::cortex) / cell.cortex(), 1, 0.03);
    EXPECT_NEAR(found.value(Modulus::tension) / cell.tension(), 1, 0.05);
  }
}

TEST_F(SeveralModuliOf, AnotherChannelScalesExactly) {
  // Twice as wide, three times the flow rate, half the viscosity: lengths double; E by 1.5 / 8, E2D and tension by 1.5
  // / 4.
  const Cell cell = random_cell(0.15);
  MeasuredShape shape{invented_features(cell.place, cell.stiffness), fine_errors()};
  const auto all = estimator(features_of_figure());
  const auto narrow = all.fit(shape, simulated_);
  shape.features(0) += 2 * std::log(2.0);
  const auto wide = all.fit(shape, {2 * simulated_.width_um, 3 * simulated_.rate_ul_s, simulated_.viscosity_mPas / 2});
  EXPECT_NEAR(wide.value(Modulus::young) / narrow.value(Modulus::young), 1.5 / 8, 1e-9);
  EXPECT_NEAR(wide.error(Modulus::cortex) / narrow.error(Modulus::cortex), 1.5 / 4, 1e-7);
  EXPECT_NEAR(wide.value(Modulus::tension) / narrow.value(Modulus::tension), 1.5 / 4, 1e-9);
}

TEST_F(SeveralModuliOf, FromPixelsTheTruthLiesInNineOfTenIntervals) {
  // 200 cells at 0.34 um and random positions: 90 % intervals hold 90 % +- 2.1 % (standard deviation of the count)
  // where errors are normal; the bias of pixels is that of the rendered errors.
  constexpr double pixel_um = 0.34;
  const RenderedErrors pixels(between_, pixel_um, 100);
  const auto all = estimator(features_of_contour());
  constexpr int cells = 200;
  int young = 0, cortex = 0;
  std::uniform_real_distribution place(-0.5, 0.5);
  for (int trial = 0; trial < cells; ++trial) {
    const Cell cell = random_cell(0.15);
    const auto features =
        features_in_pixels(invented_outline(cell.place, cell.stiffness), pixel_um, {place(engine_), place(engine_)});
    const auto found = fit_pixels(all, pixels, features, simulated_);
    young += std::abs(found.value(Modulus::young) - cell.young()) < 1.645 * found.error(Modulus::young);
    cortex += std::abs(found.value(Modulus::cortex) - cell.cortex()) < 1.645 * found.error(Modulus::cortex);
  }
  EXPECT_GT(young, 0.83 * cells);
  EXPECT_LT(young, 0.97 * cells);
  EXPECT_GT(cortex, 0.83 * cells);
  EXPECT_LT(cortex, 0.97 * cells);
}

TEST_F(SeveralModuliOf, WhatTheDataDoNotTellIsSaid) {
  // A hardly deformed cell in pixels: E and E2D are unknown, the sentence says so.
  const Cell stiff{{7, 0.5, 0.15}, 4};
  MeasuredShape shape{invented_features(stiff.place, stiff.stiffness), fine_errors(0.005)};
  const auto found = estimator(features_of_figure()).fit(shape, simulated_);
  EXPECT_EQ(found.status, ModuliStatus::not_told_apart);
  EXPECT_NE(sentence(found).find("do not tell"), std::string::npos) << sentence(found);
}

TEST_F(SeveralModuliOf, ShapesThatNoCellHasAreSaid) {
  // Too large, not a number, and a contour that no cell of the table has.
  const Cell cell = random_cell(0.15);
  const MeasuredShape good{invented_features(cell.place, cell.stiffness), fine_errors(1e-3)};
  const auto all = estimator(features_of_contour());
  const auto status = [&](int feature, double value) {
    MeasuredShape shape = good;
    shape.features(feature) = value;
    return all.fit(shape, simulated_).status;
  };
  EXPECT_EQ(status(0, std::log(2000)), ModuliStatus::outside_table);
  EXPECT_EQ(status(0, std::nan("")), ModuliStatus::no_data);
  ChannelFlow unknown = simulated_;
  unknown.viscosity_mPas = std::nan("");
  const auto without_viscosity = all.fit(good, unknown);
  EXPECT_EQ(without_viscosity.status, ModuliStatus::no_data);
  EXPECT_TRUE(std::isnan(without_viscosity.stiffness_kPa)) << "no number stands where nothing is known";
  EXPECT_EQ(status(int(ShapeFeature::first_mode) + 4, 0.2), ModuliStatus::poor_fit);
}

}  // namespace
}  // namespace rheocyte::several_moduli_test
