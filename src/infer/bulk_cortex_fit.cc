#include "infer/bulk_cortex_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "infer/moduli_misfit.h"
#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

/// Cells whose misfits differ by less cannot be distinguished at 90 %.
constexpr double same_chi_squared = 2.7;
/// What is known before: an error of so many widths of the table's range. Keeps covariances finite.
constexpr double prior_widths = 3;
/// Of the wall's shear stress: what is said to be known exactly is known that well. Hundred times as well as a cell
/// gives the tension, it leaves covariances regular.
constexpr double least_tension_error = 1e-3;
constexpr std::array all_moduli{Modulus::young, Modulus::cortex, Modulus::tension};

/// d(E, E2D, gamma)/d(coordinates), in the units of the table.
struct Moduli {
  Eigen::Vector3d value;
  Eigen::Matrix<double, modulus_count, coordinate_count> gradient;
  double stiffness;
  CellCoordinates stiffness_gradient;
};

Moduli moduli_at(const CellCoordinates& cell, const CombinedState& state) {
  const double S = std::exp(state.value(log_stiffness_row)), fraction = cell(x_fraction), ratio = cell(x_ratio),
               r0 = std::exp(cell(x_radius));
  Moduli m;
  const CellCoordinates by_s = state.gradient.row(log_stiffness_row).transpose();
  m.stiffness = S;
  m.stiffness_gradient = S * by_s;
  m.value << (1 - fraction) * S, fraction * S * r0, ratio * fraction * S * r0;
  m.gradient.row(int(Modulus::young)) = S * ((1 - fraction) * by_s - CellCoordinates::Unit(x_fraction)).transpose();
  const CellCoordinates cortex =
      S * r0 * (fraction * by_s + fraction * CellCoordinates::Unit(x_radius) + CellCoordinates::Unit(x_fraction));
  m.gradient.row(int(Modulus::cortex)) = cortex.transpose();
  m.gradient.row(int(Modulus::tension)) =
      (ratio * cortex + m.value(int(Modulus::cortex)) * CellCoordinates::Unit(x_ratio)).transpose();
  return m;
}

}  // namespace

std::vector<int> features_of_figure() {
  return {int(ShapeFeature::area_um2), int(ShapeFeature::deformation), int(ShapeFeature::moment_ratio)};
}

std::vector<int> features_of_contour(int last) {
  assert(last >= min_mode && last <= max_mode);
  std::vector<int> features{int(ShapeFeature::area_um2)};
  for (int k = min_mode; k <= last; ++k) features.push_back(int(ShapeFeature::first_mode) + k - min_mode);
  return features;
}

BulkCortexFit::BulkCortexFit(const CombinedInterpolation& table, const ChannelFlow& simulated, FitOptions options)
    : table_(table), at_rest_(cells_at_rest(table.spec())), simulated_(simulated), options_(std::move(options)) {
  options_.free_tension = options_.free_tension && table.tension_ratios().size() > 1;
  if (table.tension_ratios().size() == 1) options_.tension_ratio = table.tension_ratios().front();
}

ModuliMisfit BulkCortexFit::misfit(const MeasuredShape& measured, const ChannelFlow& flow,
                                   const AxialTension& tension) const {
  MeasuredShape shape = measured;
  const ScaleFactors scale = scale_factors(simulated_, flow);
  shape.features(0) -= std::log(shape.size_is_volume ? scale.volume : scale.area);
  if (!std::isfinite(scale.load)) shape.features.setConstant(no_value);
  const double least_error = least_tension_error * wall_shear_stress_Pa(simulated_);
  return {table_,
          shape,
          options_.features,
          {tension.value_Pa / scale.modulus, std::max(tension.error_Pa / scale.modulus, least_error)},
          tension.error_Pa > 0 ? ModuliMisfit::TensionIs::fitted : ModuliMisfit::TensionIs::known};
}

ShapeVector BulkCortexFit::shape_of(const CellCoordinates& cell, const ChannelFlow& flow) const {
  const CombinedState state = table_.at(cell);
  ShapeVector shape;
  for (int feature = 0; feature < feature_count; ++feature) shape(feature) = state.value(row_of(feature));
  shape(int(ShapeFeature::area_um2)) += std::log(scale_factors(simulated_, flow).area);
  return shape;
}

int BulkCortexFit::freedom() const {
  constexpr int size_and_stiffness = 2;
  return int(options_.features.size()) - size_and_stiffness - (has_free_fraction() ? 1 : 0) -
         (options_.free_tension ? 1 : 0);
}

bool BulkCortexFit::has_free_fraction() const {
  return table_.box().least(x_fraction) < table_.box().greatest(x_fraction);
}

double BulkCortexFit::axial_tension_Pa(const CellCoordinates& cell, const ChannelFlow& flow) const {
  return 1e3 * cell(x_axial) * std::exp(table_.at(cell).value(log_stiffness_row)) *
         scale_factors(simulated_, flow).modulus;
}

std::optional<BulkCortexFit::Candidate> BulkCortexFit::nearest(const MeasuredShape& shape, const ChannelFlow& flow,
                                                               const AxialTension& tension,
                                                               const CellCoordinates* start) const {
  ModuliMisfit in_table = misfit(shape, flow, tension);
  if (!in_table.shape().features.allFinite() || !in_table.is_usable()) return {};
  return nearest(in_table, start);
}

ModuliEstimate BulkCortexFit::fit(const MeasuredShape& shape, const ChannelFlow& flow, const AxialTension& tension,
                                  const CellCoordinates* start) const {
  ModuliMisfit in_table = misfit(shape, flow, tension);
  if (!in_table.shape().features.allFinite() || !in_table.is_usable()) return {};
  // All cells have the tension in common: no single one moves it, but its error is one of theirs.
  const bool is_uncertain = tension.error_Pa > 0 && tension.is_known();
  ModuliMisfit at_value = is_uncertain ? misfit(shape, flow, {tension.value_Pa, 0}) : in_table;
  ModuliEstimate estimate = estimate_of(in_table, nearest(at_value, start));
  const ScaleFactors scale = scale_factors(simulated_, flow);
  const Eigen::Vector3d factor(scale.modulus, scale.cortex_modulus, scale.cortex_modulus);
  estimate.modulus = estimate.modulus.cwiseProduct(factor);
  estimate.covariance = factor.asDiagonal() * estimate.covariance * factor.asDiagonal();
  for (double* stress :
       {&estimate.stiffness_kPa, &estimate.stiffness_error_kPa, &estimate.effective_modulus_kPa,
        &estimate.effective_modulus_error_kPa, &estimate.axial_tension_Pa, &estimate.axial_tension_error_Pa})
    *stress *= scale.modulus;
  return estimate;
}

double BulkCortexFit::middle_ratio() const {
  return std::midpoint(table_.box().least(x_ratio), table_.box().greatest(x_ratio));
}

CellCoordinates BulkCortexFit::start_for(const MeasuredShape& shape) const {
  const CellBox& box = table_.box();
  CellCoordinates start = CellCoordinates::Zero();
  const auto feature = [&](int number) { return shape.features(number) - shape.errors.bias(number); };
  constexpr int mode_2 = int(ShapeFeature::first_mode);
  const double size = feature(0);
  const double progress = feature(table_.is_elongated() ? mode_2 + 1 : int(ShapeFeature::deformation));
  start(x_radius) =
      shape.size_is_volume ? (size - std::log(4 * std::numbers::pi / 3)) / 3 : (size - std::log(std::numbers::pi)) / 2;
  start(x_progress) = std::log(std::max(progress, 1.01 * std::exp(box.least(x_progress))));
  start(x_ratio) = options_.free_tension ? middle_ratio() : options_.tension_ratio;
  start(x_axial) = feature(mode_2);  // of a solid 3/4 of the ratio at first
  return start.cwiseMax(box.least).cwiseMin(box.greatest);
}

// The best cells of other fractions of the cortex that fit nearly as well. The covariance alone does not see them where
// the features depend on the fraction in a bent way.
std::vector<BulkCortexFit::Candidate> BulkCortexFit::profile(ModuliMisfit& misfit, const Candidate& best) const {
  constexpr int places = 13;
  const CellBox& box = table_.box();
  std::vector<Candidate> alike;
  for (int i = 0; i < places; ++i) {
    CellCoordinates start = best.cell;
    start(x_fraction) = box.least(x_fraction) + i * (box.greatest(x_fraction) - box.least(x_fraction)) / (places - 1);
    const Candidate held = minimum_from(misfit, start, Fraction::held);
    if (held.chi_squared < best.chi_squared + same_chi_squared) alike.push_back(held);
  }
  return alike;
}

void BulkCortexFit::forget_what_others_deny(std::span<const Candidate> others, ModuliEstimate& e) const {
  for (const Candidate& other : others) {
    const Eigen::Vector3d values = moduli_at(other.cell, table_.at(other.cell)).value;
    for (const Modulus m : all_moduli) {
      const double value = values(int(m));
      if (!(value >= e.value(m) / 2 && value <= e.value(m) * 2)) e.is_known[std::size_t(m)] = false;
    }
  }
}

BulkCortexFit::Covariance BulkCortexFit::covariance_at(const ModuliMisfit& misfit, const CellCoordinates& cell) const {
  Covariance information = misfit.information(cell);
  information.diagonal() += (prior_widths * widths(table_.box())).cwiseInverse().cwiseAbs2();
  std::vector<int> known;  // exactly
  if (!has_free_fraction()) known.push_back(x_fraction);
  if (!options_.free_tension) known.push_back(x_ratio);
  if (!table_.is_elongated()) known.push_back(x_axial);
  for (const int x : known) {
    information.row(x).setZero();
    information.col(x).setZero();
    information(x, x) = 1;
  }
  Covariance covariance = dense_inverse(information);
  for (const int x : known) covariance(x, x) = 0;
  return covariance;
}

ModuliEstimate BulkCortexFit::estimate_of(ModuliMisfit& misfit, const Candidate& best) const {
  if (!std::isfinite(best.chi_squared)) return {.status = ModuliStatus::outside_table};
  const CombinedState state = table_.at(best.cell.cwiseMax(table_.box().least).cwiseMin(table_.box().greatest));
  const Covariance covariance = covariance_at(misfit, best.cell);
  const auto error_of = [&](const CellCoordinates& gradient) { return std::sqrt(gradient.dot(covariance * gradient)); };
  ModuliEstimate e;
  const Moduli moduli = moduli_at(best.cell, state);
  e.cell = best.cell;
  e.modulus = moduli.value;
  e.covariance = moduli.gradient * covariance * moduli.gradient.transpose();
  e.stiffness_kPa = moduli.stiffness;
  e.stiffness_error_kPa = error_of(moduli.stiffness_gradient);
  const auto [effective_modulus, by_coordinates] = effective_modulus_kPa(at_rest_, best.cell, state);
  e.effective_modulus_kPa = effective_modulus;
  e.effective_modulus_error_kPa = error_of(by_coordinates);
  e.axial_tension_Pa = 1e3 * best.cell(x_axial) * moduli.stiffness;
  e.axial_tension_error_Pa = 1e3 * error_of(best.cell(x_axial) * moduli.stiffness_gradient +
                                            moduli.stiffness * CellCoordinates::Unit(x_axial));
  e.chi_squared = best.chi_squared;
  e.freedom = freedom();
  for (const Modulus m : all_moduli) e.is_known[std::size_t(m)] = e.error(m) <= max_relative_error * e.value(m);
  const double freedom = std::max(e.freedom, 0);
  if (!state.inside || (best.cell - table_.box().least).minCoeff() < -1e-9 ||
      (table_.box().greatest - best.cell).minCoeff() < -1e-9) {
    e.status = ModuliStatus::outside_table;
  } else if (best.chi_squared > freedom + 3 * std::sqrt(2 * freedom) + 9) {
    e.status = ModuliStatus::poor_fit;
  } else {
    if (has_free_fraction() && std::ranges::count(e.is_known, true) > 0)
      forget_what_others_deny(profile(misfit, best), e);
    const bool are_all_known = std::ranges::all_of(all_moduli, [&](Modulus m) {
      return e.is_known[std::size_t(m)] || (m == Modulus::tension && !options_.free_tension);
    });
    e.status = are_all_known ? ModuliStatus::resolved : ModuliStatus::not_told_apart;
  }
  return e;
}

}  // namespace rheocyte
