#include "fem/assembled_system.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "numeric/no_value.h"

namespace rheocyte {

template <class Scalar>
VectorXd AssembledSystem<Scalar>::sphere() const {
  VectorXd unknowns = VectorXd::Zero(Eigen::Index(place_.size()));
  unknowns(cell_velocity_) = 1;
  return unknowns;
}

template <class Scalar>
Residual AssembledSystem<Scalar>::assemble(const Media& media, const VectorXd& unknowns, const UseTangent& use) {
  const Want want = use ? Want::residual_and_tangent : Want::residual;
  VectorXd total = loads(media, unknowns);
  double min_det = std::numeric_limits<double>::infinity();
  for (const int part : lu_->elements()) {
    const std::vector<int>& order = lu_->order(part);
    {
      const Stopwatch watch(work_.assembly_s);
      if (use) {
        matrix_.setZero(Eigen::Index(order.size()), Eigen::Index(order.size()));
        for (int i = 0; i < int(order.size()); ++i) place_[order[i]] = i;
      }
      min_det = std::min(min_det, add_part(part, media, unknowns, want, total));
    }
    if (!use) continue;
    const Stopwatch watch(work_.factorisation_s);
    if (!use(part, order, matrix_)) return {VectorXd::Constant(total.size(), no_value), min_det};
  }
  finish(unknowns, total);
  return {std::move(total), min_det};
}

template <class Scalar>
Residual AssembledSystem<Scalar>::residual(const Media& media, const VectorXd& unknowns) {
  return assemble(media, unknowns, {});
}

template <class Scalar>
Residual AssembledSystem<Scalar>::linearise(const Media& media, const VectorXd& unknowns) {
  const auto condense = [this](int part, const std::vector<int>&, const Matrix& tangent) {
    return lu_->condense(part, tangent, stop_);
  };
  Residual residual = assemble(media, unknowns, condense);
  const bool is_stopped = stop_ && *stop_;
  if (is_stopped) drop_factors();
  has_factors_ = !is_stopped && residual.value.allFinite() && lu_->is_regular();
  ++work_.factorisations;
  return residual;
}

template <class Scalar>
VectorXd AssembledSystem<Scalar>::solve(const VectorXd& rhs) {
  const Stopwatch watch(work_.substitution_s);
  return lu_->solve(rhs);
}

template <class Scalar>
MatrixXd AssembledSystem<Scalar>::solve_columns(const MatrixXd& rhs) {
  const Stopwatch watch(work_.substitution_s);
  return lu_->solve_columns(rhs);
}

template <class Scalar>
void AssembledSystem<Scalar>::drop_factors() {
  lu_->drop_factors();
  has_factors_ = false;
}

template <class Scalar>
void AssembledSystem<Scalar>::exchange_factors(AssembledSystem& other) {
  assert(place_.size() == other.place_.size() && lu_->elements().size() == other.lu_->elements().size());
  std::swap(lu_, other.lu_);
  std::swap(has_factors_, other.has_factors_);
}

template <class Scalar>
VectorXd AssembledSystem<Scalar>::apply_tangent(const Media& media, const VectorXd& unknowns,
                                                const VectorXd& direction) {
  VectorXd product = VectorXd::Zero(unknowns.size());
  const auto apply = [&](int, const std::vector<int>& order, const Matrix& tangent) {
    product(order) += tangent.template cast<double>() * direction(order);
    return true;
  };
  assemble(media, unknowns, apply);
  return product;
}

template class AssembledSystem<float>;
template class AssembledSystem<double>;

}  // namespace rheocyte
