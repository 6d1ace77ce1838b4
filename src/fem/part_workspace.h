// What the work on one part of a system needs. Each thread has its own.
#pragma once
#include <utility>
#include <vector>

#include "fem/element_integrals.h"
#include "fem/tensor_tangent.h"

namespace rheocyte {

/// What a part adds to the residual of all equations, in the order in which it is to be added: so the sum of all parts
/// does not depend on which of them was computed first.
class PartResidual {
 public:
  void clear() { terms_.clear(); }
  /// Rows below zero have no equation.
  void add(int row, double value) {
    if (row >= 0) terms_.emplace_back(row, value);
  }
  void add_to(VectorXd& total) const {
    for (const auto& [row, value] : terms_) total(row) += value;
  }

 private:
  std::vector<std::pair<int, double>> terms_;
};

/// Kept from part to part to save memory traffic.
template <class Scalar>
struct PartWorkspace {
  std::vector<int> place;          ///< of each unknown in the matrix of the part at hand
  Eigen::MatrixX<Scalar> matrix;   ///< of that part
  ElementSystem element, surface;  ///< integrals over the part's element and over patches of the surface
  TensorTangent tensor;
};

}  // namespace rheocyte
