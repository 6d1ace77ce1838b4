#include "fem/sparse_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

namespace rheocyte::sparse_lu_test {
namespace {

/// A band with some far entries, symmetric in pattern, not in value.
SparseMatrix random_matrix(int n) {
  std::vector<std::pair<int, int>> entries;
  for (int i = 0; i < n; ++i) {
    for (const int j : {i, (i + 1) % n, (i + 17) % n}) {
      entries.emplace_back(i, j);
      entries.emplace_back(j, i);
    }
  }
  SparseMatrix matrix(n, entries);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& value : matrix.value) value = uniform(engine);
  for (int i = 0; i < n; ++i) matrix.value[matrix.position(i, i)] += 4;
  return matrix;
}

Eigen::MatrixXd dense(const SparseMatrix& matrix) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(matrix.size, matrix.size);
  for (int j = 0; j < matrix.size; ++j) {
    for (int k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k) A(matrix.row[k], j) = matrix.value[k];
  }
  return A;
}

TEST(SparseMatrix, RepeatedEntriesAreStoredOnceInOrder) {
  // Columns one after the other, rows ascending.
  const SparseMatrix matrix(3, {{2, 1}, {0, 1}, {2, 1}, {1, 2}, {0, 0}});
  EXPECT_EQ(matrix.column_start, (std::vector{0, 1, 3, 4}));
  EXPECT_EQ(matrix.row, (std::vector{0, 0, 2, 1}));
  EXPECT_EQ(matrix.position(2, 1), 2);
}

TEST(SparseLU, ItSolvesWhatADenseEliminationSolves) {
  // A x = b, twice with one ordering and new values.
  constexpr int n = 200;
  SparseMatrix matrix = random_matrix(n);
  SparseLU lu(matrix);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2);
  for (int pass = 0; pass < 2; ++pass) {
    ASSERT_TRUE(lu.factorise());
    // Diagonally dominant, so the condition number is below 10.
    EXPECT_LT((lu.solve(b) - dense(matrix).partialPivLu().solve(b)).norm(), 1e-13);
    for (double& value : matrix.value) value *= 1.5;
  }
  EXPECT_GT(lu.entries(), n);
}

TEST(SparseLU, ASingularMatrixIsReported) {
  // A row of zeros, and two equal rows.
  SparseMatrix zero_row = random_matrix(50);
  for (int k = 0; k < int(zero_row.row.size()); ++k) {
    if (zero_row.row[k] == 20) zero_row.value[k] = 0;
  }
  EXPECT_FALSE(SparseLU(zero_row).factorise());
  SparseMatrix equal(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  equal.value = {1, 1, 2, 2};
  EXPECT_FALSE(SparseLU(equal).factorise());
}

TEST(SparseLU, NumbersThatAreNotFiniteAreReported) {
  // NaN and infinity, before the elimination sees them; the next good values factorise again.
  SparseMatrix matrix = random_matrix(50);
  SparseLU lu(matrix);
  const double good = matrix.value[7];
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    matrix.value[7] = bad;
    EXPECT_FALSE(lu.factorise());
  }
  matrix.value[7] = good;
  EXPECT_TRUE(lu.factorise());
}

}  // namespace
}  // namespace rheocyte::sparse_lu_test
