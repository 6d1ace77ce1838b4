#include "fem/sparse_lu.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace rheocyte {

SparseMatrix::SparseMatrix(int n, const std::vector<std::pair<int, int>>& entries) : size(n), column_start(n + 1, 0) {
  // Sorted into columns by counting, then each column by itself: entries repeat a dozen times.
  std::vector<int> first(n + 1, 0), rows(entries.size());
  for (const auto& [i, j] : entries) ++first[j + 1];
  for (int j = 0; j < n; ++j) first[j + 1] += first[j];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (const auto& [i, j] : entries) rows[next[j]++] = i;
  for (int j = 0; j < n; ++j) {
    const auto begin = rows.begin() + first[j], end = rows.begin() + first[j + 1];
    std::sort(begin, end);
    row.insert(row.end(), begin, std::unique(begin, end));
    column_start[j + 1] = int(row.size());
  }
  value.assign(row.size(), 0.0);
}

int SparseMatrix::position(int i, int j) const {
  const auto first = row.begin() + column_start[j], last = row.begin() + column_start[j + 1];
  const auto it = std::lower_bound(first, last, i);
  assert(it != last && *it == i);
  return int(it - row.begin());
}

void SparseMatrix::append_positions(const std::vector<int>& rows, const std::vector<int>& columns,
                                    std::vector<int>& positions) const {
  std::vector<int> place(size, -1);  // of each row in the present column
  for (const int j : columns) {
    for (int k = column_start[j]; k < column_start[j + 1]; ++k) place[row[k]] = k;
    for (const int i : rows) positions.push_back(place[i]);
  }
}

struct SparseLU::Factors {
  Eigen::SparseMatrix<double> values;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> lu;
};

SparseLU::SparseLU(const SparseMatrix& matrix) : matrix_(matrix), factors_(std::make_unique<Factors>()) {
  factors_->values =
      Eigen::Map<const Eigen::SparseMatrix<double>>(matrix.size, matrix.size, int(matrix.row.size()),
                                                    matrix.column_start.data(), matrix.row.data(), matrix.value.data());
  factors_->lu.analyzePattern(factors_->values);
}

SparseLU::~SparseLU() = default;

bool SparseLU::factorise() {
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::all_of(matrix_.value.begin(), matrix_.value.end(), finite)) return false;
  std::copy(matrix_.value.begin(), matrix_.value.end(), factors_->values.valuePtr());
  factors_->lu.factorize(factors_->values);
  return factors_->lu.info() == Eigen::Success;
}

Eigen::VectorXd SparseLU::solve(const Eigen::VectorXd& rhs) const { return factors_->lu.solve(rhs); }

double SparseLU::entries() const { return double(factors_->lu.nnzL()) + double(factors_->lu.nnzU()); }

}  // namespace rheocyte
