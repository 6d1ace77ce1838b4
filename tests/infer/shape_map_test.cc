// Measured shapes against those of a table: how much longer they are.
#include "infer/shape_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../table/invented_branch.h"
#include "infer/grid_map.h"
#include "table/grid_from_branches.h"

namespace rheocyte::shape_map_test {
namespace {

class ShapeMapOf : public testing::Test {
 protected:
  ShapeExcess excess(const MeasuringConditions& conditions, double area, double deformation, double ratio) const {
    ShapeExcess e;
    shapes_.compare(conditions, {{&area, 1}, {&deformation, 1}, {}}, {&ratio, 1}, {&e, 1});
    return e;
  }
  static GridMap make_map() {
    const TableSpec spec = parse_table_spec(test::short_spec, "spec.toml", std::vector<std::string>{"table.radii=40"});
    return GridMap(make_stiffness_grid(spec, test::invented_branches(spec), "test").value());
  }
  static const GridMap& map() {
    static const GridMap made = make_map();
    return made;
  }
  const ShapeMap& shapes_ = *map().shapes();
};

TEST_F(ShapeMapOf, ACellOfTheTableHasNoExcessAndIsNotFlagged) {
  const auto e = excess({{20, 0.04}, 0}, 100, 0.03, 1 + 1.5 * 0.03);
  EXPECT_NEAR(e.excess, 0, 1e-6);
  EXPECT_FALSE(e.is_elongated());
}

TEST_F(ShapeMapOf, AnEllipseExplainsItsDeformationAlone) {
  const double ratio = 1.3, d = deformation_of_ellipse(ratio);
  EXPECT_NEAR(d, 0.0128, 1e-4);  // 3/4 c_2^2 with c_2 = (ratio - 1) / (ratio + 1), to second order
  const auto e = excess({{20, 0.04}, 0}, 100, d, ratio);
  EXPECT_NEAR(e.odd_fraction, 0, 1e-9);
  EXPECT_NEAR(e.excess, ratio - (1 + 1.5 * d), 1e-6);
  EXPECT_TRUE(e.is_elongated());
  EXPECT_EQ(deformation_of_ellipse(1), 0);
}

TEST_F(ShapeMapOf, SmallCellsNeedMoreExcessToBeFlaggedBecausePixelsScatterThem) {
  // 3 sigma are 0.047; with pixels twice as large, which explain all of the deformation, 0.094.
  EXPECT_TRUE(excess({{20, 0.04}, 0.34}, 31, 0.03, 1.085).is_elongated());
  EXPECT_FALSE(excess({{20, 0.04}, 0.68}, 31, 0.03, 1.085).is_elongated());
}

TEST_F(ShapeMapOf, WithoutNumbersOrOutsideTheAreasNothingIsSaid) {
  EXPECT_TRUE(std::isnan(excess({{20, 0.04}, 0}, 100, 0.03, NAN).excess));
  EXPECT_TRUE(std::isnan(excess({{20, 0.04}, 0}, NAN, 0.03, 1.1).excess));
  EXPECT_TRUE(std::isnan(excess({{20, 0.04}, 0}, 100, 0.03, INFINITY).excess)) << "infinity is not a number";
  for (const double infinite : {INFINITY, -INFINITY})
    EXPECT_TRUE(std::isnan(excess({{20, 0.04}, 0}, 100, infinite, 1.1).excess)) << infinite;
  EXPECT_TRUE(std::isnan(excess({{20, 0.04}, 0}, 10, 0.03, 1.1).excess));
  EXPECT_FALSE(excess({{20, 0.04}, 0}, 10, 0.03, 1.5).is_elongated());
  EXPECT_TRUE(std::isnan(excess({{20, 0.04}, 0}, 100, 0, 1.1).odd_fraction));
}

}  // namespace
}  // namespace rheocyte::shape_map_test
