#include "fem/nested_lu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fem/triangular_solve.h"

namespace rheocyte::nested_lu_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A grid of quadrilateral elements with two unknowns at each corner, one pressure each, and one unknown of all.
struct Grid {
  int nx, ny, unknowns;
  std::vector<CoupledUnknowns> elements;

  Grid(int columns, int rows) : nx(columns), ny(rows), unknowns(2 * (nx + 1) * (ny + 1) + nx * ny + 1) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        CoupledUnknowns& element = elements.emplace_back();
        for (const int node :
             {i + (nx + 1) * j, i + 1 + (nx + 1) * j, i + (nx + 1) * (j + 1), i + 1 + (nx + 1) * (j + 1)})
          element.unknowns.insert(element.unknowns.end(), {2 * node, 2 * node + 1});
        element.pressure = 2 * (nx + 1) * (ny + 1) + i + nx * j;
        element.unknowns.push_back(element.pressure);
        element.unknowns.push_back(unknowns - 1);
        if (i > 0) element.neighbours.push_back(i - 1 + nx * j);
        if (i + 1 < nx) element.neighbours.push_back(i + 1 + nx * j);
        if (j > 0) element.neighbours.push_back(i + nx * (j - 1));
        if (j + 1 < ny) element.neighbours.push_back(i + nx * (j + 1));
      }
    }
  }
};

/// Random matrices of the elements, not symmetric, dominant enough for every part to be regular; their sum; and a
/// right-hand side.
template <class Scalar>
struct RandomSystem {
  Grid grid{5, 4};
  NestedLU<Scalar> lu{grid.unknowns, grid.elements};
  std::vector<Eigen::MatrixX<Scalar>> matrices;
  MatrixXd whole = MatrixXd::Zero(grid.unknowns, grid.unknowns);
  VectorXd rhs;

  RandomSystem() {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto random = [&](double) { return uniform(engine); };
    for (int e = 0; e < int(grid.elements.size()); ++e) {
      const std::vector<int>& order = lu.order(e);
      EXPECT_EQ(order.size(), grid.elements[e].unknowns.size());
      const MatrixXd matrix = MatrixXd::Zero(order.size(), order.size()).unaryExpr(random);
      matrices.push_back(matrix.cast<Scalar>());
      matrices.back().diagonal().array() += 5;
      whole(order, order) += matrices.back().template cast<double>();
    }
    rhs = VectorXd::Zero(grid.unknowns).unaryExpr(random);
    condense();
    EXPECT_TRUE(lu.is_regular());
  }
  void condense() {
    for (std::size_t e = 0; e < matrices.size(); ++e) lu.condense(int(e), matrices[e]);
  }
};

TEST(NestedLU, SolvesTheSumOfTheElementsMatricesAndCorrectionsMakeUpForSinglePrecision) {
  const RandomSystem<float> system;
  const auto& [grid, lu, matrices, whole, rhs] = system;
  // The matrix itself has single precision here. Rounding of a hundred unknowns: in single precision, then in double.
  VectorXd x = lu.solve(rhs);
  EXPECT_LT((whole * x - rhs).norm(), 3e-6 * rhs.norm());
  for (int i = 0; i < 2; ++i) x += lu.solve(rhs - whole * x);
  EXPECT_LT((whole * x - rhs).norm(), 1e-13 * rhs.norm());
  // However small the right-hand side is.
  EXPECT_LT((lu.solve(1e-60 * rhs) - 1e-60 * lu.solve(rhs)).norm(), 3e-6 * 1e-60 * x.norm());
}

TEST(NestedLU, InDoublePrecisionNothingIsLeftToCorrect) {
  const RandomSystem<double> system;
  EXPECT_LT((system.whole * system.lu.solve(system.rhs) - system.rhs).norm(), 1e-14 * system.rhs.norm());
}

TEST(NestedLU, NumbersThatAreNotFiniteAreReportedAndTheNextGoodOnesFactoriseAgain) {
  RandomSystem<double> system;
  const double good = system.matrices[3](0, 0);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    system.matrices[3](0, 0) = bad;
    system.condense();
    EXPECT_FALSE(system.lu.is_regular()) << bad;
  }
  system.matrices[3](0, 0) = good;
  system.condense();
  EXPECT_TRUE(system.lu.is_regular());
  EXPECT_LT((system.whole * system.lu.solve(system.rhs) - system.rhs).norm(), 1e-14 * system.rhs.norm());
}

TEST(NestedLU, TriangularFactorsAreSolvedBlockByBlock) {
  // Sizes below, at and between multiples of a block; against substitution in double precision.
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const int n : {1, 31, 32, 33, 100}) {
    MatrixXd factors = MatrixXd::Zero(n, n).unaryExpr([&](double) { return uniform(engine) / n; });
    factors.diagonal().array() += 2;
    const MatrixXd columns = MatrixXd::Zero(n, 5).unaryExpr([&](double) { return uniform(engine); });
    MatrixXd expected = columns;
    factors.triangularView<Eigen::UnitLower>().solveInPlace(expected);
    factors.triangularView<Eigen::Upper>().solveInPlace(expected);
    Eigen::MatrixXf solved = columns.cast<float>();
    const Eigen::MatrixXf single = factors.cast<float>();
    TriangularFactors<float>(single).solve_in_place(solved);
    EXPECT_LT((solved.cast<double>() - expected).norm(), 1e-6 * expected.norm()) << n;
  }
}

TEST(NestedLU, AZeroMatrixIsNotFactorised) {
  const Grid grid(2, 2);
  NestedLU<float> lu(grid.unknowns, grid.elements);
  for (int e = 0; e < 4; ++e) {
    Eigen::MatrixXf matrix = Eigen::MatrixXf::Zero(Eigen::Index(lu.order(e).size()), Eigen::Index(lu.order(e).size()));
    lu.condense(e, matrix);
  }
  EXPECT_FALSE(lu.is_regular());
}

TEST(NestedLU, GivesUpWhenItIsToStopAndBeginsAnew) {
  const Grid grid(3, 2);
  NestedLU<float> lu(grid.unknowns, grid.elements);
  const auto matrix_of = [&](int e) {
    const auto n = Eigen::Index(lu.order(e).size());
    return Eigen::MatrixXf(Eigen::MatrixXf::Identity(n, n));
  };
  std::atomic<bool> stop = false;
  for (const int e : lu.elements()) {
    stop = e == lu.elements().back();
    EXPECT_EQ(lu.condense(e, matrix_of(e), &stop), !stop);
  }
  lu.drop_factors();
  for (const int e : lu.elements()) EXPECT_TRUE(lu.condense(e, matrix_of(e)));
  ASSERT_TRUE(lu.is_regular());
  // As many elements meet at each unknown as its sum of ones says.
  VectorXd sums = VectorXd::Zero(grid.unknowns);
  for (const int e : lu.elements())
    for (const int unknown : lu.order(e)) sums(unknown) += 1;
  EXPECT_LT((lu.solve(sums) - VectorXd::Ones(grid.unknowns)).norm(), 1e-5) << "single precision";
}

TEST(NestedLU, CostsNoMoreThanSeparatorsOfAGrid) {
  // A dense matrix of all unknowns would take 2/3 n^3 operations; separators of a long grid take a small fraction of
  // it.
  const Grid grid(20, 4);
  const double n = grid.unknowns;
  EXPECT_LT(NestedLU<float>(grid.unknowns, grid.elements).flops(), 0.03 * 2 / 3 * n * n * n);
}

}  // namespace
}  // namespace rheocyte::nested_lu_test
