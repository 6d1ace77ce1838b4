#include "synth/branch_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace rheocyte {

namespace {

/// A state in units of its radius; the deformation by its logarithm, which is nearly linear in the radius.
struct ScaledState {
  double radius_um = 0;
  Eigen::MatrixX2d meridian;
  double area = 0, log_deformation = 0, volume = 0;
};

std::optional<ScaledState> scaled_state(const RadiusBranches& radius, double stiffness) {
  const auto point = radius.at_stiffness(stiffness);
  if (!point) return std::nullopt;
  const double r = radius.radius_um();
  return ScaledState{r, interpolate_contour(*point->branch, point->stiffness) / r,
                     point->measure(Measure::area_um2) / (r * r), std::log(point->measure(Measure::deformation)),
                     point->measure(Measure::volume_um3) / (r * r * r)};
}

// Lagrange's weights of the states at a radius.
std::vector<double> weights_at(double radius_um, std::span<const ScaledState> states) {
  std::vector<double> weights;
  for (const auto& own : states) {
    double weight = 1;
    for (const auto& other : states)
      if (&other != &own) weight *= (radius_um - other.radius_um) / (own.radius_um - other.radius_um);
    weights.push_back(weight);
  }
  return weights;
}

CellShape blended(double radius_um, std::span<const ScaledState> states) {
  const auto weights = weights_at(radius_um, states);
  ScaledState sum{radius_um, Eigen::MatrixX2d::Zero(states[0].meridian.rows(), 2)};
  for (std::size_t i = 0; i < states.size(); ++i) {
    sum.meridian += weights[i] * states[i].meridian;
    sum.area += weights[i] * states[i].area;
    sum.log_deformation += weights[i] * states[i].log_deformation;
    sum.volume += weights[i] * states[i].volume;
  }
  return {sum.meridian * radius_um, sum.area * radius_um * radius_um, std::exp(sum.log_deformation),
          sum.volume * radius_um * radius_um * radius_um};
}

}  // namespace

std::variant<CellShape, NoShape> BranchConditions::in_channel(std::variant<CellShape, NoShape> found) const {
  const double width = width_ratio();
  if (auto* const shape = std::get_if<CellShape>(&found)) {
    shape->meridian /= width;
    shape->area_um2 /= width * width;
    shape->volume_um3 /= width * width * width;
  }
  return found;
}

BranchShapes::BranchShapes(std::vector<SampledBranch> branches, const BranchConditions& conditions)
    : branches_(std::move(branches)), radii_(by_radius(branches_)), conditions_(conditions) {
  assert(radii_.size() > 1);
}

std::variant<CellShape, NoShape> BranchShapes::shape(const VirtualCell& cell) const {
  const double width = conditions_.width_ratio(), load = conditions_.load(cell.viscosity_mPas);
  const double stiffness = cell.stiffness / load / (conditions_.is_shell ? width * width : width * width * width);
  return conditions_.in_channel(at(cell.radius_um * width, stiffness));
}

std::variant<CellShape, NoShape> BranchShapes::at(double radius_um, double stiffness) const {
  if (!(radius_um >= radii_.front().radius_um())) return NoShape::too_small;
  if (radius_um > radii_.back().radius_um()) return NoShape::too_large;
  const auto above = std::ranges::upper_bound(radii_, radius_um, {}, &RadiusBranches::radius_um);
  const auto second = std::clamp<std::ptrdiff_t>(above - radii_.begin(), 1, std::ssize(radii_) - 1);
  const auto state = [&](std::ptrdiff_t i) { return scaled_state(radii_[static_cast<std::size_t>(i)], stiffness); };
  std::vector<ScaledState> states;
  for (const auto i : {second - 1, second}) {  // both neighbours must have the state, the next ones may
    auto found = state(i);
    if (!found)
      return stiffness > radii_[static_cast<std::size_t>(i)].stiffest().stiffness ? NoShape::too_stiff
                                                                                  : NoShape::too_soft;
    states.push_back(std::move(*found));
  }
  for (const auto i : {second - 2, second + 1})
    if (i >= 0 && i < std::ssize(radii_))
      if (auto found = state(i)) states.push_back(std::move(*found));
  return blended(radius_um, states);
}

std::string BranchShapes::description() const {
  const double width = conditions_.channel_width_um / conditions_.simulated_width_um;
  return fmt::format("simulated branches, {} radii from {:.4g} to {:.4g} um", radii_.size(),
                     radii_.front().radius_um() * width, radii_.back().radius_um() * width);
}

}  // namespace rheocyte
