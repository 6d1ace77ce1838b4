#include "fem/located_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::located_points_test {
namespace {

/// A smooth map of space that bends straight elements; its det is positive for -1 <= x <= 2.
template <int dim>
Eigen::Matrix<double, dim, 1> bent(const Eigen::Matrix<double, dim, 1>& x) {
  Eigen::Matrix<double, dim, 1> y = x;
  for (int c = 0; c < dim; ++c) y(c) += 0.15 * std::sin(2 * x((c + 1) % dim));
  return y;
}

/// Unit elements side by side along the first coordinate, bent.
template <int dim>
std::vector<MatrixXd> bent_elements(const ReferenceElement<dim>& reference, int count) {
  const VectorXd& s = reference.nodes_1d;
  std::vector<MatrixXd> elements;
  for (int e = 0; e < count; ++e) {
    MatrixXd& nodes = elements.emplace_back(reference.nodes(), dim);
    for (int k = 0; k < reference.nodes(); ++k) {
      Eigen::Matrix<double, dim, 1> x;
      for (int c = 0, rest = k; c < dim; ++c, rest /= int(s.size())) x(c) = s(rest % int(s.size()));
      x(0) += e;
      nodes.row(k) = bent<dim>(x).transpose();
    }
  }
  return elements;
}

template <int dim>
void expect_points_are_found(int degree) {
  const ReferenceElement<dim> reference(degree);
  const auto elements = bent_elements<dim>(reference, 3);
  const LocatedPoints<dim> mesh(reference, elements);
  for (int i = 1; i <= 60; ++i) {
    Eigen::Matrix<double, dim, 1> xi;
    for (int c = 0; c < dim; ++c) xi(c) = 0.5 - 0.5 * std::cos(1.7 * i + c * 0.9 * i);
    const int e = i % 3;
    Eigen::Matrix<double, dim, 1> x;
    for (int c = 0; c < dim; ++c) x(c) = reference.interpolate(elements[std::size_t(e)].col(c), xi);
    const auto [element, at] = mesh.find(x);
    EXPECT_EQ(element, e);
    EXPECT_LT((at - xi).norm(), 1e-9);
  }
}

TEST(LocatedPoints, ThoseOfCurvedElementsAreFound) {
  expect_points_are_found<2>(3);
  expect_points_are_found<2>(6);
  expect_points_are_found<3>(3);
}

TEST(LocatedPoints, APointOutsideHasTheNearestPlace) {
  const ReferenceElement<2> reference(3);
  const auto elements = bent_elements<2>(reference, 2);
  const LocatedPoints<2> mesh(reference, elements);
  // Just outside the end of the second element, and far away.
  const auto just = mesh.find(bent<2>({2.001, 0.4}));
  EXPECT_EQ(just.element, 1);
  EXPECT_NEAR(just.xi(0), 1, 1e-12);
  EXPECT_NEAR(just.xi(1), 0.4, 1e-2);
  const auto far = mesh.find({-50, 0.5});
  EXPECT_EQ(far.element, 0);
  EXPECT_EQ(far.xi(0), 0);
}

}  // namespace
}  // namespace rheocyte::located_points_test
