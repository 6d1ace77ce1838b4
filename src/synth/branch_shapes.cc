#include "synth/branch_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "numeric/lagrange.h"

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

CellShape blended(double radius_um, std::span<const ScaledState> states) {
  std::vector<double> radii;
  for (const auto& state : states) radii.push_back(state.radius_um);
  const auto weights = lagrange_weights(radii, radius_um).value;
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

std::variant<CellShape, NoShape> scaled(std::variant<CellShape, NoShape> found, const ScaleFactors& scale) {
  if (auto* const shape = std::get_if<CellShape>(&found)) {
    shape->meridian *= scale.length;
    shape->area_um2 *= scale.area;
    shape->volume_um3 *= scale.volume;
  }
  return found;
}

BranchShapes::BranchShapes(std::vector<SampledBranch> branches, const SimulatedCells& cells)
    : branches_(std::move(branches)), radii_(by_radius(branches_)), cells_(cells) {
  assert(radii_.size() > 1);
}

std::variant<CellShape, NoShape> BranchShapes::shape(const VirtualCell& cell) const {
  const ScaleFactors scale = cells_.scale_for(cell);
  const double stiffness = cell.stiffness / (cells_.is_shell ? scale.cortex_modulus : scale.modulus);
  return scaled(at(cell.radius_um / scale.length, stiffness), scale);
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
  const double width = cells_.flow.width_um / cells_.simulated.width_um;
  return fmt::format("simulated branches, {} radii from {:.4g} to {:.4g} um", radii_.size(),
                     radii_.front().radius_um() * width, radii_.back().radius_um() * width);
}

}  // namespace rheocyte
