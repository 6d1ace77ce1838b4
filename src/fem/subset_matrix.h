// The linear system of the velocities and pressures of cell or liquid alone, those of the other being known.
#pragma once
#include "fem/element_places.h"
#include "fem/nested_lu.h"

namespace rheocyte {

class SubsetMatrix {
 public:
  /// Unknowns of the subset are all columns of these elements but positions of the liquid and v_cell; in the cell
  /// velocities stand in the places of displacements.
  SubsetMatrix(const Discretisation&, bool liquid);

  /// The tangent of an element of the subset, each of which has to be given once.
  void add(int element, const MatrixXd& tangent);
  /// Once all are given: whether the matrix is finite and regular.
  bool is_regular() const { return lu_->is_regular(); }
  /// Solves for the subset; the other entries of the result are zero, those of the right-hand side are ignored.
  VectorXd solve(const VectorXd& rhs) const;

 private:
  std::vector<const ElementUnknowns*> elements_;
  std::vector<int> number_;  ///< of each element of the space in the subset, -1: not in it
  std::vector<int> members_;
  std::vector<ElementPlaces> places_;
  std::unique_ptr<NestedLU<double>> lu_;
};

}  // namespace rheocyte
