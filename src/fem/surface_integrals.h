// Integrals over the cell's surface: cortex, inner pressure and volume, barycentre (docs/theory.md, eq:surface).
#pragma once
#include "fem/element_integrals.h"
#include "laws/surface_form.h"

namespace rheocyte {

/// A part of the surface whose unknowns couple: an edge, or two edges that meet at a vertex. Local values are the
/// current coordinates x then r of its nodes (edge by edge), for an edge followed by inner pressure and velocity.
struct SurfacePatch {
  std::vector<int> unknowns;  ///< of each local value and of its equation, -1: fixed
  VectorXd rest;              ///< local values of the undeformed cell
};

class SurfaceIntegrals {
 public:
  /// The discretisation must outlive this object.
  explicit SurfaceIntegrals(const Discretisation&);

  /// Edges from front to rear, then the vertices between them.
  const std::vector<SurfacePatch>& patches() const { return patches_; }
  /// The first patches, those that have anything to integrate: without bending the vertices have nothing.
  int active(const Cortex&) const;
  /// Residual and tangent of a patch, rows and columns as its unknowns; `min_det` is left alone.
  void integrate(int patch, const Cortex&, const VectorXd& unknowns, Want, ElementSystem&) const;

 private:
  struct Table {
    MatrixXd inputs, tests;  ///< inputs of the form x local values, outputs of the form x local values
  };
  void tabulate();
  void integrate_edge(int edge, const Cortex&, const VectorXd& local, Want, ElementSystem&) const;
  void integrate_kink(const Cortex&, const VectorXd& local, Want, ElementSystem&) const;

  const Discretisation* space_;
  std::vector<SurfacePatch> patches_;
  std::vector<std::vector<SurfaceReference>> references_;  ///< edge by edge, at its quadrature points
  std::vector<Table> edge_;                                ///< at the quadrature points, the same for all edges
  MatrixXd kink_;                                          ///< inputs of the kink x local values
};

}  // namespace rheocyte
