// The nonlinear system of cell and liquid: residual, exact tangent, and its factorisation with the unknowns inside
// elements condensed (docs/theory.md, eq:condensation). What an element contributes, the derived systems say.
#pragma once
#include <Eigen/LU>
#include <optional>
#include <utility>

#include "fem/element_integrals.h"
#include "fem/nonlinear_system.h"
#include "fem/sparse_lu.h"
#include "fem/surface_integrals.h"

namespace rheocyte {

class CoupledSystem : public NonlinearSystem {
 public:
  ~CoupledSystem() override;

  const Discretisation& space() const { return space_; }

  VectorXd sphere() const override;
  VectorXd residual(const Media&, const VectorXd& unknowns, double& min_det) override;
  VectorXd linearise(const Media&, const VectorXd& unknowns, double& min_det, bool& factorised) override;
  VectorXd solve(const VectorXd& rhs) override;
  double cell_radius() const override;
  double largest_displacement(const VectorXd& unknowns) const override;
  void scale_displacement(double factor, VectorXd& unknowns) const override;
  /// Of the meridional stretch.
  double stretch_change(const VectorXd& from, const VectorXd& to) const override;
  /// Tangent times a vector at given unknowns (for tests; assembles anew).
  VectorXd apply_tangent(const Media&, const VectorXd& unknowns, const VectorXd& direction);

  /// Of the factors and tables that it holds, about.
  std::size_t memory_bytes() const;

 protected:
  /// Pressure at an open inlet that depends on the acceleration of the frame: fixed + slope * v_cell.
  struct InletPressure {
    double fixed = 0, slope = 0;
  };

  /// The discretisation must outlive this object. Which unknowns a column refers to stays as it is given here; factors
  /// and constants of the columns may change.
  CoupledSystem(const Discretisation&, std::vector<ElementUnknowns>);
  /// Reads the geometry anew after the discretisation was moved; which unknowns couple must be as before. The factors
  /// stay those of the old geometry.
  void follow_space(std::vector<ElementUnknowns>);
  /// Residual and, if wanted, tangent of one element that is not empty.
  virtual void integrate(int element, const Media&, const VectorXd& unknowns, Want, ElementSystem&) const = 0;
  /// Only for an open inlet.
  virtual InletPressure inlet_pressure(const Media&) const;

  std::vector<ElementUnknowns>& elements() { return elements_; }
  const std::vector<ElementUnknowns>& elements() const { return elements_; }

 private:
  struct Condensed;
  /// Cortex, volume of a pure shell, and barycentre.
  void add_surface(const Cortex&, const VectorXd& unknowns, Want, VectorXd& residual);
  /// Of the last liquid that was asked for: most have to integrate for it.
  double undisturbed_pressure(const Liquid&) const;
  /// Tractions of the open ends.
  void add_ends(const Media&, const VectorXd& unknowns, Want, VectorXd& residual);
  void condense(const ElementUnknowns&, Condensed&, const MatrixXd& tangent);

  const Discretisation& space_;
  std::vector<ElementUnknowns> elements_;
  SurfaceIntegrals surface_;
  std::vector<Condensed> condensed_;
  std::vector<std::vector<int>> surface_position_;  ///< in the sparse matrix, patch by patch: unknowns x unknowns
  mutable std::optional<std::pair<Liquid, double>> undisturbed_;
  std::vector<int> inlet_equation_;  ///< where the load of an open inlet is not zero
  std::vector<int> inlet_position_;  ///< of these equations' entries for v_cell in the sparse matrix
  std::unique_ptr<SparseMatrix> matrix_;
  std::unique_ptr<SparseLU> lu_;
  ElementSystem element_;
};

/// Of a system with axial symmetry.
inline const Discretisation& space_of(const NonlinearSystem& system) {
  return static_cast<const CoupledSystem&>(system).space();
}

}  // namespace rheocyte
