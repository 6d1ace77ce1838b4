#include "synth/grid_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "case/channel_flow.h"
#include "synth/branch_shapes.h"
#include "synth/outline.h"
#include "synth/seen_outline.h"

namespace rheocyte {

namespace {

constexpr double agreement = 1e-7;  // relative, of the radius

double sphere_of(double volume) { return std::cbrt(3 / (4 * std::numbers::pi) * volume); }

}  // namespace

GridShapes::GridShapes(GridContent grid, const ChannelFlow& flow)
    : grid_(std::move(grid)), shapes_(grid_.content().shapes.value()), flow_(flow) {
  assert(!grid_.origin().is_shell);
}

double GridShapes::log_deformation(double log_modulus, double area_um2, const StiffnessGrid::Range& range) const {
  constexpr int halvings = 40;
  double stiff = range.lower, soft = range.upper;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (stiff + soft);
    (grid_.answer(area_um2, std::exp(middle)).log_stiffness > log_modulus ? stiff : soft) = middle;
  }
  return 0.5 * (stiff + soft);
}

Eigen::MatrixX2d GridShapes::outline_of(const CellShape& shape, bool as_seen) const {
  const auto of_grid = shapes_.modes(std::log(shape.area_um2), shape.deformation);
  if (!as_seen) return outline_of_modes(of_grid, shape.area_um2, outline_points);
  RadiusModes modes;
  std::copy_n(of_grid.begin(), modes.size(), modes.begin());
  return outline_seen_with(modes, shape.deformation, shape.area_um2);
}

// The area of a cell hardly depends on its shape, so that it is found in a few steps.
std::optional<NoShape> GridShapes::settle(double radius_um, double log_modulus, bool as_seen, CellShape& shape) const {
  constexpr int max_steps = 20;
  for (int step = 0; step < max_steps; ++step) {
    const auto range = grid_.smooth_range(shape.area_um2);
    if (!range)
      return std::log(shape.area_um2) < grid_.content().min_log_area ? NoShape::too_small : NoShape::too_large;
    shape.deformation = std::exp(log_deformation(log_modulus, shape.area_um2, *range));
    const Eigen::MatrixX2d outline = outline_of(shape, as_seen);
    shape.volume_um3 = volume_of_revolution(outline);
    const double ratio = radius_um / sphere_of(shape.volume_um3);
    if (std::abs(ratio - 1) < agreement) {
      if (log_modulus > grid_.answer(shape.area_um2, std::exp(range->lower)).log_stiffness) return NoShape::too_stiff;
      if (log_modulus < grid_.answer(shape.area_um2, std::exp(range->upper)).log_stiffness) return NoShape::too_soft;
      shape.meridian = outline.topRows(outline_points / 2 + 1);
      return {};
    }
    shape.area_um2 *= ratio * ratio;
  }
  return NoShape::too_soft;
}

// By the sum of the modes first, which takes a twentieth of the time: most cells that the table does not hold end
// there.
std::variant<CellShape, NoShape> GridShapes::at(double radius_um, double modulus_kPa) const {
  CellShape shape;
  shape.area_um2 = std::numbers::pi * radius_um * radius_um;
  for (const bool as_seen : {false, true})
    if (const auto none = settle(radius_um, std::log(modulus_kPa), as_seen, shape)) return *none;
  return shape;
}

std::variant<CellShape, NoShape> GridShapes::shape(const VirtualCell& cell) const {
  const ScaleFactors scale = scale_factors(grid_.origin().flow, {flow_.width_um, flow_.rate_ul_s, cell.viscosity_mPas});
  if (!(cell.stiffness > 0)) return NoShape::too_soft;
  if (!(cell.radius_um > 0)) return NoShape::too_small;
  return scaled(at(cell.radius_um / scale.length, cell.stiffness / scale.modulus), scale);
}

std::string GridShapes::description() const { return "table " + grid_.origin().description(); }

}  // namespace rheocyte
