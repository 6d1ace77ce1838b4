#include "fem/node_numbers.h"

#include <gtest/gtest.h>

#include <random>

namespace rheocyte::node_numbers_test {
namespace {

TEST(NodeNumbers, APointKeepsItsNumberUpToRounding) {
  // Random points, each met again with errors of 1e-14 in all directions: as many numbers as points, in any dimension.
  const auto check = [](auto dimension) {
    constexpr int dim = decltype(dimension)::value;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-2, 2), error(-1e-14, 1e-14);
    PointNumbers<dim> numbers;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Matrix<double, dim, 1> x = Eigen::Matrix<double, dim, 1>::NullaryExpr([&] { return place(random); });
      const int number = numbers.number(x);
      EXPECT_EQ(number, i);
      for (int again = 0; again < 20; ++again)
        EXPECT_EQ(numbers.number(x + Eigen::Matrix<double, dim, 1>::NullaryExpr([&] { return error(random); })), i);
    }
    EXPECT_EQ(numbers.count(), 500);
  };
  check(std::integral_constant<int, 1>());
  check(std::integral_constant<int, 2>());
  check(std::integral_constant<int, 3>());
}

TEST(NodeNumbers, APointOnALineOfTheInnerGridHasOneNumberFromBothSides) {
  // The numbers of points are looked up by cells of 1e-6: walk through several of them in steps below the tolerance.
  for (double x = 0; x < 3e-6; x += 1e-9) {
    PointNumbers<1> numbers;
    const auto at = [](double value) { return Eigen::Matrix<double, 1, 1>(value); };
    EXPECT_EQ(numbers.number(at(x)), numbers.number(at(x + 5e-11)));
    EXPECT_EQ(numbers.number(at(x)), numbers.number(at(x - 5e-11)));
  }
}

TEST(NodeNumbers, ACubeOfElementsFractionsItsFaces) {
  // n^3 elements of degree p have (n p + 1)^3 nodes.
  constexpr int n = 3, p = 4, nodes = p + 1;
  const auto numbers = number_nodes<3>(n * n * n, nodes * nodes * nodes, [&](int e, int k) -> Eigen::Vector3d {
    const Eigen::Vector3d corner(e % n, e / n % n, e / (n * n)),
        inner(k % nodes, k / nodes % nodes, k / (nodes * nodes));
    return (corner + inner / p) / 7;
  });
  EXPECT_EQ(numbers.count, (n * p + 1) * (n * p + 1) * (n * p + 1));
}

}  // namespace
}  // namespace rheocyte::node_numbers_test
