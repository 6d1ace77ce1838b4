// Lines of a grid are where it has their moduli, and an event on a line gets that line's modulus.
#include "infer/grid_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../table/invented_branch.h"
#include "infer/grid_modulus.h"
#include "table/grid_from_branches.h"

namespace rheocyte {
namespace {

class GridLines : public testing::Test {
 protected:
  TableSpec spec_ = parse_table_spec(test::short_spec, "spec.toml", std::vector<std::string>{"table.radii=40"});
  GridContent content_ = make_stiffness_grid(spec_, test::invented_unstable_branches(spec_), "test").value();
};

TEST_F(GridLines, LieWhereTheClosedFormHasTheirModulus) {
  const auto found = GridLineFinder(content_).lines(std::vector<double>{1, 2, 1000});
  ASSERT_EQ(found.lines.size(), 2U) << "there are no cells of 1000 kPa";
  EXPECT_EQ(found.identifier, "XX-2D-26");
  for (const auto& line : found.lines) {
    EXPECT_GT(line.points.size(), 100U);
    for (const auto& point : line.points)
      EXPECT_NEAR(test::invented_modulus(point.x, point.y), line.modulus_kPa, 1e-4 * line.modulus_kPa);
  }
}

TEST_F(GridLines, AnEventOnALineGetsItsModulus) {
  const auto lines = GridLineFinder(content_).lines(std::vector<double>{1.5});
  const GridModulus modulus(content_);
  const MeasuringConditions conditions{30, 0.16, 0.34};
  const auto seen = as_measured(lines.lines.front().points, 20, conditions, PixelCorrection::own);
  const double viscosity = 5, expected = 1.5 * modulus_factor(lines, conditions, viscosity);
  for (std::size_t i = 1; i + 1 < seen.size(); i += 20) {
    double found = 0, error = 0;
    ModulusState state{};
    modulus.estimate(conditions, {{&seen[i].x, 1}, {&seen[i].y, 1}, {&viscosity, 1}},
                     {{&found, 1}, {&error, 1}, {&state, 1}});
    EXPECT_NEAR(found, expected, 1e-5 * expected);
  }
}

TEST_F(GridLines, LevelsFillThePictureAndTheSupportEndsAtTheBorder) {
  const GridLineFinder finder(content_);
  const auto levels = finder.even_levels(11);
  EXPECT_EQ(levels.size(), 11U);
  EXPECT_TRUE(std::ranges::is_sorted(levels));
  EXPECT_EQ(finder.lines(levels).lines.size(), 11U);
  for (const auto& point : finder.support()) {
    const double end = 0.05 + 0.02 * (std::sqrt(point.x / (std::numbers::pi * (1 + 0.5 * point.y))) - 3);
    EXPECT_LT(point.y, std::min(0.19, end) * 1.001) << "where the surface is stable";
  }
}

}  // namespace
}  // namespace rheocyte
