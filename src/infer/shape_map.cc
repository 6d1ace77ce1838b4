#include "infer/shape_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "infer/added_ellipse.h"
#include "infer/asymmetry_bias.h"
#include "infer/smooth_events.h"
#include "numeric/no_value.h"
#include "table/grid_by_asymmetry.h"

namespace rheocyte {

namespace {

double sign_of(const ShapeGrid& shapes) {
  const ShapeNodes& nodes = shapes.nodes();
  return shapes.mode(3, nodes.min_log_area, std::exp(nodes.lower.front())) < 0 ? -1 : 1;
}

template <class Take>
void in_blocks(std::size_t all, const Take& take) {
  for (std::size_t first = 0; first < all; first += event_block_size)
    take(first, std::min(event_block_size, all - first));
}

MeasuredEvents part(const MeasuredEvents& events, std::size_t first, std::size_t count) {
  return {events.size.subspan(first, count), events.deformation.subspan(first, count),
          events.viscosity_mPas.empty() ? events.viscosity_mPas : events.viscosity_mPas.subspan(first, count)};
}

}  // namespace

/// ln|c_3| and its standard deviation; c_2 less that of the table's cell, 0 where that is unknown.
struct ShapeMap::SmoothAsymmetries {
  EventColumn log_mode_3, deviation, elongation;
};

bool ShapeExcess::is_elongated() const {
  constexpr double least = 0.05, deviations = 3;
  return excess > std::max(least, deviations * error);
}

double deformation_of_ellipse(double ratio) {
  // Ramanujan's second formula for the perimeter: off by 1e-9 for a ratio of 3.
  const double h = std::pow((ratio - 1) / (ratio + 1), 2);
  const double perimeter_over_pi = (ratio + 1) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
  return 1 - 2 * std::sqrt(ratio) / perimeter_over_pi;
}

double inertia_ratio_deviation(double area_um2, double pixel_size_um) {
  // Measured on nearly round cells of 30 to 109 um^2 in pixels of 0.34 um.
  return 0.016 * std::sqrt(30 / area_um2) * (pixel_size_um / 0.34);
}

ShapeMap::ShapeMap(const StiffnessGrid& grid)
    : origin_(grid.origin()), shapes_(grid.content().shapes.value()), sign_(sign_of(shapes_)) {
  if (auto grids = grids_by_asymmetry(grid, shapes_)) {
    by_asymmetry_.emplace(std::move(grids->stiffness));
    mode_2_.emplace(std::move(grids->mode_2));
  }
}

double ShapeMap::inertia_ratio(double area_um2, double deformation) const {
  return shapes_.inertia_ratio(std::log(area_um2), deformation);
}

void ShapeMap::compare(const MeasuringConditions& conditions, const MeasuredEvents& events,
                       std::span<const double> inertia_ratios, std::span<ShapeExcess> excesses) const {
  assert(inertia_ratios.size() == events.size.size() && excesses.size() == events.size.size());
  SmoothEvents smooth;
  in_blocks(excesses.size(), [&](std::size_t first, std::size_t count) {
    remove_pixels(conditions, origin_.flow, part(events, first, count), smooth);
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double ratio = inertia_ratios[first + i], deformation = smooth.deformation[k];
      ShapeExcess& e = excesses[first + i];
      e.expected = shapes_.inertia_ratio(smooth.log_area[k], deformation);
      e.excess =
          ratio > 0 && std::isfinite(ratio) && shapes_.has_area(smooth.log_area[k]) ? ratio - e.expected : no_value;
      e.error = inertia_ratio_deviation(events.size[first + i], conditions.pixel_size_um);
      const bool has_deformation = deformation > smooth.deformation_deviation[k] && ratio > 0;
      e.odd_share = has_deformation ? 1 - deformation_of_ellipse(ratio) / deformation : no_value;
    }
  });
}

void ShapeMap::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events, const MeasuredModes& modes,
                        const EstimatedModuli& moduli) const {
  const std::size_t all = moduli.modulus_kPa.size();
  assert(events.size.size() == all && modes.mode_3.size() == all && modes.mode_2.size() == all);
  assert(has_asymmetry() && events.viscosity_mPas.size() == all);
  in_blocks(all, [&](std::size_t first, std::size_t count) {
    estimate_block(conditions, part(events, first, count),
                   {modes.mode_2.subspan(first, count), modes.mode_3.subspan(first, count)},
                   {moduli.modulus_kPa.subspan(first, count), moduli.standard_error_kPa.subspan(first, count),
                    moduli.state.subspan(first, count),
                    moduli.systematic_error_kPa.empty() ? moduli.systematic_error_kPa
                                                        : moduli.systematic_error_kPa.subspan(first, count)});
  });
}

void ShapeMap::estimate_block(const MeasuringConditions& conditions, const MeasuredEvents& block,
                              const MeasuredModes& modes, const EstimatedModuli& estimates) const {
  const std::size_t count = block.size.size();
  const Eigen::Index rows = whole_packets(count);
  SmoothEvents smooth;
  SmoothAsymmetries asymmetry;
  EventColumn modulus;
  std::array<GridAnswer, event_block_size> answers;
  remove_pixels(conditions, origin_.flow, block, smooth);
  smooth_modes(conditions.pixel_size_um, modes, smooth, asymmetry);
  remove_ellipses(modes.mode_2, smooth, asymmetry);
  by_asymmetry_->answer({smooth.log_area.data(), count}, {asymmetry.log_mode_3.data(), count}, {answers.data(), count});
  modulus.head(rows) = 0;
  for (std::size_t i = 0; i < count; ++i) modulus[static_cast<Eigen::Index>(i)] = answers[i].log_stiffness;
  modulus.head(rows) = modulus.head(rows).exp();
  const double factor = scale_factors(origin_.flow, {conditions.flow.width_um, conditions.flow.rate_ul_s, 1}).modulus;
  for (std::size_t i = 0; i < count; ++i) {
    const GridAnswer& answer = answers[i];
    const auto k = static_cast<Eigen::Index>(i);
    const bool has = answer.reason == NoAnswer::none && std::isfinite(block.viscosity_mPas[i]);
    const double value = has ? modulus[k] * factor * block.viscosity_mPas[i] : no_value;
    const double by_area = answer.by_log_area * smooth.area_deviation[k],
                 by_asymmetry = answer.by_log_deformation * asymmetry.deviation[k];
    estimates.modulus_kPa[i] = value;
    estimates.standard_error_kPa[i] =
        value * std::sqrt(by_area * by_area + by_asymmetry * by_asymmetry + answer.error * answer.error);
    if (!estimates.systematic_error_kPa.empty())
      estimates.systematic_error_kPa[i] = value * too_high_by_asymmetry(asymmetry.elongation[k]);
    estimates.state[i] = answer.reason == NoAnswer::none && !has ? ModulusState::no_data : state_of(answer);
  }
}

void ShapeMap::smooth_modes(double pixel_size_um, const MeasuredModes& modes, const SmoothEvents& smooth,
                            SmoothAsymmetries& asymmetry) const {
  const Eigen::Index rows = whole_packets(modes.mode_3.size());
  EventColumn mode_2, mode_3;
  mode_2.head(rows) = mode_3.head(rows) = 0;
  std::ranges::copy(modes.mode_2, mode_2.data());
  std::ranges::copy(modes.mode_3, mode_3.data());
  asymmetry.deviation.head(rows) = 0;
  for (Eigen::Index k = 0; pixel_size_um > 0 && k < rows; k += packet_size) {
    const Packet log_area_px = packet_at(smooth.log_measured_area, k) - 2 * std::log(pixel_size_um),
                 second = packet_at(mode_2, k), third = packet_at(mode_3, k);
    const auto pixels = asymmetry_errors(log_area_px, second, third);
    packet_at(mode_3, k) -= pixels.excess;
    packet_at(asymmetry.deviation, k) = pixels.deviation;
  }
  // An asymmetry of the wrong sign is one that is too small, not one that is missing.
  mode_3.head(rows) = (sign_ * mode_3.head(rows)).max(0);
  asymmetry.deviation.head(rows) /= mode_3.head(rows);
  asymmetry.log_mode_3.head(rows) = mode_3.head(rows).log();
}

void ShapeMap::remove_ellipses(std::span<const double> mode_2, SmoothEvents& smooth,
                               SmoothAsymmetries& asymmetry) const {
  const std::size_t count = mode_2.size();
  const Eigen::Index rows = whole_packets(count);
  EventColumn& excess = asymmetry.elongation;
  excess.head(rows) = 0;
  mode_2_->values({smooth.log_area.data(), count}, {asymmetry.log_mode_3.data(), count}, {excess.data(), count});
  for (std::size_t i = 0; i < count; ++i) {
    double& value = excess[static_cast<Eigen::Index>(i)];
    value = std::isnan(value) ? 0 : mode_2[i] - value;
  }
  const double log_half_width = std::log(origin_.flow.width_um / 2);
  for (Eigen::Index k = 0; k < rows; k += packet_size) {
    auto log_mode_3 = packet_at(asymmetry.log_mode_3, k), deviation = packet_at(asymmetry.deviation, k);
    const WithoutEllipse change =
        without_ellipse({packet_at(excess, k), log_mode_3.exp(), packet_at(smooth.log_area, k) - 2 * log_half_width});
    log_mode_3 += change.log_mode_3;
    packet_at(smooth.log_area, k) += change.log_area;
    deviation = (deviation.square() + change.deviation.square()).sqrt();
  }
}

}  // namespace rheocyte
