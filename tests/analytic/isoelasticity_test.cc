#include "analytic/isoelasticity.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rheocyte::isoelasticity_test {
namespace {

IsoelasticityGrid grid() { return {{0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, {0.01, 0.1, 0.2, 2.0}, 0.02, Duct::tube}; }

TEST(Isoelasticity, PointsAreThoseOfSingleCells) {
  // A point of a line is the cell of its radius and capillary number, bit for bit.
  const auto lines = isoelasticity_lines(grid());
  ASSERT_EQ(lines[1].size(), 6U);
  const auto& point = lines[1][3];
  const ShapeMeasures shape = small_deformation(solid_in_tube(0.5), solid_strain(0.1)).shape;
  EXPECT_EQ(point.radius, 0.5);
  EXPECT_EQ(point.area, shape.area);
  EXPECT_EQ(point.deformation, shape.deformation);
}

TEST(Isoelasticity, AreaAndDeformationGrowAlongALine) {
  // Larger cells deform more at equal stiffness.
  for (const auto& line : isoelasticity_lines(grid()))
    for (std::size_t i = 1; i < line.size(); ++i) {
      EXPECT_GT(line[i].area, line[i - 1].area);
      EXPECT_GT(line[i].deformation, line[i - 1].deformation);
    }
}

TEST(Isoelasticity, ALineThatLeavesEndsAtTheGreatestDeformation) {
  // At Ca = 0.2 the limit is crossed between two radii of the grid; there the last point is, to 1e-11.
  const auto lines = isoelasticity_lines(grid());
  EXPECT_EQ(lines[0].size(), 6U);  // never leaves
  ASSERT_LT(lines[2].size(), 6U);
  const auto& last = lines[2].back();
  EXPECT_NEAR(last.deformation / 0.02, 1, 1e-11);
  const double there = small_deformation(solid_in_tube(last.radius), solid_strain(0.2)).shape.deformation;
  EXPECT_EQ(there, last.deformation);
}

TEST(Isoelasticity, ALineThatBeginsOutsideIsEmpty) {
  // At Ca = 2 the smallest cell deforms by more than the limit already.
  EXPECT_TRUE(isoelasticity_lines(grid())[3].empty());
}

TEST(Isoelasticity, TheSquareDuctIsASmallerLoad) {
  // Its velocity on the axis is 0.985253 of the tube's, and d goes with the square.
  IsoelasticityGrid tube = grid(), square = grid();
  square.duct = Duct::square;
  const double ratio = isoelasticity_lines(square)[0][2].deformation / isoelasticity_lines(tube)[0][2].deformation;
  EXPECT_NEAR(ratio, 0.985253 * 0.985253, 1e-5);  // the next order in the strain
}

}  // namespace
}  // namespace rheocyte::isoelasticity_test
