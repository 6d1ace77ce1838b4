#include "table/shapes_from_branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "numeric/lagrange.h"
#include "table/radius_branches.h"

namespace rheocyte {

namespace {

constexpr std::size_t max_shape_stencil = 6, fewest_states = 3;
constexpr auto shape_mode_count = std::tuple_size_v<RadiusModes>;
constexpr Measure inertia_ratio = Measure::named("inertia_ratio"), first_mode = Measure::named("mode_2");

/// The state of one radius at the deformation of a node.
struct RadiusState {
  double log_area = 0, inertia_ratio = 0;
  RadiusModes modes{};
};

std::vector<RadiusState> states_at(std::span<const RadiusBranches> radii, double deformation) {
  std::vector<RadiusState> states;
  for (const auto& radius : radii) {
    if (!radius.bare()) continue;
    const double stiffness = stiffness_at(*radius.bare(), Measure::deformation, deformation);
    if (!std::isfinite(stiffness)) continue;
    const Eigen::VectorXd value = interpolate(*radius.bare(), stiffness);
    RadiusState state{std::log(value(int(Measure::area_um2))), value(int(inertia_ratio)), {}};
    for (std::size_t k = 0; k < shape_mode_count; ++k) state.modes[k] = value(int(first_mode) + int(k));
    states.push_back(state);
  }
  std::ranges::sort(states, {}, &RadiusState::log_area);
  return states;
}

/// The radii whose cells may have about this area.
std::span<const RadiusBranches> radii_near(std::span<const RadiusBranches> radii, double log_area) {
  constexpr std::ptrdiff_t on_each_side = 8;
  const double radius = std::sqrt(std::exp(log_area) / std::numbers::pi);
  const auto above = std::ranges::upper_bound(radii, radius, {}, &RadiusBranches::radius_um) - radii.begin();
  const auto first = std::max<std::ptrdiff_t>(above - on_each_side, 0),
             end = std::min<std::ptrdiff_t>(above + on_each_side, std::ssize(radii));
  return radii.subspan(std::size_t(first), std::size_t(end - first));
}

/// Weights of the states around an area; beyond all of them of the nearest three, where higher powers go astray.
std::vector<double> weights_at(std::span<const RadiusState>& states, double log_area) {
  const auto behind = std::ranges::upper_bound(states, log_area, {}, &RadiusState::log_area) - states.begin();
  const bool outside = behind == 0 || behind == std::ssize(states);
  const std::size_t count = std::min(states.size(), outside ? fewest_states : max_shape_stencil);
  const auto half = std::ptrdiff_t(count) / 2;
  const auto first = std::clamp<std::ptrdiff_t>(behind - half, 0, std::ssize(states) - std::ptrdiff_t(count));
  states = states.subspan(std::size_t(first), count);
  std::vector<double> places;
  for (const auto& state : states) places.push_back(state.log_area);
  return lagrange_weights(places, log_area).value;
}

double edge_at(const GridPatch& patch, const std::vector<double>& edge, double column) {
  const double place = std::clamp(column - patch.first_column, 0.0, double(patch.columns - 1));
  const auto below = std::min(std::size_t(place), std::size_t(patch.columns - 2));
  const double fraction = place - double(below);
  return (1 - fraction) * edge[below] + fraction * edge[below + 1];
}

/// ln(deformation) up to which as many branches go as a polynomial needs at least.
double common_end(std::span<const RadiusBranches> radii) {
  std::vector<double> ends;
  for (const auto& radius : radii)
    if (radius.bare()) ends.push_back(std::log(radius.bare()->at(radius.bare()->samples() - 1, Measure::deformation)));
  if (ends.size() < 2) return -std::numeric_limits<double>::infinity();
  std::ranges::sort(ends, std::greater<>());
  constexpr double rounding = 1e-9;
  return ends[std::min(fewest_states, ends.size()) - 1] - rounding;
}

}  // namespace

std::optional<ShapeNodes> shapes_from_branches(const GridContent& grid, std::span<const SampledBranch> branches) {
  const auto radii = by_radius(branches);
  const GridPatch& bare = grid.patches.front();
  const double end = common_end(radii);
  ShapeNodes nodes;
  nodes.min_log_area = grid.min_log_area;
  nodes.column_step = grid.column_step * (grid.columns - 1) / (shape_columns - 1);
  nodes.columns = shape_columns;
  nodes.rows = shape_rows;
  for (int c = 0; c < shape_columns; ++c) {
    const double log_area = nodes.min_log_area + c * nodes.column_step,
                 column = double(c) * (grid.columns - 1) / (shape_columns - 1);
    nodes.lower.push_back(edge_at(bare, bare.lower, column));
    nodes.upper.push_back(std::min(edge_at(bare, bare.upper, column), end));
    if (!(nodes.upper.back() > nodes.lower.back())) return {};
    for (int row = 0; row < shape_rows; ++row) {
      const double fraction = double(row) / (shape_rows - 1);
      const double deformation = std::exp((1 - fraction) * nodes.lower.back() + fraction * nodes.upper.back());
      auto all = states_at(radii_near(radii, log_area), deformation);
      if (all.size() < fewest_states) all = states_at(radii, deformation);
      if (all.size() < 2) return {};
      std::span<const RadiusState> around = all;
      const auto weights = weights_at(around, log_area);
      RadiusState sum;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        sum.inertia_ratio += weights[i] * around[i].inertia_ratio;
        for (std::size_t k = 0; k < shape_mode_count; ++k) sum.modes[k] += weights[i] * around[i].modes[k];
      }
      nodes.inertia_ratio.push_back(sum.inertia_ratio);
      for (std::size_t k = 0; k < shape_mode_count; ++k) nodes.modes[k].push_back(sum.modes[k]);
    }
  }
  return nodes;
}

}  // namespace rheocyte
