// Integrals of the weak forms over one element: residual, and the exact tangent by dual numbers at each point.
#pragma once
#include "fem/discretisation.h"
#include "laws/media.h"
#include "laws/weak_form.h"

namespace rheocyte {

/// Residual and tangent of one element; rows and columns are the element's slots. Kept between calls to save memory
/// traffic.
struct ElementSystem {
  VectorXd residual;
  MatrixXd tangent;
  double min_det = 0;  ///< least det of the element map relative to the undeformed one; <= 0: folded
  // scratch
  MatrixXd numbers, fluxes, flux_slopes, weighted, coefficients, sums;
};

enum class Want { residual, residual_and_tangent };

/// Local values of the element's column slots.
VectorXd local_values(const ElementUnknowns&, const VectorXd& unknowns);

/// Where the nodes of an element are now: nodes x (x, r).
MatrixXd points_of_nodes(const Discretisation&, int element, const VectorXd& unknowns);

/// Fields of a state at the quadrature points of an element: LiquidFields or CellFields as the element is, or the
/// MapFields that both begin with.
template <class Fields>
std::vector<Fields> fields_at_points(const Discretisation&, int e, const VectorXd& unknowns);

/// Integrates element `e` at the local values gathered from `unknowns`.
void integrate_element(const Discretisation&, int e, const Media&, const VectorXd& unknowns, Want, ElementSystem&);

}  // namespace rheocyte
