// A polynomial comes back from its values, its slope too, and a cubic from two values and slopes.
#include "numeric/lagrange.h"

#include <gtest/gtest.h>

#include <array>

#include "numeric/hermite.h"

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

TEST(Hermite, GivesBackACubicWithItsSlope) {
  const double a = 1, width = 2.5, b = a + width;
  for (const double t : {0.0, 0.3, 1.0}) {
    const double x = a + t * width;
    EXPECT_NEAR(hermite(t)(cubic(a), cubic(b), width * slope(a), width * slope(b)), cubic(x), 1e-13);
    EXPECT_NEAR(hermite_slope(t)(cubic(a), cubic(b), width * slope(a), width * slope(b)) / width, slope(x), 1e-13);
  }
}

}  // namespace
}  // namespace rheocyte::lagrange_test
