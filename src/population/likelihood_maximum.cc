#include "population/likelihood_maximum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/dense_solve.h"

namespace rheocyte {
namespace {

constexpr int most_newton_steps = 100, most_halvings = 12;
constexpr double settled_gain = 1e-5;
/// Gains below this, in ln L: the observed information holds.
constexpr double near_gain = 2;
/// Of each parameter at once.
constexpr double longest_step = 0.7;
/// A parameter with no curvature of its own has this one.
constexpr double least_curvature = 1e-6;

/// The parameters that move.
std::vector<int> free_ones(const LikelihoodMaximum& at, const HeldParameters& held) {
  std::vector<int> free;
  for (int k = 0; k < law_parameters; ++k)
    if (!held[std::size_t(k)] && !at.at_bound[std::size_t(k)]) free.push_back(k);
  return free;
}

/// Empty if the curvature is not positive.
Eigen::VectorXd newton_step(const LawMatrix& curvature, const LawVector& score, const std::vector<int>& free) {
  const Eigen::Index n = Eigen::Index(free.size());
  Eigen::MatrixXd part(n, n);
  Eigen::VectorXd slope(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    slope(i) = score(free[std::size_t(i)]);
    for (Eigen::Index j = 0; j < n; ++j) part(i, j) = curvature(free[std::size_t(i)], free[std::size_t(j)]);
    part(i, i) += least_curvature;
  }
  const Eigen::MatrixXd white = whitening(part);
  if (white.size() == 0) return {};
  return white.transpose() * (white * slope);
}

void mark_bounds(LikelihoodMaximum& at, const LawVector& score, const ParameterBounds& bounds) {
  for (int k = 0; k < law_parameters; ++k)
    at.at_bound[std::size_t(k)] = bounds.least(k) >= bounds.greatest(k) ||  // it has no choice
                                  (at.q(k) >= bounds.greatest(k) && score(k) > 0) ||
                                  (at.q(k) <= bounds.least(k) && score(k) < 0);
}

}  // namespace

LawVector difference_steps(const LawMatrix& products) {
  return 0.1 * products.diagonal().cwiseMax(1).cwiseSqrt().cwiseInverse();
}

LikelihoodMaximum maximise(const PopulationLikelihood& likelihood, const LawVector& start,
                           const ParameterBounds& bounds, const HeldParameters& held) {
  LikelihoodMaximum at;
  at.q = start.cwiseMax(bounds.least).cwiseMin(bounds.greatest);
  bool is_near = false;
  for (int count = 0; count < most_newton_steps; ++count) {
    const auto value = likelihood.at(at.q);
    at.log_likelihood = value.log_likelihood;
    mark_bounds(at, value.score, bounds);
    const std::vector<int> free = free_ones(at, held);
    if (free.empty()) return at.is_found = true, at;
    Eigen::VectorXd step;
    if (is_near) step = newton_step(likelihood.information(at.q, difference_steps(value.products)), value.score, free);
    if (step.size() == 0) step = newton_step(value.products, value.score, free);
    if (step.size() == 0 || !step.allFinite()) return at;
    double gain = 0;
    for (std::size_t i = 0; i < free.size(); ++i) gain += step(Eigen::Index(i)) * value.score(free[i]) / 2;
    if (gain < settled_gain) return at.is_found = true, at;
    is_near = gain < near_gain;
    step *= std::min(1.0, longest_step / step.cwiseAbs().maxCoeff());
    bool is_better = false;
    for (int halving = 0; halving < most_halvings && !is_better; ++halving, step /= 2) {
      LawVector next = at.q;
      for (std::size_t i = 0; i < free.size(); ++i) next(free[i]) += step(Eigen::Index(i));
      next = next.cwiseMax(bounds.least).cwiseMin(bounds.greatest);
      is_better = likelihood.log_likelihood(next) > at.log_likelihood;
      if (is_better) at.q = next;
    }
    // What no step betters any more is the maximum to rounding.
    if (!is_better) return at.is_found = gain < near_gain, at;
  }
  return at;
}

}  // namespace rheocyte
