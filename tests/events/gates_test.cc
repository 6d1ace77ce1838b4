// Gates on what the stiffness of a cell decides, and the same gates without them.
#include "events/gates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::gates_test {
namespace {

TEST(Gates, OnDeformationCircularityInertiaRatioOrModulusLimitShapes) {
  for (const std::string feature : {"deform", "circ", "inert_ratio_cvx", "inert_ratio_raw", "emodulus"})
    EXPECT_TRUE(Gates({.min = {}, .max = {feature + "=0.1"}}).limit_shapes()) << feature;
  for (const std::string feature : {"area_um", "area_ratio", "pos_x", "volume", "bright_avg"})
    EXPECT_FALSE(Gates({.min = {feature + "=0.1"}, .max = {}}).limit_shapes()) << feature;
  EXPECT_TRUE(Gates({{}, {}, {"area_um,deform=40,0:90,0:90,0.1"}}).limit_shapes());
  EXPECT_FALSE(Gates({{}, {}, {"area_um,area_ratio=40,1:90,1:90,1.1"}}).limit_shapes());
  EXPECT_FALSE(Gates(GateOptions{}).limit_shapes());
}

TEST(Gates, WithoutShapesTheOthersStay) {
  const Gates gates = Gates({{"area_um=50", "deform=0.01"}, {"area_ratio=1.05", "circ=0.99"}}).without_shapes();
  EXPECT_FALSE(gates.limit_shapes());
  EXPECT_EQ(gates.limits_of("area_um").min, 50);
  EXPECT_EQ(gates.limits_of("area_ratio").max, 1.05);
  EXPECT_TRUE(std::isinf(gates.limits_of("deform").min));
}

TEST(Gates, APolygonLeavesTheRangeOfItsOtherFeature) {
  const Gates gates = Gates({{"area_um=45"}, {}, {"area_um,deform=40,0:90,0:90,0.1", "circ,deform=0,0:1,0:1,1"}});
  const Gates others = gates.without_shapes();
  EXPECT_EQ(others.limits_of("area_um").min, 45);
  EXPECT_EQ(others.limits_of("area_um").max, 90);
  EXPECT_EQ(others.description(), "45 <= area_um <= 90");
}

/// Edges of such polygons are straight over the logarithm.
TEST(Gates, TheRangeOfALogarithmicAxisIsThatOfItsValues) {
  const Gates others = Gates({{}, {}, {"log:area_um,deform=40,0:90,0:90,0.1"}}).without_shapes();
  EXPECT_DOUBLE_EQ(others.limits_of("area_um").min, 40);
  EXPECT_DOUBLE_EQ(others.limits_of("area_um").max, 90);
}

}  // namespace
}  // namespace rheocyte::gates_test
