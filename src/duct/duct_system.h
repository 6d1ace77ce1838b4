// The nonlinear system of cell and liquid in a duct (docs/theory-square.md).
#pragma once
#include <optional>

#include "duct/duct_cortex.h"
#include "duct/duct_integrals.h"
#include "duct/turning_surface.h"
#include "fem/assembled_system.h"

namespace rheocyte {

class DuctSystem : public AssembledSystem<float> {
 public:
  /// The space must outlive this object. Where the pressure drop is given, it is `drop` times that of the undisturbed
  /// flow at mean speed 1. A cortex with bending stiffness is for systems that bend.
  explicit DuctSystem(const DuctSpace&, double drop = 1, bool bends = false);

  const DuctSpace& space() const { return space_; }
  const TensorElement& element() const { return element_; }

  double cell_radius() const override { return space_.mesh().geometry().radius(); }
  double largest_displacement(const VectorXd& unknowns) const override;
  void scale_displacement(double factor, VectorXd& unknowns) const override;
  double stretch_change(const VectorXd& from, const VectorXd& to) const override;

  double drop() const { return drop_; }
  /// At the inlet where it is open; the outlet has its negative: the undisturbed pressure vanishes at the cell.
  double inlet_pressure(const Liquid&) const;
  /// Pressure gradient of the liquid's undisturbed flow at mean speed 1.
  double undisturbed_gradient(const Liquid&) const;
  std::size_t memory_bytes() const override { return factor_bytes(); }
  /// Gives the factors to a system whose unknowns mean the same, for chord steps there, and takes the other's.
  using AssembledSystem::exchange_factors;

 protected:
  /// What an element knows, with the pressures of the same unknowns.
  virtual const HexahedronUnknowns& unknowns_of(int element) const { return space_.elements()[element]; }
  /// Of a cell off the axis: how its displacements change.
  void set_motion_of_surface(const Motion& motion) { turning_.set_motion(motion); }
  /// Those of the ends, after the space has moved its nodes.
  void renew_end_loads();

 private:
  VectorXd loads(const Media&, const VectorXd& unknowns) override;
  double add_part(int part, const At&, PartResidual&, PartWorkspace<float>&) const override;
  void finish(const VectorXd& unknowns, VectorXd& total) const override { turning_.add_residual(unknowns, total); }
  /// What the spin does in an element of the cell whose residual is known.
  void add_spin(Hexahedron, const At&, const VectorXd& residual, PartWorkspace<float>&) const;
  /// Of the patches of the surface that an element has a part in.
  void add_cortex(int element, const At&, PartResidual&, PartWorkspace<float>&) const;

  const DuctSpace& space_;
  double drop_;
  TensorElement element_;
  HexahedronTangent tangent_;
  DuctCortex cortex_;
  std::vector<int> filled_;  ///< elements that are not empty: the parts of the factorisation
  VectorXd outlet_load_, inlet_load_;
  mutable std::optional<std::pair<Liquid, double>> undisturbed_;
  TurningSurface turning_;
};

}  // namespace rheocyte
