#include "fem/channel_geometry.h"

#include <gtest/gtest.h>

namespace rheocyte::channel_geometry_test {
namespace {

constexpr double rounding = 1e-14;  // a few operations on lengths of order one
constexpr int samples = 20;
constexpr std::array radius_ratios = {0.05, 0.1, 0.3, 0.5, 0.7, 0.88, 0.965};

/// Largest distance between the points of two parametrised sides.
template <class Side>
double gap(const ChannelGeometry& geometry, const Side& one, const Side& other) {
  double largest = 0;
  for (int i = 0; i <= samples; ++i) {
    const auto [block1, outward1, along1] = one(double(i) / samples);
    const auto [block2, outward2, along2] = other(double(i) / samples);
    largest =
        std::max(largest, (geometry.map(block1, outward1, along1) - geometry.map(block2, outward2, along2)).norm());
  }
  return largest;
}

struct Parameters {
  Block block;
  double outward, along;
};
using Side = std::function<Parameters(double)>;

Side from_centre(Block block, double outward) {
  return [=](double t) { return Parameters{block, outward, t}; };
}
Side spoke(Block block, double along) {
  return [=](double t) { return Parameters{block, t, along}; };
}

TEST(ChannelGeometry, NeighbouringBlocksShareTheirSides) {
  // Each common side is the same curve with the same parameter from both blocks.
  const std::vector<std::pair<Side, Side>> sides = {{spoke(Block::core, 0), from_centre(Block::ring_front, 0)},
                                                    {from_centre(Block::core, 1), from_centre(Block::ring_top, 0)},
                                                    {spoke(Block::core, 1), from_centre(Block::ring_rear, 0)},
                                                    {spoke(Block::ring_front, 1), spoke(Block::ring_top, 0)},
                                                    {spoke(Block::ring_rear, 1), spoke(Block::ring_top, 1)},
                                                    {from_centre(Block::ring_front, 1), from_centre(Block::front, 0)},
                                                    {from_centre(Block::ring_top, 1), from_centre(Block::top, 0)},
                                                    {from_centre(Block::ring_rear, 1), from_centre(Block::rear, 0)},
                                                    {spoke(Block::front, 1), spoke(Block::top, 0)},
                                                    {spoke(Block::rear, 1), spoke(Block::top, 1)},
                                                    {from_centre(Block::front, 1), from_centre(Block::downstream, 0)},
                                                    {from_centre(Block::rear, 1), from_centre(Block::upstream, 0)}};
  for (const double ratio : radius_ratios) {
    const ChannelGeometry geometry(ratio);
    for (const auto& [one, other] : sides) EXPECT_LT(gap(geometry, one, other), rounding) << ratio;
  }
}

TEST(ChannelGeometry, TheOuterSidesAreAxisWallAndEnds) {
  // r = 0 on the axis, r = 1 on the wall, x = -+ half_length at inlet and outlet.
  for (const double ratio : radius_ratios) {
    const ChannelGeometry geometry(ratio);
    for (int i = 0; i <= samples; ++i) {
      const double t = double(i) / samples;
      for (const Block block : {Block::ring_front, Block::front, Block::downstream, Block::rear, Block::upstream}) {
        EXPECT_NEAR(geometry.map(block, t, 0)(1), 0, rounding);
      }
      EXPECT_NEAR(geometry.map(Block::core, 0, t)(1), 0, rounding);
      EXPECT_NEAR(geometry.map(Block::top, 1, t)(1), 1, rounding);
      EXPECT_NEAR(geometry.map(Block::downstream, t, 1)(1), 1, rounding);
      EXPECT_NEAR(geometry.map(Block::upstream, 1, t)(0), -geometry.half_length(), rounding);
      EXPECT_NEAR(geometry.map(Block::downstream, 1, t)(0), geometry.half_length(), rounding);
    }
  }
}

TEST(ChannelGeometry, TheSurfaceIsASphere) {
  // Its points have the distance r0 from the centre and the angle that the geometry says.
  const ChannelGeometry geometry(0.7);
  for (const auto& [block, sector] :
       {std::pair{Block::front, Sector::front}, {Block::top, Sector::top}, {Block::rear, Sector::rear}}) {
    for (int i = 0; i <= samples; ++i) {
      const Point x = geometry.map(block, 0, double(i) / samples);
      EXPECT_NEAR(x.norm(), 0.7, rounding);
      EXPECT_NEAR(std::atan2(x(1), x(0)), geometry.angle(sector, double(i) / samples), rounding);
    }
  }
}

TEST(ChannelGeometry, FrontAndRearAreMirrorImages) {
  // The undeformed half-plane has no direction: (x, r) and (-x, r) belong together.
  const ChannelGeometry geometry(0.6);
  const auto mirrored = [](const Point& x) { return Point(-x(0), x(1)); };
  for (int i = 0; i <= samples; ++i) {
    const double s = double(i) / samples, t = 0.37;
    EXPECT_LT((geometry.map(Block::front, s, t) - mirrored(geometry.map(Block::rear, s, t))).norm(), rounding);
    EXPECT_LT((geometry.map(Block::top, t, s) - mirrored(geometry.map(Block::top, t, 1 - s))).norm(), rounding);
    EXPECT_LT((geometry.map(Block::core, t, s) - mirrored(geometry.map(Block::core, t, 1 - s))).norm(), rounding);
  }
}

}  // namespace
}  // namespace rheocyte::channel_geometry_test
