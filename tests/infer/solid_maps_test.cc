// What is measured of elongated solids, as populations are fitted with it.
#include "infer/solid_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../table/invented_elongated.h"
#include "infer/outline_errors.h"

namespace rheocyte::solid_maps_test {
namespace {

using test::InventedElongated;

constexpr double pixel_um = 0.34;

SolidFeatures features_of(const InventedElongated& c, double length = 1) {
  return {std::log(c.area_um2() * length * length), c.deformation(), c.inertia_ratio(), {c.mode_2(), c.mode_3()}};
}

class Maps : public testing::Test {
 protected:
  ElongatedSolids solids_{test::invented_elongated_content()};
  ElongatedLiquid liquid_{solids_, nullptr, nullptr};
};

/// The cells of the table, through pixels.
TEST_F(Maps, HaveTheAreaAndTheMeasureOfTheCellWithThisElongation) {
  for (const StiffnessMeasure by : {StiffnessMeasure::asymmetry, StiffnessMeasure::odd_deformation}) {
    const SolidMaps maps(liquid_, {20, 0.04, 1}, {pixel_um}, by);
    for (const double axial : {-0.03, 0.1, 0.3})
      for (const double modulus : {2.0, 6.0, 40.0}) {
        const InventedElongated cell{6.3, axial, modulus};
        const SolidFeatures seen = through_pixels(features_of(cell), by, pixel_um);
        const auto map = maps.at(by == StiffnessMeasure::asymmetry ? seen.modes.mode_2 : seen.inertia_ratio);
        const double u = std::log(6.3), x = std::log(modulus / 15) - map->soft_end(u).log_modulus;
        const MapPoint p = map->at(u, x);
        EXPECT_NEAR(p.log_area, seen.log_area, 3e-4) << axial << " " << modulus;  // a tenth of the noise
        EXPECT_NEAR(p.measure, by == StiffnessMeasure::asymmetry ? seen.modes.mode_3 : seen.deformation, 1e-4)
            << axial << " " << modulus;
      }
  }
}

TEST_F(Maps, InAnotherChannelTheCellsScaleAsTheEquations) {
  const SolidMaps maps(liquid_, {30, 0.16, 1}, {pixel_um}, StiffnessMeasure::asymmetry);
  const InventedElongated cell{6.3, 0.15, 2};
  const SolidFeatures seen = through_pixels(features_of(cell, 1.5), StiffnessMeasure::asymmetry, pixel_um);
  const auto map = maps.at(seen.modes.mode_2);
  const double u = std::log(6.3 * 1.5), factor = (0.16 / 0.04) / 15 * std::pow(20. / 30, 3);
  const MapPoint p = map->at(u, std::log(2 * factor) - map->soft_end(u).log_modulus);
  EXPECT_NEAR(p.log_area, seen.log_area, 3e-4);
  EXPECT_NEAR(p.measure, seen.modes.mode_3, 1e-4);
}

TEST_F(Maps, TheSlopesAreThoseOfTheValues) {
  const SolidMaps maps(liquid_, {20, 0.04, 1}, {pixel_um}, StiffnessMeasure::asymmetry);
  const auto map = maps.at(0.1);
  const double u = 1.83, step = 1e-5;
  for (const double x : {0.03, 0.6, 2.5}) {
    const MapPoint p = map->at(u, x), right = map->at(u + step, x), up = map->at(u, x + step);
    EXPECT_NEAR((right.log_area - p.log_area) / step, p.log_area_by_radius, 1e-3);
    EXPECT_NEAR((right.measure - p.measure) / step, p.measure_by_radius, 1e-4);
    EXPECT_NEAR((up.log_area - p.log_area) / step, p.log_area_by_height, 1e-3);
    EXPECT_NEAR((up.measure - p.measure) / step, p.measure_by_height, 1e-4);
  }
  const auto end = map->soft_end(u);
  EXPECT_NEAR((map->soft_end(u + step).log_modulus - end.log_modulus) / step, end.slope, 1e-3);
}

TEST_F(Maps, TheErrorOfOneImageIsThatOfTheSingleEvent) {
  const SolidMaps maps(liquid_, {20, 0.04, 1}, {pixel_um}, StiffnessMeasure::asymmetry);
  const InventedElongated cell{6.3, 0.15, 3};
  const SolidFeatures seen = through_pixels(features_of(cell), StiffnessMeasure::asymmetry, pixel_um);
  const OutlineModes& modes = seen.modes;
  const double area = std::exp(seen.log_area), viscosity = 15;
  double modulus, error, elongation, elongation_error, tension, tension_error;
  ModulusState state;
  ElongatedCell found;
  solids_.estimate({{20, 0.04}, pixel_um}, {{&area, 1}, {&seen.deformation, 1}, {&viscosity, 1}},
                   {ElongatedBy::modes, {&modes.mode_2, 1}, {&modes.mode_3, 1}, {&modes.mode_4, 1}, {&modes.mode_5, 1}},
                   {{{&modulus, 1}, {&error, 1}, {&state, 1}},
                    {&elongation, 1},
                    {&elongation_error, 1},
                    {&tension, 1},
                    {&tension_error, 1},
                    {&found, 1}});
  ASSERT_EQ(state, ModulusState::valid);
  const double of_pixels = std::sqrt(std::pow(error / modulus, 2) - std::pow(solids_.table().error(), 2));
  // Events are freed of what pixels do on average; the map takes its slopes along.
  constexpr double step = 1e-4;
  const auto excess = [&](double off) {
    return mode_errors(seen.log_area - 2 * std::log(pixel_um),
                       {modes.mode_2, modes.mode_3 + off, modes.mode_4, modes.mode_5})
        .mode_3.excess;
  };
  const double of_map = of_pixels * (1 - (excess(step) - excess(-step)) / (2 * step));
  EXPECT_NEAR(event_error(*maps.at(modes.mode_2), std::log(6.3), std::log(3.0 / 15)), of_map, 0.02 * of_map);
}

TEST_F(Maps, TheCellBehindAMeasuredElongationHasIt) {
  const SolidMaps maps(liquid_, {20, 0.04, 1}, {pixel_um}, StiffnessMeasure::asymmetry);
  const auto cell = maps.cell(0.12, std::log(6.1), 0.7);
  EXPECT_NEAR(maps.seen(cell).modes.mode_2, 0.12, 2e-3);  // of the nearest node's radius
  EXPECT_NEAR(cell.state.radius_um, 6.1, 1e-9);
  const auto range = maps.elongations();
  EXPECT_LT(range.lower, -0.03);
  EXPECT_GT(range.upper, 0.25);
}

TEST_F(Maps, ErrorsOfTheOutlineAreInTheMeansAndInTheNoise) {
  const auto by = StiffnessMeasure::asymmetry;
  const auto of_noise = [&](double deviation_um) {
    return std::make_shared<const OutlineErrors>(solids_.table(), 20, pixel_um, OutlineNoise{deviation_um});
  };
  const auto errors = of_noise(0.1);
  const SolidMaps without(liquid_, {20, 0.04, 1}, {pixel_um}, by),
      none(liquid_, {20, 0.04, 1}, {pixel_um, of_noise(0)}, by), with(liquid_, {20, 0.04, 1}, {pixel_um, errors}, by);
  const InventedElongated cell{6.3, 0.15, 3};
  const double u = std::log(cell.radius_um);
  const auto of = [&](const SolidMaps& maps, double elongation) {
    const auto map = maps.at(elongation);
    return map->at(u, std::log(cell.modulus_kPa / 15) - map->soft_end(u).log_modulus);
  };
  SolidFeatures seen = through_pixels(features_of(cell), by, pixel_um);
  const MapPoint p = of(without, seen.modes.mode_2);
  EXPECT_EQ(of(none, seen.modes.mode_2).measure, p.measure);
  EXPECT_EQ(of(none, seen.modes.mode_2).measure_variance, p.measure_variance);
  const ShapeErrors added = errors->at(std::log(cell.area_um2()), cell.mode_2(), cell.mode_3());
  const MapPoint off = of(with, seen.modes.mode_2 + added.bias(feature_of_mode(2)));
  EXPECT_NEAR(off.measure, seen.modes.mode_3 + added.bias(feature_of_mode(3)), 1e-4);
  EXPECT_NEAR(off.log_area, seen.log_area + added.bias(int(ShapeFeature::area_um2)), 3e-4);
  // The slopes by which the elongation is eliminated, times its noise, come on top.
  EXPECT_GT(off.measure_variance, p.measure_variance + added.covariance(feature_of_mode(3), feature_of_mode(3)));
  EXPECT_LT(off.measure_variance, p.measure_variance + 2 * added.covariance(feature_of_mode(3), feature_of_mode(3)));
}

TEST_F(Maps, ByDeformationTheCellsHaveNoElongationOfTheirOwn) {
  const SolidMaps maps(liquid_, {20, 0.04, 1}, {pixel_um}, StiffnessMeasure::deformation);
  const InventedElongated cell{6.3, 0, 2};
  const SolidFeatures seen = through_pixels(features_of(cell), StiffnessMeasure::deformation, pixel_um);
  const auto map = maps.at(0);
  const MapPoint p = map->at(std::log(6.3), std::log(2.0 / 15) - map->soft_end(std::log(6.3)).log_modulus);
  EXPECT_NEAR(p.log_area, seen.log_area, 3e-4);
  EXPECT_NEAR(p.measure, seen.deformation, 1e-4);
}

}  // namespace
}  // namespace rheocyte::solid_maps_test
