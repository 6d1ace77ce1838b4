#include "population/likelihood_maximum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/dense_solve.h"

namespace rheocyte {
namespace {

constexpr int most_newton_steps = 100, most_halvings = 12;
constexpr double settled_gain = 1e-7;
/// Gains below this, in ln L: the observed information holds. With the right one the next gain is far smaller.
constexpr double near_gain = 2, slow_fraction = 0.2;
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

namespace {

/// The way of one search.
class Climb {
 public:
  Climb(const PopulationLikelihood& likelihood, const ParameterBounds& bounds, const HeldParameters& held,
        std::optional<LawMatrix>& information)
      : likelihood_(likelihood), bounds_(bounds), held_(held), information_(information) {}

  LikelihoodMaximum from(const LawVector& start) {
    at_.q = start.cwiseMax(bounds_.least).cwiseMin(bounds_.greatest);
    take(likelihood_.at(at_.q));
    for (int count = 0; count < most_newton_steps; ++count) {
      free_ = free_ones(at_, held_);
      if (free_.empty()) return ended(true);
      if (!find_step()) return ended(false);
      if (gain_ < settled_gain) return ended(true);
      // What no step betters any more is the maximum to rounding.
      if (!go()) return ended(gain_ < near_gain);
    }
    return ended(false);
  }

 private:
  LikelihoodMaximum& ended(bool is_found) {
    at_.is_found = is_found;
    return at_;
  }

  void take(const PopulationLikelihood::Value& value) {
    value_ = value;
    at_.log_likelihood = value.log_likelihood;
    at_.products = value.products;
    mark_bounds(at_, value.score, bounds_);
  }

  void step_by(const LawMatrix& curvature) {
    step_ = newton_step(curvature, value_.score, free_);
    gain_ = 0;
    for (Eigen::Index i = 0; i < step_.size(); ++i) gain_ += step_(i) * value_.score(free_[std::size_t(i)]) / 2;
  }

  /// False if there is none.
  bool find_step() {
    const double last_gain = gain_;
    if (information_) step_by(*information_);
    if (information_ && (step_.size() == 0 || gain_ >= near_gain || gain_ > slow_fraction * last_gain))
      information_.reset();
    if (!information_) {
      step_by(value_.products);
      if (step_.size() > 0 && gain_ < near_gain && gain_ >= settled_gain) step_by_information();
    }
    return step_.size() > 0 && step_.allFinite();
  }

  void step_by_information() {
    information_ = likelihood_.information(at_.q, difference_steps(value_.products));
    step_by(*information_);
    if (step_.size() > 0) return;
    information_.reset();
    step_by(value_.products);
  }

  /// False if no step along this way is better.
  bool go() {
    step_ *= std::min(1.0, longest_step / step_.cwiseAbs().maxCoeff());
    for (int halving = 0; halving < most_halvings; ++halving, step_ /= 2) {
      LawVector next = at_.q;
      for (std::size_t i = 0; i < free_.size(); ++i) next(free_[i]) += step_(Eigen::Index(i));
      next = next.cwiseMax(bounds_.least).cwiseMin(bounds_.greatest);
      const auto value = likelihood_.at(next);
      if (!(value.log_likelihood > at_.log_likelihood)) continue;
      at_.q = next;
      take(value);
      return true;
    }
    return false;
  }

  const PopulationLikelihood& likelihood_;
  const ParameterBounds& bounds_;
  const HeldParameters& held_;
  std::optional<LawMatrix>& information_;
  LikelihoodMaximum at_;
  PopulationLikelihood::Value value_;
  std::vector<int> free_;
  Eigen::VectorXd step_;
  double gain_ = std::numeric_limits<double>::infinity();
};

}  // namespace

LikelihoodMaximum maximise(const PopulationLikelihood& likelihood, const LawVector& start,
                           const ParameterBounds& bounds, const HeldParameters& held,
                           std::optional<LawMatrix>& information) {
  return Climb(likelihood, bounds, held, information).from(start);
}

}  // namespace rheocyte
