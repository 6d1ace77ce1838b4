// Rules for means over normally distributed numbers: polynomials up to the fifth degree are exact, also behind a gate.
#include "population/normal_nodes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

namespace rheocyte::normal_nodes_test {
namespace {

using Powers = std::array<int, 3>;

double monomial(const Eigen::VectorXd& place, const Powers& powers) {
  double product = 1;
  for (int i = 0; i < 3; ++i) product *= std::pow(place(i), powers[std::size_t(i)]);
  return product;
}

double mean_of(const NormalNodes& nodes, const Powers& powers) {
  double sum = 0;
  for (Eigen::Index k = 0; k < nodes.weight.size(); ++k) sum += nodes.weight(k) * monomial(nodes.place.col(k), powers);
  return sum;
}

template <class Each>
void for_powers(const Each& each) {
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      for (int c = 0; a + b + c <= 5; ++c) each(Powers{a, b, c});
}

double normal_moment(int power) {
  double moment = power % 2 == 0;
  for (int k = power - 1; k > 1; k -= 2) moment *= k;
  return moment;
}

TEST(NormalNodes, PolynomialsUpToTheFifthDegreeAreExact) {
  const NormalNodes nodes = normal_nodes(3);
  for_powers([&](const Powers& p) {
    EXPECT_NEAR(mean_of(nodes, p), normal_moment(p[0]) * normal_moment(p[1]) * normal_moment(p[2]), 1e-12);
  });
}

/// By a sum over many places: of the first number alone, by Simpson's rule.
double truncated_moment(int power, double least, double greatest) {
  constexpr int steps = 20'000;
  double sum = 0, weights = 0;
  for (int k = 0; k <= steps; ++k) {
    const double t = least + (greatest - least) * k / steps, simpson = k == 0 || k == steps ? 1 : k % 2 == 0 ? 2 : 4;
    sum += simpson * std::exp(-t * t / 2) * std::pow(t, power);
    weights += simpson * std::exp(-t * t / 2);
  }
  return sum / weights;
}

TEST(NormalNodes, BehindAGateTheyAreStillExact) {
  constexpr double far = 9;
  for (const ValueGate gate : {ValueGate{0.3, far}, ValueGate{-far, -0.8}, ValueGate{-0.5, 0.7}, ValueGate{1.5, 2.5}}) {
    GatedValue value{0.1, Eigen::Vector3d(0.6, 0, 0)};
    const NormalNodes nodes = kept_nodes(gate, value);
    const double least = (gate.least - 0.1) / 0.6, greatest = (gate.greatest - 0.1) / 0.6;
    for_powers([&](const Powers& p) {
      const double wanted = truncated_moment(p[0], least, greatest) * normal_moment(p[1]) * normal_moment(p[2]);
      EXPECT_NEAR(mean_of(nodes, p), wanted, 1e-8 * (1 + std::abs(wanted))) << p[0] << p[1] << p[2];
    });
  }
}

/// Along the value's direction and across it, where nothing is cut.
TEST(NormalNodes, AGateCutsAlongItsValueAlone) {
  const Eigen::Vector3d slope(0.5, -0.3, 0.2);
  const GatedValue value{0, slope};
  const NormalNodes nodes = kept_nodes({0, HUGE_VAL}, value);
  const Eigen::Vector3d mean = nodes.place * nodes.weight,
                        half_normal = std::sqrt(2 / std::numbers::pi) * slope.normalized();
  EXPECT_LT((mean - half_normal).norm(), 1e-12);
  const Eigen::Vector3d across = slope.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::VectorXd places = nodes.place.transpose() * across;
  EXPECT_NEAR(places.cwiseAbs2().dot(nodes.weight), 1, 1e-12);
  EXPECT_NEAR(fraction_within({0, HUGE_VAL}, value), 0.5, 1e-15);
}

TEST(NormalNodes, WideGatesCutNothing) {
  const GatedValue value{0, Eigen::Vector3d(0.5, 0.1, 0)};
  EXPECT_EQ(fraction_within({}, value), 1);
  const NormalNodes nodes = kept_nodes({}, value);
  for_powers([&](const Powers& p) {
    EXPECT_NEAR(mean_of(nodes, p), normal_moment(p[0]) * normal_moment(p[1]) * normal_moment(p[2]), 1e-9);
  });
}

}  // namespace
}  // namespace rheocyte::normal_nodes_test
