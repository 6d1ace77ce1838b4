#include "infer/grid_map.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "case/user_error.h"
#include "infer/smooth_events.h"
#include "measurement/pixel_errors.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

// Variance of ln(modulus) by scattering area and deformation (eq:standard-error).
template <std::size_t most>
double variance_by_pixels(const GridAnswer& answer, const SmoothEventsOf<most>& smooth, Eigen::Index event) {
  const double by_area = answer.by_log_area * smooth.area_deviation[event];
  const double by_deformation =
      answer.by_log_deformation * smooth.deformation_deviation[event] / smooth.deformation[event];
  return by_area * by_area + by_deformation * by_deformation + 2 * smooth.correlation[event] * by_area * by_deformation;
}

}  // namespace

ModulusState state_of(const GridAnswer& answer) {
  switch (answer.reason) {
    case OutOfTable::none: return answer.regularised ? ModulusState::regularised : ModulusState::valid;
    case OutOfTable::invalid: return ModulusState::no_data;
    case OutOfTable::too_small: return ModulusState::too_small;
    case OutOfTable::too_large: return ModulusState::too_large;
    case OutOfTable::too_stiff: return ModulusState::too_stiff;
    case OutOfTable::too_soft: return ModulusState::too_soft;
    case OutOfTable::unstable: return ModulusState::unstable;
    case OutOfTable::unresolved: return ModulusState::unresolved;
  }
  return ModulusState::no_data;
}

GridMap::GridMap(GridContent grid) : ModulusMap(grid.origin), grid_(std::move(grid)) {
  if (origin().is_shell)
    throw UserError(fmt::format("The table {} holds moduli of a cortex (mN/m); Young's moduli need a table of solids.",
                                origin().identifier));
  if (grid_.content().shapes) shapes_ = std::make_unique<ShapeMap>(grid_);
}

void GridMap::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                       const EstimatedModuli& estimates) const {
  const std::size_t all = estimates.modulus_kPa.size();
  assert(events.size.size() == all && events.deformation.size() == all && events.viscosity_mPas.size() == all);
  assert(estimates.standard_error_kPa.size() == all && estimates.state.size() == all);
  const auto estimate_together = [&](std::size_t first, std::size_t count, auto& smooth) {
    const MeasuredEvents block{events.size.subspan(first, count), events.deformation.subspan(first, count),
                               events.viscosity_mPas.subspan(first, count)};
    remove_pixels(conditions, block, smooth);
    estimate(conditions, block, smooth,
             {estimates.modulus_kPa.subspan(first, count), estimates.standard_error_kPa.subspan(first, count),
              estimates.state.subspan(first, count)});
  };
  if (all <= few_events) {
    SmoothEventsOf<few_events> smooth;
    return estimate_together(0, all, smooth);
  }
  SmoothEventsOf<event_block_size> smooth;
  for (std::size_t first = 0; first < all; first += event_block_size)
    estimate_together(first, std::min(event_block_size, all - first), smooth);
}

template <std::size_t most>
void GridMap::estimate(const MeasuringConditions& conditions, const MeasuredEvents& block, SmoothEventsOf<most>& smooth,
                       const EstimatedModuli& estimates) const {
  const std::size_t count = block.size.size();
  assert(count <= most);
  constexpr std::size_t group_size = std::min<std::size_t>(most, 16);  // whole packets (whole_packets.h)
  using GroupColumn = Eigen::Array<double, group_size, 1>;
  scale_areas(conditions, origin().flow, count, smooth);
  const double factor = factor_per_mPas(conditions);
  std::array<GridAnswer, group_size> answers;  // of a few events: a single one is not slowed down by a block
  for (std::size_t first = 0; first < count; first += group_size) {
    const std::size_t in_group = std::min(group_size, count - first);
    const auto row = static_cast<Eigen::Index>(first);
    // A deformation below zero is one that is too small, not one that is missing.
    const GroupColumn log_deformation = smooth.deformation.template segment<group_size>(row).max(0).log();
    grid_.answer({smooth.log_area.data() + first, in_group}, {log_deformation.data(), in_group},
                 {answers.data(), in_group});
    GroupColumn modulus = GroupColumn::Zero();
    for (std::size_t i = 0; i < in_group; ++i) modulus[static_cast<Eigen::Index>(i)] = answers[i].log_stiffness;
    modulus = modulus.exp();
    for (std::size_t i = 0; i < in_group; ++i) {
      const GridAnswer& answer = answers[i];
      const double viscosity = block.viscosity_mPas[first + i];
      const bool is_inside = answer.reason == OutOfTable::none, has = is_inside && std::isfinite(viscosity);
      const double value = has ? modulus[static_cast<Eigen::Index>(i)] * factor * viscosity : no_value;
      const double variance =
          answer.error * answer.error + variance_by_pixels(answer, smooth, row + static_cast<Eigen::Index>(i));
      estimates.modulus_kPa[first + i] = value;
      estimates.standard_error_kPa[first + i] = value * std::sqrt(variance);
      estimates.state[first + i] = is_inside && !has ? ModulusState::no_data : state_of(answer);
    }
  }
}

template void GridMap::estimate(const MeasuringConditions&, const MeasuredEvents&, SmoothEventsOf<event_block_size>&,
                                const EstimatedModuli&) const;
template void GridMap::estimate(const MeasuringConditions&, const MeasuredEvents&, SmoothEventsOf<few_events>&,
                                const EstimatedModuli&) const;

// Without the very rim, where rounding decides whether there is a modulus.
ModulusMap::Interval GridMap::areas() const {
  constexpr double rim = 1.0 / 800;  // of the width
  const GridContent& grid = grid_.content();
  const double least = std::exp(grid.min_log_area),
               greatest = std::exp(grid.min_log_area + grid.column_step * (grid.columns - 1));
  return {least + rim * (greatest - least), greatest - rim * (greatest - least)};
}

ModulusMap::Interval GridMap::deformations(double area_um2) const {
  constexpr double rim = 1e-9;
  const auto range = grid_.smooth_range(area_um2);
  if (!range) return {};
  return {std::exp(range->lower + rim), std::exp(range->upper - rim)};
}

double GridMap::modulus_kPa(double area_um2, double deformation) const {
  const GridAnswer answer = grid_.answer(area_um2, deformation);
  return answer.reason == OutOfTable::none && !answer.regularised ? std::exp(answer.log_stiffness) : no_value;
}

PlanePoint GridMap::seen_through_pixels(const PlanePoint& cell, double pixel_size_um) const {
  const double pixel_area = pixel_size_um * pixel_size_um;
  const auto seen = rheocyte::seen_through_pixels({cell.x / pixel_area, cell.y});
  return {seen.area_px * pixel_area, seen.deformation};
}

}  // namespace rheocyte
