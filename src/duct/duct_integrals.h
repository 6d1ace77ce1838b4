// Integrals of the weak forms over one hexahedron: residual, and the exact tangent by dual numbers at each point and
// sums over one direction after the other.
#pragma once
#include "duct/duct_space.h"
#include "fem/element_integrals.h"
#include "fem/nested_lu.h"
#include "fem/tensor_tangent.h"

namespace rheocyte {

/// Values at the quadrature points of a hexahedron of the numbers of some fields, and the fluxes that they make; kept
/// between calls to save memory traffic.
struct HexahedronPoints {
  MatrixXd numbers;
  ElementSystem fluxes;
};

/// Local values of slots.
VectorXd values_of(const std::vector<Slot>&, const VectorXd& unknowns);

/// Where the nodes of an element are now: nodes x (x, y, z).
MatrixXd points_of_nodes(const DuctSpace&, int element, const VectorXd& unknowns);

/// Fields at the quadrature points: LiquidFields or CellFields as the element is, or the MapFields that both begin
/// with.
template <class Fields>
MatrixXd numbers_at_points(const DuctSpace&, const TensorElement&, int element, const VectorXd& unknowns);

/// An element to be integrated: as the space knows it, or as it is within a step in time.
struct Hexahedron {
  const DuctSpace& space;
  const TensorElement& element;
  int number;
  const HexahedronUnknowns& self;
};

/// Residual of one element in the order of its rows; `points` keeps fluxes and, if wanted, their derivatives, and the
/// least relative det of the map.
VectorXd integrate_hexahedron(const Hexahedron&, const Media&, const VectorXd& unknowns, Want,
                              HexahedronPoints& points);

/// Adds the tangent that `points` hold to a matrix whose rows and columns are numbered by `place`, unknown by unknown.
class HexahedronTangent {
 public:
  /// Both must outlive this object.
  HexahedronTangent(const TensorElement& element, const ReferenceElement<3>& reference)
      : element_(element), element_modes_(reference.pressure.value), tangent_(element) {}
  void add(const HexahedronUnknowns&, bool has_inertia, const HexahedronPoints&, const std::vector<int>& place,
           Eigen::MatrixXf& matrix);

 private:
  template <class Fields>
  void add_fields(const HexahedronUnknowns&, bool has_inertia, const HexahedronPoints&, const std::vector<int>& place,
                  Eigen::MatrixXf& matrix);
  template <class Fields>
  void add_pressures(const HexahedronUnknowns&, const HexahedronPoints&, const std::vector<int>& place,
                     Eigen::MatrixXf& matrix);

  const TensorElement& element_;
  const MatrixXd& element_modes_;
  TensorTangent tangent_;
};

}  // namespace rheocyte
