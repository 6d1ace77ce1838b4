// A polynomial comes back from its values, its slope too.
#include "numeric/lagrange.h"

#include <gtest/gtest.h>

#include <array>

namespace rheocyte::lagrange_test {
namespace {

double cubic(double x) { return 2 - x + 3 * x * x - 0.5 * x * x * x; }
double slope(double x) { return -1 + 6 * x - 1.5 * x * x; }

struct Node {
  double x, y;
};

TEST(Lagrange, GivesBackACubicWithItsSlope) {
  const std::array<double, 4> nodes{-1, 0.5, 1, 3};
  for (const double x : {-2.0, 0.5, 0.7, 4.0}) {
    const auto weights = lagrange_weights(nodes, x);
    double value = 0, change = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      value += weights.value[i] * cubic(nodes[i]);
      change += weights.slope[i] * cubic(nodes[i]);
    }
    EXPECT_NEAR(value, cubic(x), 1e-12) << "rounding";
    EXPECT_NEAR(change, slope(x), 1e-12);
  }
}

TEST(Lagrange, TheChangeIsThatFromTheLineBetweenTheMiddleNodes) {
  const std::array<Node, 4> nodes{{{-1, cubic(-1)}, {0, cubic(0)}, {1, cubic(1)}, {2, cubic(2)}}};
  const auto found = lagrange_estimate(std::span<const Node>(nodes), 0.5, &Node::x, &Node::y);
  EXPECT_NEAR(found.value, cubic(0.5), 1e-14);
  EXPECT_NEAR(found.change, cubic(0.5) - 0.5 * (cubic(0) + cubic(1)), 1e-14);
}

}  // namespace
}  // namespace rheocyte::lagrange_test
