#include "fem/assembled_system.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "numeric/no_value.h"

namespace rheocyte {

namespace {

/// Operations of a factorisation for each thread; with the integrals they take some milliseconds, far longer than its
/// start.
constexpr double flops_of_thread = 1e8;

}  // namespace

template <class Scalar>
VectorXd AssembledSystem<Scalar>::sphere() const {
  VectorXd unknowns = VectorXd::Zero(unknowns_);
  unknowns(cell_velocity_) = 1;
  return unknowns;
}

template <class Scalar>
Residual AssembledSystem<Scalar>::assemble(const Media& media, const VectorXd& unknowns, const UseTangent& use,
                                           int threads) {
  const At at{media, unknowns, use ? Want::residual_and_tangent : Want::residual};
  VectorXd total = loads(media, unknowns);
  struct OfPart {
    PartResidual residual;
    double min_det = std::numeric_limits<double>::infinity(), seconds = 0;
  };
  std::vector<OfPart> parts(lu_->elements().size());
  workspaces_.resize(std::max(workspaces_.size(), std::size_t(threads)));
  for (auto& workspace : workspaces_) workspace.place.resize(unknowns_, -1);
  Tasks tasks;
  const auto work_on = [&](int part, int thread) {
    if (use && limits_.is_stopped()) return;
    PartWorkspace<Scalar>& workspace = workspaces_[thread];
    const std::vector<int>& order = lu_->order(part);
    {
      const Stopwatch watch(parts[part].seconds);
      if (use) {
        workspace.matrix.setZero(Eigen::Index(order.size()), Eigen::Index(order.size()));
        for (int i = 0; i < int(order.size()); ++i) workspace.place[order[i]] = i;
      }
      parts[part].min_det = add_part(part, at, parts[part].residual, workspace);
    }
    if (use) use(part, order, workspace.matrix, tasks);
  };
  for (const int part : lu_->elements()) {
    tasks.add(NestedLU<Scalar>::rank_of_elements, [&work_on, part](int thread) { work_on(part, thread); });
  }
  tasks.run(threads);
  double min_det = std::numeric_limits<double>::infinity(), seconds = 0;
  for (const int part : lu_->elements()) {
    parts[part].residual.add_to(total);
    min_det = std::min(min_det, parts[part].min_det);
    seconds += parts[part].seconds;
  }
  work_.assembly_s += seconds;
  work_.factorisation_s += tasks.seconds() - seconds;
  finish(unknowns, total);
  return {std::move(total), min_det};
}

template <class Scalar>
int AssembledSystem<Scalar>::worthwhile_threads() const {
  return std::max(1, int(std::min(double(limits_.threads), lu_->flops() / flops_of_thread)));
}

template <class Scalar>
Residual AssembledSystem<Scalar>::residual(const Media& media, const VectorXd& unknowns) {
  return assemble(media, unknowns, {}, worthwhile_threads());
}

template <class Scalar>
Residual AssembledSystem<Scalar>::linearise(const Media& media, const VectorXd& unknowns) {
  const auto condense = [this](int part, const std::vector<int>&, const Matrix& tangent, Tasks& tasks) {
    lu_->condense(part, tangent, tasks, limits_.stop);
  };
  ++work_.factorisations;
  has_factors_ = false;
  Residual residual;
  try {
    residual = assemble(media, unknowns, condense, worthwhile_threads());
  } catch (...) {
    drop_factors();
    throw;
  }
  if (limits_.is_stopped()) {
    drop_factors();
    residual.value.setConstant(no_value);
  }
  has_factors_ = residual.value.allFinite() && lu_->is_regular();
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
  assert(unknowns_ == other.unknowns_ && lu_->elements().size() == other.lu_->elements().size());
  std::swap(lu_, other.lu_);
  std::swap(has_factors_, other.has_factors_);
}

template <class Scalar>
VectorXd AssembledSystem<Scalar>::apply_tangent(const Media& media, const VectorXd& unknowns,
                                                const VectorXd& direction) {
  VectorXd product = VectorXd::Zero(unknowns.size());
  const auto apply = [&](int, const std::vector<int>& order, const Matrix& tangent, Tasks&) {
    product(order) += tangent.template cast<double>() * direction(order);
  };
  assemble(media, unknowns, apply, 1);
  return product;
}

template class AssembledSystem<float>;
template class AssembledSystem<double>;

}  // namespace rheocyte
