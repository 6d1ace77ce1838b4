// One loop over the parts of a system in any dimension: residual, exact tangent, and its factorisation subdomain by
// subdomain (docs/theory.md, eq:condensation). What a part contributes, the derived systems say.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "fem/nested_lu.h"
#include "fem/nonlinear_system.h"
#include "fem/part_workspace.h"

namespace rheocyte {

template <class Scalar>
class AssembledSystem : public NonlinearSystem {
 public:
  using Matrix = Eigen::MatrixX<Scalar>;
  VectorXd sphere() const override;
  Residual residual(const Media&, const VectorXd& unknowns) override;
  Residual linearise(const Media&, const VectorXd& unknowns) override;
  VectorXd solve(const VectorXd& rhs) override;
  MatrixXd solve_columns(const MatrixXd& rhs) override;
  void drop_factors() override;
  /// Tangent times a vector at given unknowns (for tests; assembles again).
  VectorXd apply_tangent(const Media&, const VectorXd& unknowns, const VectorXd& direction);

  /// How the linear system is factorised.
  const NestedLU<Scalar>& factors() const { return *lu_; }
  /// Of one factorisation of the linear system, and of the entries of its factors.
  double factorisation_flops() const { return lu_->flops(); }
  double factor_entries() const { return lu_->entries(); }

 protected:
  AssembledSystem(int unknowns, int cell_velocity) : cell_velocity_(cell_velocity), unknowns_(unknowns) {}
  /// The parts by the unknowns that they couple.
  void couple(const std::vector<CoupledUnknowns>& parts) { lu_ = std::make_unique<NestedLU<Scalar>>(unknowns_, parts); }
  const std::vector<int>& order(int part) const { return lu_->order(part); }
  std::size_t factor_bytes() const { return has_factors_ ? lu_->memory_bytes() : 0; }
  /// Of a system whose unknowns mean the same.
  void exchange_factors(AssembledSystem&);

  /// What does not belong to a part, at the beginning and at the end.
  virtual VectorXd loads(const Media&, const VectorXd& unknowns) = 0;
  virtual void finish(const VectorXd& /*unknowns*/, VectorXd& /*total*/) const {}
  /// Where and for what parts are integrated.
  struct At {
    const Media& media;
    const VectorXd& unknowns;
    Want want;
  };
  /// Adds residual and, if requested, tangent of a part, this to the workspace's matrix; gives the least relative det
  /// of its mesh. For several threads at once.
  virtual double add_part(int part, const At&, PartResidual&, PartWorkspace<Scalar>&) const = 0;

 private:
  /// Is given the tangent of a part, with rows and columns in the order of these unknowns, and the tasks of all.
  using UseTangent = std::function<void(int part, const std::vector<int>& order, const Matrix& tangent, Tasks&)>;
  /// The residual; the tangent, if it is used, is given part by part, and is the sum of these.
  Residual assemble(const Media&, const VectorXd& unknowns, const UseTangent&, int threads);
  int worthwhile_threads() const;

  int cell_velocity_, unknowns_;
  std::vector<PartWorkspace<Scalar>> workspaces_{1};  ///< by threads
  std::unique_ptr<NestedLU<Scalar>> lu_;
};

}  // namespace rheocyte
