#include "infer/elongated_solids.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "infer/smooth_events.h"
#include "laws/uniaxial.h"
#include "measurement/pixel_errors.h"
#include "numeric/dense_solve.h"
#include "numeric/no_value.h"

namespace rheocyte {
namespace {

constexpr int most_steps = 30;
/// Of the last step; the next one would be about its square.
constexpr double settled = 1e-6;
/// So far beyond the table a cell may be on the way, in fractions of its widths.
constexpr double beyond = 0.04;
constexpr double min_height = ElongatedTable::min_height;

std::array<int, 2> numbers_of(ElongatedBy by) {
  using enum ElongatedMeasure;
  return by == ElongatedBy::modes ? std::array{number_of(mode_2), number_of(mode_3)}
                                  : std::array{number_of(inertia_ratio), number_of(deformation)};
}

Eigen::Vector3d seen_of(const ElongatedState& state, ElongatedBy by) {
  const auto [first, second] = numbers_of(by);
  return {state.log_area(), state.value(first), state.value(second)};
}

Eigen::Matrix3d slopes_of(const ElongatedState& state, ElongatedBy by) {
  const auto [first, second] = numbers_of(by);
  Eigen::Matrix3d slopes;
  slopes.row(0) = state.log_area_slope().transpose();
  slopes.row(1) = state.slope.row(first).matrix();
  slopes.row(2) = state.slope.row(second).matrix();
  return slopes;
}

/// Why a cell beside the table has no modulus.
ModulusState reason_for(const ElongatedCell& cell, const ElongatedCell& least, const ElongatedCell& greatest) {
  if (cell(0) < least(0)) return ModulusState::too_small;
  if (cell(0) > greatest(0)) return ModulusState::too_large;
  if (cell(2) > greatest(2)) return ModulusState::too_soft;
  if (cell(2) <= min_height) return ModulusState::too_stiff;
  if (cell(1) < least(1)) return ModulusState::too_round;
  if (cell(1) > greatest(1)) return ModulusState::too_elongated;
  return ModulusState::valid;
}

/// One event's numbers without pixels, in the table's channel, and their covariance.
struct Smooth {
  Eigen::Vector3d seen;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Smooth smooth_modes(const SmoothEvents& events, Eigen::Index k, double pixel_size_um, const OutlineModes& modes) {
  Smooth smooth{{events.log_area[k], modes.mode_2, modes.mode_3}};
  smooth.covariance(0, 0) = std::pow(events.area_deviation[k], 2);
  if (!(pixel_size_um > 0)) return smooth;
  const ModeErrors pixels = mode_errors(events.log_measured_area[k] - 2 * std::log(pixel_size_um), modes);
  smooth.seen(1) -= pixels.mode_2.excess;
  smooth.seen(2) -= pixels.mode_3.excess;
  smooth.covariance(1, 1) = std::pow(pixels.mode_2.deviation, 2);
  smooth.covariance(2, 2) = std::pow(pixels.mode_3.deviation, 2);
  smooth.covariance(1, 2) = smooth.covariance(2, 1) =
      pixels.correlation * pixels.mode_2.deviation * pixels.mode_3.deviation;
  return smooth;
}

Smooth smooth_inertia(const SmoothEvents& events, Eigen::Index k, double pixel_size_um, double inertia_ratio,
                      double deformation) {
  Smooth smooth{{events.log_area[k], inertia_ratio, deformation}};
  smooth.covariance(0, 0) = std::pow(events.area_deviation[k], 2);
  if (!(pixel_size_um > 0)) return smooth;
  const InertiaErrors pixels =
      inertia_errors(events.log_measured_area[k] - 2 * std::log(pixel_size_um), deformation, inertia_ratio);
  smooth.seen(1) -= pixels.inertia_excess;
  smooth.seen(2) -= pixels.deformation_excess;
  smooth.covariance(1, 1) = std::pow(pixels.inertia_deviation, 2);
  smooth.covariance(2, 2) = std::pow(pixels.deformation_deviation, 2);
  smooth.covariance(1, 2) = smooth.covariance(2, 1) =
      pixels.correlation * pixels.inertia_deviation * pixels.deformation_deviation;
  return smooth;
}

/// What is reported of one event.
struct Estimate {
  double modulus = no_value, modulus_error = no_value, axial_ratio = no_value, ratio_error = no_value,
         tension = no_value, tension_error = no_value;  ///< kPa in the measurement's flow; fractions of it
  ModulusState state = ModulusState::no_data;
};

Estimate estimate_of(const ElongatedSolids::Found& found, const Eigen::Matrix3d& covariance, double factor,
                     double table_error) {
  Estimate estimate{.state = found.reason};
  if (found.reason != ModulusState::valid) return estimate;
  const Eigen::Matrix3d by_seen = found.slopes.inverse();
  // ln(E) and the axial ratio by the three numbers.
  const Eigen::RowVector3d of_modulus = found.state.log_modulus_slope.transpose() * by_seen, of_ratio = by_seen.row(1);
  const double ratio = found.cell(1), modulus = factor * std::exp(found.state.log_modulus);
  const auto deviation = [&](const Eigen::RowVector3d& slopes) {
    return std::sqrt(std::max((slopes * covariance * slopes.transpose())(0), 0.0));
  };
  estimate.modulus = modulus;
  estimate.modulus_error = modulus * std::hypot(deviation(of_modulus), table_error);
  estimate.axial_ratio = ratio;
  estimate.ratio_error = deviation(of_ratio);
  estimate.tension = ratio * modulus;
  estimate.tension_error = modulus * std::hypot(deviation(of_ratio + ratio * of_modulus), ratio * table_error);
  return estimate;
}

double aspect_slope(double axial_ratio) {
  const double stretch = stretch_by_tension(axial_ratio);
  return 1.5 * std::sqrt(stretch) * 3 / (2 * stretch + 1 / (stretch * stretch));
}

}  // namespace

ElongatedSolids::Found ElongatedSolids::find(const Eigen::Vector3d& seen, ElongatedBy by) const {
  const ElongatedCell least = table_.least(), greatest = table_.greatest(), width = greatest - least;
  ElongatedCell low = least - beyond * width, high = greatest + beyond * width;
  low(2) = min_height / 2;
  Found found;
  found.cell = greatest;
  if (!seen.allFinite()) return found.reason = ModulusState::no_data, found;
  const double radius_um = std::exp(seen(0) / 2) * std::numbers::inv_sqrtpi;
  if (radius_um > origin().flow.width_um / 2) return found.reason = ModulusState::too_large, found;
  // To first order c_2 is three quarters of the axial ratio, and i = (1 + c_2) / (1 - c_2).
  const double mode_2 = by == ElongatedBy::modes ? seen(1) : (seen(1) - 1) / (seen(1) + 1);
  found.cell = {table_.coordinate_of(radius_um), mode_2 / 0.75, 0.5};
  found.cell = found.cell.cwiseMax(low).cwiseMin(high);
  double change = 1;
  for (int step = 0; step < most_steps && change > settled; ++step) {
    found.state = table_.at(found.cell);
    found.slopes = slopes_of(found.state, by);
    const Eigen::Vector3d move = solve_dense(found.slopes, seen - seen_of(found.state, by));
    if (!move.allFinite()) return found.reason = ModulusState::unresolved, found;
    const ElongatedCell next = (found.cell + move).cwiseMax(low).cwiseMin(high);
    change = (next - found.cell).cwiseAbs().maxCoeff();
    found.cell = next;
  }
  found.reason = reason_for(found.cell, least, greatest);
  if (found.reason == ModulusState::valid && change > settled) found.reason = ModulusState::unresolved;
  return found;
}

void ElongatedSolids::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                               const ElongatedShapes& shapes, const ElongatedEstimates& estimates) const {
  const std::size_t all = estimates.moduli.modulus_kPa.size();
  assert(events.size.size() == all && shapes.first.size() == all && shapes.second.size() == all);
  const bool by_modes = shapes.by == ElongatedBy::modes;
  assert(!by_modes || !(conditions.pixel_size_um > 0) || (shapes.mode_4.size() == all && shapes.mode_5.size() == all));
  const auto next_mode = [](std::span<const double> modes, std::size_t i) { return modes.empty() ? 0 : modes[i]; };
  const double per_mPas =
      scale_factors(origin().flow, {conditions.flow.width_um, conditions.flow.rate_ul_s, 1}).modulus;
  SmoothEvents smooth;
  for (std::size_t first = 0; first < all; first += event_block_size) {
    const std::size_t count = std::min(event_block_size, all - first);
    remove_pixels(conditions, origin().flow,
                  {events.size.subspan(first, count), events.deformation.subspan(first, count),
                   events.viscosity_mPas.subspan(first, count)},
                  smooth);
    for (std::size_t i = first; i < first + count; ++i) {
      const auto k = Eigen::Index(i - first);
      const Smooth seen =
          by_modes ? smooth_modes(
                         smooth, k, conditions.pixel_size_um,
                         {shapes.first[i], shapes.second[i], next_mode(shapes.mode_4, i), next_mode(shapes.mode_5, i)})
                   : smooth_inertia(smooth, k, conditions.pixel_size_um, shapes.first[i], shapes.second[i]);
      const double viscosity = events.viscosity_mPas[i];
      const Found found = find(std::isfinite(viscosity) ? seen.seen : Eigen::Vector3d::Constant(no_value), shapes.by);
      const Estimate e = estimate_of(found, seen.covariance, per_mPas * viscosity, table_.error());
      estimates.moduli.modulus_kPa[i] = e.modulus;
      estimates.moduli.standard_error_kPa[i] = e.modulus_error;
      estimates.moduli.state[i] = e.state;
      estimates.cell[i] = found.cell;
      estimates.elongation[i] = aspect_by_tension(e.axial_ratio);
      estimates.elongation_error[i] = e.ratio_error * aspect_slope(e.axial_ratio);
      estimates.axial_tension_Pa[i] = 1e3 * e.tension;
      estimates.axial_tension_error_Pa[i] = 1e3 * e.tension_error;
    }
  }
}

}  // namespace rheocyte
