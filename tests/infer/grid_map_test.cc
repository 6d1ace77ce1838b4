// Moduli from a grid: those of the table, scaled, with what pixels do taken away, and with errors that follow from it.
#include "infer/grid_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../table/invented_branch.h"
#include "case/user_error.h"
#include "measurement/pixel_errors.h"
#include "table/grid_from_branches.h"

namespace rheocyte::grid_map_test {
namespace {

struct Estimate {
  double modulus = 0, error = 0;
  ModulusState state = ModulusState::valid;
};

class GridMapOf : public testing::Test {
 protected:
  Estimate at(const MeasuringConditions& conditions, double area, double deformation, double viscosity = 15) const {
    Estimate e;
    modulus_.estimate(conditions, {{&area, 1}, {&deformation, 1}, {&viscosity, 1}},
                      {{&e.modulus, 1}, {&e.error, 1}, {&e.state, 1}});
    return e;
  }
  static GridContent make_content() {
    const TableSpec spec = parse_table_spec(test::short_spec, "spec.toml", std::vector<std::string>{"table.radii=40"});
    return make_stiffness_grid(spec, test::invented_branches(spec), "test").value();
  }
  static const GridContent& content() {
    static const GridContent made = make_content();
    return made;
  }
  GridMap modulus_{content()};
};

TEST_F(GridMapOf, ScalesLikeTheEquations) {
  const double expected = test::invented_modulus(100, 0.03);
  EXPECT_NEAR(at({{20, 0.04}, 0}, 100, 0.03).modulus, expected, 1e-5 * expected);
  const double scaled = expected * (0.16 / 0.04) * (5.5 / 15) * std::pow(20. / 30, 3);
  EXPECT_NEAR(at({{30, 0.16}, 0}, 100 * 2.25, 0.03, 5.5).modulus, scaled, 1e-5 * scaled);
}

TEST_F(GridMapOf, ManyEventsAreEachLikeOne) {
  std::vector<double> area, deformation, viscosity, modulus(1300), error(1300);
  std::vector<ModulusState> state(1300);
  for (int i = 0; i < 1300; ++i) {
    area.push_back(20 + 0.25 * i);
    deformation.push_back(i % 7 == 0 ? NAN : -0.005 + 0.00017 * i);
    viscosity.push_back(i % 11 == 0 ? NAN : 5 + 0.001 * i);
  }
  modulus_.estimate({{20, 0.06}, 0.34}, {area, deformation, viscosity}, {modulus, error, state});
  for (std::size_t i = 0; i < area.size(); ++i) {
    const auto one = at({{20, 0.06}, 0.34}, area[i], deformation[i], viscosity[i]);
    EXPECT_EQ(state[i], one.state) << i;
    EXPECT_EQ(std::isnan(modulus[i]), std::isnan(one.modulus)) << i;
    EXPECT_EQ(std::isfinite(modulus[i]), has_modulus(state[i])) << i;
    if (has_modulus(state[i])) {
      EXPECT_EQ(modulus[i], one.modulus) << i;
      EXPECT_EQ(error[i], one.error) << i;
    }
  }
}

TEST_F(GridMapOf, WhatIsInfiniteIsNoNumber) {
  for (const double infinite : {INFINITY, -INFINITY}) {
    EXPECT_EQ(at({{20, 0.06}, 0.34}, 100, infinite).state, ModulusState::no_data) << infinite;
    EXPECT_EQ(at({{20, 0.06}, 0.34}, infinite, 0.03).state, ModulusState::no_data) << infinite;
  }
}

TEST_F(GridMapOf, TakesAwayWhatPixelsDo) {
  const double pixel = 0.34, area = 100, deformation = 0.03;
  const auto pixels = pixel_errors(std::log(area / (pixel * pixel)), deformation);
  const double smooth = deformation - pixels.deformation_excess;
  const double both = test::invented_modulus(area * pixels.area_factor, smooth),
               one = test::invented_modulus(area, smooth);
  EXPECT_NEAR(at({{20, 0.04}, pixel}, area, deformation).modulus, both, 1e-5 * both);
  EXPECT_NEAR(at({{20, 0.04}, pixel, false}, area, deformation).modulus, one, 1e-5 * one);
  EXPECT_GT(both, 1.01 * one) << "areas are measured too small";
}

TEST_F(GridMapOf, ErrorsFollowFromScatterAndTable) {
  const double pixel = 0.34, area = 100, deformation = 0.02;
  const auto pixels = pixel_errors(std::log(area / (pixel * pixel)), deformation);
  const auto here = at({{20, 0.04}, pixel}, area, deformation);
  const double smooth_area = area * pixels.area_factor, smooth = deformation - pixels.deformation_excess, step = 1e-4;
  const auto log_modulus = [](double a, double d) { return std::log(test::invented_modulus(a, d)); };
  const double by_area = (log_modulus(smooth_area * (1 + step), smooth) - log_modulus(smooth_area, smooth)) / step;
  const double by_deformation =
      (log_modulus(smooth_area, smooth * (1 + step)) - log_modulus(smooth_area, smooth)) / step / smooth;
  const double a = by_area * pixels.area_deviation, d = by_deformation * pixels.deformation_deviation;
  const double expected = std::sqrt(a * a + d * d + 2 * pixels.correlation * a * d);
  EXPECT_NEAR(here.error / here.modulus, expected, 1e-3 * expected);
  // Without pixels the table's own error remains: half of 1e-4, because d ~ E^-2.
  const auto bare = at({{20, 0.04}, 0}, area, deformation);
  EXPECT_NEAR(bare.error / bare.modulus, 7e-5, 4e-5);
}

TEST_F(GridMapOf, EventsWithoutAModulusHaveAReason) {
  const MeasuringConditions conditions{{20, 0.04}, 0.34};
  EXPECT_EQ(at(conditions, NAN, 0.03).state, ModulusState::no_data);
  EXPECT_EQ(at(conditions, 100, NAN).state, ModulusState::no_data);
  EXPECT_EQ(at(conditions, 100, 0.03, NAN).state, ModulusState::no_data);
  EXPECT_EQ(at(conditions, -5, 0.03).state, ModulusState::no_data);
  EXPECT_EQ(at(conditions, 10, 0.03).state, ModulusState::too_small);
  EXPECT_EQ(at(conditions, 400, 0.03).state, ModulusState::too_large);
  EXPECT_EQ(at(conditions, 100, 0.002).state, ModulusState::too_stiff) << "less than the pixels add";
  EXPECT_EQ(at(conditions, 100, -0.01).state, ModulusState::too_stiff);
  EXPECT_EQ(at(conditions, 100, 0.4).state, ModulusState::too_soft);
  for (const double area : {10., 400., 100.}) {
    EXPECT_TRUE(std::isnan(at(conditions, area, 0.5).modulus));
    EXPECT_TRUE(std::isnan(at(conditions, area, 0.5).error));
  }
}

TEST_F(GridMapOf, AGridOfShellsIsRefused) {
  GridContent of_shells = content();
  of_shells.origin.is_shell = true;
  EXPECT_THROW(GridMap{of_shells}, UserError);
}

}  // namespace
}  // namespace rheocyte::grid_map_test
