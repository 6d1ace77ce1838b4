#include "fem/subset_matrix.h"

#include <algorithm>

namespace rheocyte {

SubsetMatrix::SubsetMatrix(const std::vector<ElementUnknowns>& elements, const std::vector<bool>& wanted) {
  std::vector<int> number(wanted.size(), -1);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    number[i] = int(members_.size());
    members_.push_back(int(i));
  }
  const auto number_of = [&](int unknown) { return unknown < 0 ? -1 : number[unknown]; };
  std::vector<std::pair<int, int>> entries;
  for (const ElementUnknowns& element : elements) {
    Pattern& pattern = patterns_.emplace_back();
    for (int i = 0; i < int(element.rows.size()); ++i) {
      if (number_of(element.rows[i]) >= 0) pattern.row_slot.push_back(i);
    }
    // The columns of positions are known in any splitting.
    for (int j = element.liquid ? 2 * element.position_columns : 0; j < int(element.columns.size()); ++j) {
      if (number_of(element.columns[j].unknown) >= 0) pattern.column_slot.push_back(j);
    }
    for (const int i : pattern.row_slot) {
      for (const int j : pattern.column_slot)
        entries.emplace_back(number_of(element.rows[i]), number_of(element.columns[j].unknown));
    }
  }
  matrix_ = std::make_unique<SparseMatrix>(int(members_.size()), entries);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    Pattern& pattern = patterns_[e];
    for (const int i : pattern.row_slot) {
      for (const int j : pattern.column_slot)
        pattern.position.push_back(
            matrix_->position(number_of(elements[e].rows[i]), number_of(elements[e].columns[j].unknown)));
    }
  }
  lu_ = std::make_unique<SparseLU>(*matrix_);
}

void SubsetMatrix::clear() { std::fill(matrix_->value.begin(), matrix_->value.end(), 0.0); }

void SubsetMatrix::add(int element, const MatrixXd& tangent) {
  const Pattern& pattern = patterns_[element];
  const int* position = pattern.position.data();
  for (const int i : pattern.row_slot) {
    for (const int j : pattern.column_slot) matrix_->value[*position++] += tangent(i, j);
  }
}

VectorXd SubsetMatrix::solve(const VectorXd& rhs) const {
  const VectorXd solution = lu_->solve(rhs(members_));
  VectorXd result = VectorXd::Zero(rhs.size());
  result(members_) = solution;
  return result;
}

}  // namespace rheocyte
