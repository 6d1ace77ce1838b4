#include "infer/several_moduli.h"

#include <ceres/tiny_solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

constexpr int x_radius = int(CellCoordinate::log_radius), x_share = int(CellCoordinate::cortex_share),
              x_deformation = int(CellCoordinate::log_deformation), x_ratio = int(CellCoordinate::tension_ratio);
/// Cells whose misfits differ by less cannot be distinguished at 90 %.
constexpr double same_chi_squared = 2.7;
/// What is known before: an error of so many widths of the table's range. Keeps covariances finite.
constexpr double prior_widths = 3;
/// Beyond the table the features go straight on, and each of so many widths counts as one standard error.
constexpr double fence_widths = 0.2;

CellCoordinates widths(const CellBox& box) {
  const CellCoordinates range = box.greatest - box.least;
  return (range.array() > 0).select(range, CellCoordinates::Ones());
}

/// Residuals of the chosen features in standard errors, over the free coordinates; in the form that ceres::TinySolver
/// wants.
class Misfit {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, coordinate_count>;

  Misfit(const CombinedInterpolation& table, const MeasuredShape& shape, std::span<const int> features)
      : table_(table), features_(features), size_is_volume_(shape.size_is_volume) {
    const auto n = Eigen::Index(features.size());
    measured_.resize(n);
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const int f = features[std::size_t(i)];
      measured_(i) = shape.features(f) - shape.errors.bias(f);
      for (Eigen::Index k = 0; k < n; ++k) covariance(i, k) = shape.errors.covariance(f, features[std::size_t(k)]);
    }
    whitening_ = whitening(covariance);
  }

  bool is_usable() const { return measured_.allFinite() && whitening_.size() > 0; }
  int NumResiduals() const { return int(features_.size()) + coordinate_count; }
  int NumParameters() const { return int(free_.size()); }

  /// The coordinates that are fitted; the others stay as in `cell`.
  void set_free(std::vector<int> free, const CellCoordinates& cell) {
    free_ = std::move(free);
    cell_ = cell;
  }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    CellCoordinates cell = cell_;
    for (std::size_t i = 0; i < free_.size(); ++i) cell(free_[i]) = parameters[i];
    Jacobian all;
    Eigen::Map<Eigen::VectorXd>(residuals, NumResiduals()) = evaluate(cell, all);
    for (std::size_t i = 0; jacobian && i < free_.size(); ++i)
      Eigen::Map<Eigen::VectorXd>(jacobian + i * std::size_t(NumResiduals()), NumResiduals()) = all.col(free_[i]);
    return true;
  }

  /// Of the features, and behind them of the fence.
  Eigen::VectorXd evaluate(const CellCoordinates& cell, Jacobian& jacobian) const {
    const auto n = Eigen::Index(features_.size());
    const CellBox& box = table_.box();
    const CellCoordinates held = cell.cwiseMax(box.least).cwiseMin(box.greatest), beyond = cell - held;
    const CombinedState state = table_.at(held);
    Eigen::VectorXd residual(n + coordinate_count);
    jacobian = Jacobian::Zero(n + coordinate_count, coordinate_count);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto [value, gradient] = feature(features_[std::size_t(i)], held, state);
      residual(i) = value + gradient.dot(beyond) - measured_(i);
      jacobian.row(i) = gradient.transpose();
    }
    residual.head(n) = whitening_ * residual.head(n);
    jacobian.topRows(n) = whitening_ * jacobian.topRows(n);
    const CellCoordinates fence = fence_widths * widths(box);
    for (int x = 0; x < coordinate_count; ++x) {
      residual(n + x) = beyond(x) / fence(x);
      if (beyond(x) != 0) jacobian(n + x, x) = 1 / fence(x);
    }
    return residual;
  }

 private:
  struct Feature {
    double value;
    CellCoordinates gradient;
  };

  Feature feature(int number, const CellCoordinates& cell, const CombinedState& state) const {
    if (number == int(ShapeFeature::area_um2) && size_is_volume_)
      return {std::log(4 * std::numbers::pi / 3) + 3 * cell(x_radius), 3 * CellCoordinates::Unit(x_radius)};
    if (number == int(ShapeFeature::area_um2))
      return {state.value(log_area_row), state.gradient.row(log_area_row).transpose()};
    if (number == int(ShapeFeature::deformation)) {
      const double d = std::exp(cell(x_deformation));
      return {d, d * CellCoordinates::Unit(x_deformation)};
    }
    static_assert(moment_ratio_row == int(ShapeFeature::moment_ratio) &&
                  first_mode_row == int(ShapeFeature::first_mode));
    return {state.value(number), state.gradient.row(number).transpose()};
  }

  const CombinedInterpolation& table_;
  std::span<const int> features_;
  bool size_is_volume_;
  Eigen::VectorXd measured_;
  Eigen::MatrixXd whitening_;
  std::vector<int> free_;
  CellCoordinates cell_ = CellCoordinates::Zero();
};

/// d(E, E2D, gamma)/d(coordinates), in the units of the table.
struct Moduli {
  Eigen::Vector3d value;
  Eigen::Matrix<double, modulus_count, coordinate_count> gradient;
  double stiffness;
  CellCoordinates stiffness_gradient;
};

Moduli moduli_at(const CellCoordinates& cell, const CombinedState& state) {
  const double S = std::exp(state.value(log_stiffness_row)), share = cell(x_share), ratio = cell(x_ratio),
               r0 = std::exp(cell(x_radius));
  Moduli m;
  const CellCoordinates by_s = state.gradient.row(log_stiffness_row).transpose();
  m.stiffness = S;
  m.stiffness_gradient = S * by_s;
  m.value << (1 - share) * S, share * S * r0, ratio * share * S * r0;
  m.gradient.row(int(Modulus::young)) = S * ((1 - share) * by_s - CellCoordinates::Unit(x_share)).transpose();
  const CellCoordinates cortex =
      S * r0 * (share * by_s + share * CellCoordinates::Unit(x_radius) + CellCoordinates::Unit(x_share));
  m.gradient.row(int(Modulus::cortex)) = cortex.transpose();
  m.gradient.row(int(Modulus::tension)) =
      (ratio * cortex + m.value(int(Modulus::cortex)) * CellCoordinates::Unit(x_ratio)).transpose();
  return m;
}

}  // namespace

/// A minimum, and what is fitted in it.
struct SeveralModuli::Candidate {
  CellCoordinates cell;
  double chi_squared;
};

std::string_view name_of(ModuliStatus status) {
  switch (status) {
    case ModuliStatus::no_data: return "no-data";
    case ModuliStatus::resolved: return "resolved";
    case ModuliStatus::not_told_apart: return "not-told-apart";
    case ModuliStatus::outside_table: return "outside-table";
    case ModuliStatus::poor_fit: return "poor-fit";
    case ModuliStatus::gated: return "gated";
    case ModuliStatus::count: break;
  }
  return "";
}

double ModuliEstimate::error(Modulus m) const { return std::sqrt(covariance(int(m), int(m))); }

std::string sentence(const ModuliEstimate& e) {
  const auto stated = [&](Modulus m, std::string_view name, std::string_view unit) {
    return fmt::format("{} = {:.3g} +- {:.2g} {}", name, e.value(m), e.error(m), unit);
  };
  switch (e.status) {
    case ModuliStatus::no_data: return "There is no shape, or no error of it.";
    case ModuliStatus::outside_table: return "No cell of the table has such a shape.";
    case ModuliStatus::gated: return "The event lies outside the limits that were set.";
    case ModuliStatus::poor_fit:
      return fmt::format(
          "The nearest cell of the table differs from the shape by more than its errors "
          "(chi2 = {:.3g} at {} degrees of freedom).",
          e.chi_squared, e.freedom);
    case ModuliStatus::resolved:
      return fmt::format("{}, {}.", stated(Modulus::young, "E", "kPa"), stated(Modulus::cortex, "E2D", "mN/m"));
    case ModuliStatus::not_told_apart:
    case ModuliStatus::count: break;
  }
  std::string known = fmt::format("E + E2D / r0 = {:.3g} +- {:.2g} kPa", e.stiffness_kPa, e.stiffness_error_kPa);
  if (e.is_known[std::size_t(Modulus::young)]) known += ", " + stated(Modulus::young, "E", "kPa");
  if (e.is_known[std::size_t(Modulus::cortex)]) known += ", " + stated(Modulus::cortex, "E2D", "mN/m");
  return fmt::format("The data do not tell the moduli apart; what they tell is {}.", known);
}

std::vector<int> features_of_figure() {
  return {int(ShapeFeature::area_um2), int(ShapeFeature::deformation), int(ShapeFeature::moment_ratio)};
}

std::vector<int> features_of_contour(int last) {
  assert(last >= min_mode && last <= max_mode);
  std::vector<int> features{int(ShapeFeature::area_um2)};
  for (int k = min_mode; k <= last; ++k) features.push_back(int(ShapeFeature::first_mode) + k - min_mode);
  return features;
}

SeveralModuli::SeveralModuli(const CombinedInterpolation& table, const ChannelFlow& simulated, FitOptions options)
    : table_(table), simulated_(simulated), options_(std::move(options)) {
  options_.free_tension = options_.free_tension && table.tension_ratios().size() > 1;
  if (table.tension_ratios().size() == 1) options_.tension_ratio = table.tension_ratios().front();
}

// All coordinates free, then those that left the table's share and tension held at its border.
SeveralModuli::Candidate SeveralModuli::minimum_from(const MeasuredShape& shape, const CellCoordinates& start,
                                                     Share share) const {
  Misfit misfit(table_, shape, options_.features);
  std::vector<int> free{x_radius, x_deformation};
  if (share == Share::fitted) free.push_back(x_share);
  if (options_.free_tension) free.push_back(x_ratio);
  CellCoordinates cell = start;
  const CellBox& box = table_.box();
  ceres::TinySolver<Misfit> solver;
  solver.options.function_tolerance = 1e-9;
  while (true) {
    misfit.set_free(free, cell);
    Eigen::VectorXd x(Eigen::Index(free.size()));
    for (std::size_t i = 0; i < free.size(); ++i) x(Eigen::Index(i)) = cell(free[i]);
    const auto& summary = solver.Solve(misfit, &x);
    for (std::size_t i = 0; i < free.size(); ++i) cell(free[i]) = x(Eigen::Index(i));
    const auto held = std::erase_if(free, [&](int coordinate) {
      if (coordinate != x_share && coordinate != x_ratio) return false;
      const double inside = std::clamp(cell(coordinate), box.least(coordinate), box.greatest(coordinate));
      return std::exchange(cell(coordinate), inside) != inside;
    });
    if (held == 0) return {cell, 2 * summary.final_cost};
  }
}

ModuliEstimate SeveralModuli::fit(const MeasuredShape& measured, const ChannelFlow& flow) const {
  MeasuredShape shape = measured;
  const ScaleFactors scale = scale_factors(simulated_, flow);
  shape.features(0) -= std::log(shape.size_is_volume ? scale.volume : scale.area);
  if (!std::isfinite(scale.load) || !shape.features.allFinite() ||
      !Misfit(table_, shape, options_.features).is_usable())
    return {};
  const CellBox& box = table_.box();
  CellCoordinates start = start_for(shape);
  std::vector<Candidate> minima;
  for (const double place : {0.1, 0.5, 0.9}) {
    start(x_share) = box.least(x_share) + place * (box.greatest(x_share) - box.least(x_share));
    minima.push_back(minimum_from(shape, start, Share::fitted));
  }
  const Candidate best = *std::ranges::min_element(minima, {}, &Candidate::chi_squared);
  ModuliEstimate estimate = estimate_of(shape, best, profile(shape, best));
  const Eigen::Vector3d factor(scale.modulus, scale.cortex_modulus, scale.cortex_modulus);
  estimate.modulus = estimate.modulus.cwiseProduct(factor);
  estimate.covariance = factor.asDiagonal() * estimate.covariance * factor.asDiagonal();
  estimate.stiffness_kPa *= scale.modulus;
  estimate.stiffness_error_kPa *= scale.modulus;
  return estimate;
}

CellCoordinates SeveralModuli::start_for(const MeasuredShape& shape) const {
  const CellBox& box = table_.box();
  CellCoordinates start = CellCoordinates::Zero();
  const double size = shape.features(0) - shape.errors.bias(0);
  const double d = shape.features(int(ShapeFeature::deformation)) - shape.errors.bias(int(ShapeFeature::deformation));
  start(x_radius) =
      shape.size_is_volume ? (size - std::log(4 * std::numbers::pi / 3)) / 3 : (size - std::log(std::numbers::pi)) / 2;
  start(x_deformation) = std::log(std::max(d, 1.01 * std::exp(box.least(x_deformation))));
  start(x_ratio) = options_.tension_ratio;
  return start.cwiseMax(box.least).cwiseMin(box.greatest);
}

// The best cells of other shares of the cortex that fit nearly as well. The covariance alone does not see them where
// the features depend on the share in a bent way.
std::vector<SeveralModuli::Candidate> SeveralModuli::profile(const MeasuredShape& shape, const Candidate& best) const {
  constexpr int places = 13;
  const CellBox& box = table_.box();
  std::vector<Candidate> alike;
  for (int i = 0; i < places; ++i) {
    CellCoordinates start = best.cell;
    start(x_share) = box.least(x_share) + i * (box.greatest(x_share) - box.least(x_share)) / (places - 1);
    const Candidate held = minimum_from(shape, start, Share::held);
    if (held.chi_squared < best.chi_squared + same_chi_squared) alike.push_back(held);
  }
  return alike;
}

ModuliEstimate SeveralModuli::estimate_of(const MeasuredShape& shape, const Candidate& best,
                                          std::span<const Candidate> others) const {
  const Misfit misfit(table_, shape, options_.features);
  const CombinedState state = table_.at(best.cell.cwiseMax(table_.box().least).cwiseMin(table_.box().greatest));
  Misfit::Jacobian jacobian;
  misfit.evaluate(best.cell, jacobian);
  const auto n = Eigen::Index(options_.features.size());
  Eigen::Matrix4d information = jacobian.topRows(n).transpose() * jacobian.topRows(n);
  information.diagonal() += (prior_widths * widths(table_.box())).cwiseInverse().cwiseAbs2();
  if (!options_.free_tension) {  // known exactly
    information.row(x_ratio).setZero();
    information.col(x_ratio).setZero();
    information(x_ratio, x_ratio) = 1;
  }
  Eigen::Matrix4d covariance = information.inverse();
  if (!options_.free_tension) covariance(x_ratio, x_ratio) = 0;

  ModuliEstimate e;
  const Moduli moduli = moduli_at(best.cell, state);
  e.cell = best.cell;
  e.modulus = moduli.value;
  e.covariance = moduli.gradient * covariance * moduli.gradient.transpose();
  e.stiffness_kPa = moduli.stiffness;
  e.stiffness_error_kPa = std::sqrt(moduli.stiffness_gradient.dot(covariance * moduli.stiffness_gradient));
  e.chi_squared = best.chi_squared;
  e.freedom = int(n) - (options_.free_tension ? 4 : 3);
  bool all_known = true;
  for (const Modulus m : {Modulus::young, Modulus::cortex, Modulus::tension}) {
    const auto is_near = [&](const Candidate& other) {
      const double value = moduli_at(other.cell, table_.at(other.cell)).value(int(m));
      return value >= e.value(m) / 2 && value <= e.value(m) * 2;
    };
    const bool known = e.error(m) <= max_relative_error * e.value(m) && std::ranges::all_of(others, is_near);
    e.is_known[std::size_t(m)] = known;
    if (m != Modulus::tension || options_.free_tension) all_known = all_known && known;
  }
  const double freedom = std::max(e.freedom, 0);
  e.status = all_known ? ModuliStatus::resolved : ModuliStatus::not_told_apart;
  if (best.chi_squared > freedom + 3 * std::sqrt(2 * freedom) + 9) e.status = ModuliStatus::poor_fit;
  if (!state.inside || (best.cell - table_.box().least).minCoeff() < -1e-9 ||
      (table_.box().greatest - best.cell).minCoeff() < -1e-9)
    e.status = ModuliStatus::outside_table;
  return e;
}

}  // namespace rheocyte
