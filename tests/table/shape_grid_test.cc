#include "table/shape_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "in_single_precision.h"
#include "invented_branch.h"
#include "table/grid_from_branches.h"

namespace rheocyte::shape_grid_test {
namespace {

using namespace test;

class ShapesOfATable : public ::testing::Test {
 protected:
  TableSpec spec_ = spec_of_fifty_radii({"table.max_deformation=0.1"});
  StiffnessGrid grid_{make_stiffness_grid(spec_, invented_branches(spec_), "test").value()};
  ShapeGrid shapes_{grid_.content().shapes.value()};
};

TEST_F(ShapesOfATable, GiveBackTheMeasuresOfTheBranchesBetweenTheNodes) {
  // Measures are cubics between the 24 samples of a branch, here a factor of 1.4 of the deformation apart: what grows
  // with the deformation is off by 2e-5 of itself, its root by less.
  for (const double area : {31.0, 77.7, 150.0, 280.0})
    for (const double d : {1e-4, 0.0123, 0.09}) {
      EXPECT_NEAR(shapes_.inertia_ratio(std::log(area), d), 1 + 1.5 * d, 1e-4 * d) << area << " " << d;
      EXPECT_NEAR(shapes_.mode(2, std::log(area), d), 0.3 * d, 1e-4 * d) << area << " " << d;
      EXPECT_NEAR(shapes_.mode(3, std::log(area), d) / invented_asymmetry(d), 1, 1e-3) << area << " " << d;
    }
}

TEST_F(ShapesOfATable, KnowTheNearestCellOutsideAndTheCircleBelow) {
  const double last = shapes_.inertia_ratio(std::log(77.7), 0.1);
  EXPECT_DOUBLE_EQ(shapes_.inertia_ratio(std::log(77.7), 0.5), last);
  EXPECT_DOUBLE_EQ(shapes_.inertia_ratio(std::log(1000.0), 0.01), shapes_.inertia_ratio(std::log(290.0), 0.01));
  EXPECT_EQ(shapes_.inertia_ratio(std::log(77.7), 0), 1);
  EXPECT_EQ(shapes_.mode(3, std::log(77.7), -0.001), 0);
  EXPECT_TRUE(std::isnan(shapes_.inertia_ratio(NAN, 0.01)));
  EXPECT_TRUE(shapes_.has_area(std::log(77.7)));
  EXPECT_FALSE(shapes_.has_area(std::log(20.0)));
}

TEST_F(ShapesOfATable, SurviveTheFile) {
  const GridContent read = grid_from_bytes(to_bytes(grid_.content()), "grid");
  ASSERT_TRUE(read.shapes);
  const ShapeNodes& written = *grid_.content().shapes;
  EXPECT_EQ(read.shapes->inertia_ratio, in_single_precision(written.inertia_ratio));
  for (std::size_t k = 0; k < written.modes.size(); ++k)
    EXPECT_EQ(read.shapes->modes[k], in_single_precision(written.modes[k]));
  EXPECT_EQ(read.shapes->upper, written.upper);
}

}  // namespace
}  // namespace rheocyte::shape_grid_test
