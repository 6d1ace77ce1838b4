// Integrals of the weak forms over one hexahedron: residual, and the exact tangent by dual numbers at each point and
// sums over one direction after the other.
#pragma once
#include "duct/duct_space.h"
#include "fem/element_integrals.h"
#include "fem/part_workspace.h"

namespace rheocyte {

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
  double spin = 0;  ///< of a cell off the axis on its way
};

/// Residual of one element in the order of its rows; `points` keeps the fluxes at the points and, if wanted, their
/// derivatives, and the least relative det of the map.
VectorXd integrate_hexahedron(const Hexahedron&, const Media&, const VectorXd& unknowns, Want, ElementSystem& points);

/// Adds the tangent of an element whose fluxes a workspace holds to the matrix there.
class HexahedronTangent {
 public:
  using Workspace = PartWorkspace<float>;

  /// Both must outlive this object.
  HexahedronTangent(const TensorElement& element, const ReferenceElement<3>& reference)
      : element_(element), element_modes_(reference.pressure.value) {}
  void add(const HexahedronUnknowns&, bool has_inertia, Workspace&) const;

 private:
  template <class Fields>
  void add_fields(const HexahedronUnknowns&, bool has_inertia, Workspace&) const;
  template <class Fields>
  void add_pressures(const HexahedronUnknowns&, Workspace&) const;

  const TensorElement& element_;
  const MatrixXd& element_modes_;
};

}  // namespace rheocyte
