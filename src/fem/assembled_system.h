// One loop over the parts of a system in any dimension: residual, exact tangent, and its factorisation subdomain by
// subdomain (docs/theory.md, eq:condensation). What a part contributes, the derived systems say.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "fem/element_integrals.h"
#include "fem/nested_lu.h"
#include "fem/nonlinear_system.h"

namespace rheocyte {

template <class Scalar>
class AssembledSystem : public NonlinearSystem {
 public:
  using Matrix = Eigen::MatrixX<Scalar>;
  /// Is given the tangent of a part, with rows and columns in the order of these unknowns. False: no more is wanted.
  using UseTangent = std::function<bool(int part, const std::vector<int>& order, const Matrix& tangent)>;

  VectorXd sphere() const override;
  Residual residual(const Media&, const VectorXd& unknowns) override;
  Residual linearise(const Media&, const VectorXd& unknowns) override;
  VectorXd solve(const VectorXd& rhs) override;
  MatrixXd solve_columns(const MatrixXd& rhs) override;
  void drop_factors() override;
  /// The residual; the tangent, if it is used, is given part by part, and is the sum of these.
  Residual assemble(const Media&, const VectorXd& unknowns, const UseTangent&);
  /// Tangent times a vector at given unknowns (for tests; assembles anew).
  VectorXd apply_tangent(const Media&, const VectorXd& unknowns, const VectorXd& direction);

  /// Of one factorisation of the linear system, and of the entries of its factors.
  double factorisation_flops() const { return lu_->flops(); }
  double factor_entries() const { return lu_->entries(); }

 protected:
  AssembledSystem(int unknowns, int cell_velocity) : cell_velocity_(cell_velocity), place_(unknowns, -1) {}
  /// The parts by the unknowns that they couple.
  void couple(const std::vector<CoupledUnknowns>& parts) {
    lu_ = std::make_unique<NestedLU<Scalar>>(int(place_.size()), parts);
  }
  const std::vector<int>& order(int part) const { return lu_->order(part); }
  std::size_t factor_bytes() const { return has_factors_ ? lu_->memory_bytes() : 0; }
  /// Of a system whose unknowns mean the same.
  void exchange_factors(AssembledSystem&);

  /// What does not belong to a part, at the beginning and at the end.
  virtual VectorXd loads(const Media&, const VectorXd& unknowns) = 0;
  virtual void finish(const VectorXd& /*unknowns*/, VectorXd& /*total*/) const {}
  /// Adds residual and, if wanted, tangent of a part; gives the least relative det of its mesh.
  virtual double add_part(int part, const Media&, const VectorXd& unknowns, Want, VectorXd& total) = 0;

  const std::vector<int>& place() const { return place_; }  ///< of each unknown in the matrix of the part at hand
  Matrix& matrix() { return matrix_; }                      ///< of that part

 private:
  int cell_velocity_;
  std::vector<int> place_;
  Matrix matrix_;
  std::unique_ptr<NestedLU<Scalar>> lu_;
};

}  // namespace rheocyte
