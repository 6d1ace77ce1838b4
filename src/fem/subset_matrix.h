// A sparse linear system for some of the unknowns of a discretisation, the others being known.
#pragma once
#include <memory>
#include <vector>

#include "fem/discretisation.h"
#include "fem/sparse_lu.h"

namespace rheocyte {

class SubsetMatrix {
 public:
  /// `wanted[unknown]` says which belong to the subset; `elements` which of the elements couple them. Rows and columns
  /// of an element's matrix are its slots.
  SubsetMatrix(const std::vector<ElementUnknowns>& elements, const std::vector<bool>& wanted);

  void clear();
  void add(int element, const MatrixXd& tangent);
  bool factorise() { return lu_->factorise(); }
  /// Solves for the subset; the other entries of the result are zero, those of the right-hand side are ignored.
  VectorXd solve(const VectorXd& rhs) const;

 private:
  struct Pattern {
    std::vector<int> row_slot, column_slot;
    std::vector<int> position;  ///< in the sparse matrix: row_slot x column_slot
  };
  std::vector<int> members_;  ///< unknown of each number of the subset
  std::vector<Pattern> patterns_;
  std::unique_ptr<SparseMatrix> matrix_;
  std::unique_ptr<SparseLU> lu_;
};

}  // namespace rheocyte
