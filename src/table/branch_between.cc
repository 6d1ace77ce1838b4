#include "table/branch_between.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <span>

#include "numeric/dense_solve.h"
#include "numeric/lagrange.h"
#include "table/radius_branches.h"

namespace rheocyte {

namespace {

using Eigen::VectorXd;
using Branches = std::span<const SampledBranch* const>;

constexpr double small_height = 1e-4;  // step of differences along a branch

bool is_logarithmic(int measure) {
  return measure == int(Measure::deformation) || measure == int(Measure::deformation_raw);
}

double first_of(const SampledBranch& branch, Measure m) { return branch.at(0, m); }
double last_of(const SampledBranch& branch, Measure m) { return branch.at(branch.samples() - 1, m); }

/// Weights of the polynomial of two degrees less, on the branches in the middle; zero for the others.
std::vector<double> inner_weights(const std::vector<double>& places, double at) {
  if (places.size() < 4) return std::vector<double>(places.size(), 1.0 / double(places.size()));
  auto weights = lagrange_weights(std::span(places).subspan(1, places.size() - 2), at).value;
  weights.insert(weights.begin(), 0);
  weights.push_back(0);
  return weights;
}

std::vector<double> log_radii(Branches near) {
  std::vector<double> places;
  for (const auto* branch : near) places.push_back(std::log(branch->radius_um));
  return places;
}

/// ln(deformation) from which and up to which a branch takes part.
struct Heights {
  double first, last;
  double at(double fraction) const { return (1 - fraction) * first + fraction * last; }
  double fraction(double height) const { return (height - first) / (last - first); }
};

/// Where branches that cover the table's ranges are cut: all of them at one deformation or one area, whichever comes
/// first, because how far a sample lies beyond the ranges is accidental.
std::vector<double> ends_of_covered(const TableSpec& spec, Branches near) {
  double deformation = HUGE_VAL, area = HUGE_VAL;
  for (const auto* branch : near) {
    const bool leaves_by_deformation = last_of(*branch, Measure::deformation) > spec.max_deformation;
    const Measure m = leaves_by_deformation ? Measure::deformation : Measure::area_um2;
    double& limit = leaves_by_deformation ? deformation : area;
    limit = std::min(limit, last_of(*branch, m));
  }
  std::vector<double> ends;
  for (const auto* branch : near) {
    const double stiffness = stiffness_at(*branch, Measure::area_um2, area);
    const double last = std::isfinite(stiffness) ? interpolate(*branch, Measure::deformation, stiffness)
                                                 : last_of(*branch, Measure::deformation);
    ends.push_back(std::log(std::min(last, deformation)));
  }
  return ends;
}

/// Where other branches are cut. Their last states scatter before the physical end: a polynomial of half as many terms
/// as there are branches (least squares in ln(radius)), below all of them.
std::vector<double> smooth_ends(Branches near) {
  const Eigen::Index terms = std::min<Eigen::Index>(4, (std::ssize(near) + 1) / 2);
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(std::ssize(near), terms);
  VectorXd last(std::ssize(near));
  for (Eigen::Index k = 0; k < last.size(); ++k) {
    const double place = std::log(near[std::size_t(k)]->radius_um / near.front()->radius_um);
    for (Eigen::Index power = 1; power < terms; ++power) powers(k, power) = powers(k, power - 1) * place;
    last(k) = std::log(last_of(*near[std::size_t(k)], Measure::deformation));
  }
  const VectorXd smooth = powers * least_squares(powers, last);
  const VectorXd ends = smooth.array() + (last - smooth).minCoeff();
  return {ends.begin(), ends.end()};
}

std::vector<Heights> heights_of(const TableSpec& spec, Branches near) {
  const std::vector<double> ends =
      near.front()->end.status == Status::covered ? ends_of_covered(spec, near) : smooth_ends(near);
  double first = -HUGE_VAL;
  for (const auto* branch : near) first = std::max(first, first_of(*branch, Measure::deformation));
  std::vector<Heights> heights;
  for (std::size_t k = 0; k < near.size(); ++k) {
    const bool is_own = near[k]->bending_kBT == 0;
    heights.push_back({std::log(is_own ? first : first_of(*near[k], Measure::deformation)), ends[k]});
  }
  return heights;
}

double stiffness_at_height(const SampledBranch& branch, double height) {
  const double d = std::clamp(std::exp(height), first_of(branch, Measure::deformation),
                              std::max(last_of(branch, Measure::deformation), first_of(branch, Measure::deformation)));
  return stiffness_at(branch, Measure::deformation, d);
}

/// Everything that is interpolated, of the state of a branch at a height: ln(stiffness), measures, contour.
VectorXd state_at(const SampledBranch& branch, double height) {
  const double stiffness = stiffness_at_height(branch, height);
  if (!std::isfinite(stiffness)) return {};
  const Eigen::MatrixX2d contour = interpolate_contour(branch, stiffness);
  VectorXd state(1 + measure_count + contour.size());
  state << std::log(stiffness), interpolate(branch, stiffness), contour.reshaped();
  for (int m = 0; m < measure_count; ++m)
    if (is_logarithmic(m)) state(1 + m) = std::log(state(1 + m));
  return state;
}

/// The fractions of the samples of a branch, and those in their middles.
std::vector<double> fractions_of(const SampledBranch& branch, const Heights& heights) {
  std::vector<double> samples{0}, fractions;
  for (int i = 0; i < branch.samples(); ++i) {
    const double fraction = heights.fraction(std::log(branch.at(i, Measure::deformation)));
    if (fraction > samples.back() + 1e-3 && fraction < 1 - 1e-3) samples.push_back(fraction);
  }
  samples.push_back(1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    fractions.push_back(samples[i]);
    fractions.push_back((samples[i] + samples[i + 1]) / 2);
  }
  fractions.push_back(1);
  return fractions;
}

/// Branches on their way to the one between them.
class Between {
 public:
  Between(const TableSpec& spec, Branches near, double radius_um) : near_(near), heights_(heights_of(spec, near)) {
    const std::vector<double> places = log_radii(near);
    weights_ = lagrange_weights(places, std::log(radius_um)).value;
    inner_weights_ = inner_weights(places, std::log(radius_um));
    branch_.radius_um = radius_um;
    branch_.bending_kBT = near.front()->bending_kBT;
  }

  SampledBranch branch() && {
    const auto by_distance = [&](const SampledBranch* b) { return std::abs(b->radius_um - branch_.radius_um); };
    const auto nearest = std::ranges::min_element(near_, {}, by_distance) - near_.begin();
    const auto fractions = fractions_of(*near_[std::size_t(nearest)], heights_[std::size_t(nearest)]);
    const int n = int(fractions.size());
    branch_.value.resize(n, measure_count);
    branch_.slope.resize(n, measure_count);
    for (int i = 0; i < n; ++i)
      if (!add(i, fractions[std::size_t(i)])) return {};
    branch_.end = near_[std::size_t(nearest)]->end;
    return std::move(branch_);
  }

 private:
  /// By polynomials across the branches; empty if one of them has no such state.
  VectorXd state(double fraction, const std::vector<double>& weights) const {
    VectorXd sum;
    for (std::size_t k = 0; k < near_.size(); ++k) {
      const VectorXd one = state_at(*near_[k], heights_[k].at(fraction));
      if (one.size() == 0) return {};
      if (k == 0) sum.setZero(one.size());
      sum += weights[k] * one;
    }
    return sum;
  }

  bool add(int i, double fraction) {
    const double low = std::max(fraction - small_height, 0.0), high = std::min(fraction + small_height, 1.0);
    const VectorXd here = state(fraction, weights_), below = state(low, weights_), above = state(high, weights_),
                   inner = state(fraction, inner_weights_);
    if (here.size() == 0 || below.size() == 0 || above.size() == 0) return false;
    const VectorXd slope = (above - below) / (above(0) - below(0));  // d/d ln(stiffness)
    if (!slope.allFinite()) return false;
    if (i > 0 && !(std::exp(here(0)) < branch_.stiffness.back())) return false;
    branch_.stiffness.push_back(std::exp(here(0)));
    for (int m = 0; m < measure_count; ++m) {
      const double value = is_logarithmic(m) ? std::exp(here(1 + m)) : here(1 + m);
      branch_.value(i, m) = value;
      branch_.slope(i, m) = is_logarithmic(m) ? value * slope(1 + m) : slope(1 + m);
    }
    const Eigen::Index points = (here.size() - 1 - measure_count) / 2;
    branch_.contour.push_back(here.tail(2 * points).reshaped(points, 2));
    branch_.contour_slope.push_back(slope.tail(2 * points).reshaped(points, 2));
    branch_.error.push_back(error_at(fraction) + std::abs((here(0) - inner(0)) * slope(1 + int(Measure::deformation))));
    return true;
  }

  /// Of the states that are interpolated.
  double error_at(double fraction) const {
    double error = 0;
    for (std::size_t k = 0; k < near_.size(); ++k) {
      if (weights_[k] < 0.5 / double(near_.size())) continue;  // the nearest ones
      const VectorXd one = state_at(*near_[k], heights_[k].at(fraction));
      error = std::max(error, point_at(*near_[k], std::exp(one(0))).error);
    }
    return error;
  }

  Branches near_;
  std::vector<Heights> heights_;
  std::vector<double> weights_, inner_weights_;
  SampledBranch branch_;
};

}  // namespace

std::string family_of(const SampledBranch& branch) {
  return branch.empty() ? "empty" : std::string(name(branch.end.status));
}

SampledBranch branch_between(const TableSpec& spec, Branches near, double radius_um) {
  assert(near.size() >= 2);
  return Between(spec, near, radius_um).branch();
}

BranchDifference difference(const TableSpec& spec, Branches near, const SampledBranch& computed) {
  const std::vector<double> weights = lagrange_weights(log_radii(near), std::log(computed.radius_um)).value;
  const std::vector<Heights> heights = heights_of(spec, near);
  Heights predicted{0, 0};
  for (std::size_t k = 0; k < near.size(); ++k) {
    predicted.first += weights[k] * heights[k].first;
    predicted.last += weights[k] * heights[k].last;
  }
  BranchDifference off;
  for (int i = 0; i < computed.samples(); ++i) {
    const double fraction = predicted.fraction(std::log(computed.at(i, Measure::deformation)));
    if (fraction < 0 || fraction > 1) continue;
    double log_stiffness = 0;
    for (std::size_t k = 0; k < near.size(); ++k)
      log_stiffness += weights[k] * std::log(stiffness_at_height(*near[k], heights[k].at(fraction)));
    off.stiffness = std::max(off.stiffness, std::abs(std::exp(log_stiffness) / computed.stiffness[std::size_t(i)] - 1));
  }
  if (computed.end.status != Status::covered)
    off.end = std::abs(std::exp(predicted.last) / last_of(computed, Measure::deformation) - 1);
  return off;
}

}  // namespace rheocyte
