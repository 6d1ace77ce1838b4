// The nonlinear system of cell and liquid in a duct: residual, exact tangent, and its factorisation
// subdomain by subdomain (docs/theory-square.md).
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "duct/duct_cortex.h"
#include "duct/duct_integrals.h"
#include "duct/turning_surface.h"
#include "fem/nested_lu.h"
#include "fem/nonlinear_system.h"

namespace rheocyte {

class DuctSystem final : public NonlinearSystem {
 public:
  /// Is given the tangent of an element, with rows and columns in the order of these unknowns.
  /// False: no more is wanted.
  using UseTangent = std::function<bool(int part, const std::vector<int>& order, Eigen::MatrixXf& tangent)>;

  /// The space must outlive this object. Where the pressure drop is given, it is `drop` times that of the undisturbed
  /// flow at mean speed 1. A cortex with bending stiffness is for systems that bend.
  explicit DuctSystem(const DuctSpace&, double drop = 1, bool bends = false);

  const DuctSpace& space() const { return space_; }
  const TensorElement& element() const { return element_; }

  VectorXd sphere() const override;
  /// The residual; the tangent, if it is used, is given element by element, and is the sum of these.
  Residual assemble(const Media&, const VectorXd& unknowns, const UseTangent&);
  Residual residual(const Media&, const VectorXd& unknowns) override;
  Residual linearise(const Media&, const VectorXd& unknowns) override;
  VectorXd solve(const VectorXd& rhs) override;
  double cell_radius() const override { return space_.mesh().geometry().radius(); }
  double largest_displacement(const VectorXd& unknowns) const override;
  void scale_displacement(double factor, VectorXd& unknowns) const override;
  double stretch_change(const VectorXd& from, const VectorXd& to) const override;

  double drop() const { return drop_; }
  /// Pressure gradient of the liquid's undisturbed flow at mean speed 1.
  double undisturbed_gradient(const Liquid&) const;
  /// Of one factorisation of the linear system, and of the entries of its factors.
  double factorisation_flops() const { return lu_.flops(); }
  double factor_entries() const { return lu_.entries(); }
  std::size_t memory_bytes() const override { return has_factors_ ? lu_.memory_bytes() : 0; }
  /// Gives the factors to a system whose unknowns mean the same, for chord steps there, and takes the other's.
  void exchange_factors(DuctSystem&);
  void drop_factors() override;

 private:
  /// Of the patches of the surface that an element has a share in.
  void add_cortex(int element, const Cortex&, const VectorXd& unknowns, Want, VectorXd& total);

  const DuctSpace& space_;
  double drop_;
  TensorElement element_;
  HexahedronTangent tangent_;
  DuctCortex cortex_;
  std::vector<int> filled_;  ///< elements that are not empty: the parts of the factorisation
  NestedLU<float> lu_;
  VectorXd outlet_load_, inlet_load_;
  mutable std::optional<std::pair<Liquid, double>> undisturbed_;
  TurningSurface turning_;
  HexahedronPoints points_;
  PatchSystem patch_;
  Eigen::MatrixXf matrix_;  ///< of an element
  std::vector<int> place_;  ///< of each unknown in the matrix of an element
};

}  // namespace rheocyte
