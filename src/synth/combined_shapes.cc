#include "synth/combined_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "numeric/roots.h"

namespace rheocyte {

namespace {

constexpr int points_of_outline = 720;

std::vector<SampledBranch> without_empty(std::vector<SampledBranch> branches) {
  std::erase_if(branches, [](const SampledBranch& branch) { return branch.empty(); });
  return branches;
}

}  // namespace

CombinedShapes::CombinedShapes(const TableSpec& spec, std::vector<SampledBranch> branches, const SimulatedCells& cells)
    : branches_(without_empty(std::move(branches))), between_(make_combined_table(spec, branches_)), cells_(cells) {}

CombinedShapes::CombinedShapes(const CombinedTable& table, const SimulatedCells& cells)
    : between_(table), cells_(cells) {}

std::variant<CellShape, NoShape> CombinedShapes::shape(const VirtualCell& cell) const {
  const ScaleFactors scale = cells_.scale_for(cell);
  const double radius = cell.radius_um / scale.length, young = cell.stiffness / scale.modulus;
  const double cortex = cell.cortex_modulus_mN_per_m / scale.cortex_modulus, S = young + cortex / radius;
  if (!(radius > 0)) return NoShape::too_small;
  if (!(S > 0)) return NoShape::too_soft;
  // One tension is that of all cells; without a cortex there is none, and all sheets are the same.
  const auto& ratios = tension_ratios();
  const double ratio =
      ratios.size() == 1 || !(cortex > 0) ? ratios.front() : cell.tension_mN_per_m / cell.cortex_modulus_mN_per_m;
  CellCoordinates place = CellCoordinates::Zero();
  place(x_radius) = std::log(radius);
  place(x_fraction) = cortex / radius / S;
  place(x_ratio) = ratio;
  place(x_axial) = 1e-3 * cell.axial_tension_Pa / scale.modulus / S;
  return scaled(at(place, std::log(S)), scale);
}

// Where the table has this stiffness: it falls the more the flow deforms the cell.
std::variant<CellShape, NoShape> CombinedShapes::at(CellCoordinates cell, double log_stiffness) const {
  const CellBox& box = between_.box();
  if (cell(x_radius) < box.least(x_radius)) return NoShape::too_small;
  if (cell(x_radius) > box.greatest(x_radius)) return NoShape::too_large;
  for (const int x : {x_fraction, x_ratio})
    if (!(cell(x) >= box.least(x) && cell(x) <= box.greatest(x))) return NoShape::outside_sheets;
  if (!(cell(x_axial) >= box.least(x_axial) && cell(x_axial) <= box.greatest(x_axial)))
    return NoShape::outside_tensions;
  const double low = box.least(x_progress), high = box.greatest(x_progress);
  CellLine line = between_.line(cell);
  const auto excess = [&](double progress) {
    const CellFunction found = line.log_stiffness(progress);
    return ValueAndSlope{found.value - log_stiffness, found.gradient(x_progress)};
  };
  if (excess(low).value < 0) return NoShape::too_stiff;
  if (excess(high).value > 0) return NoShape::too_soft;
  cell(x_progress) = bracketed_newton(excess, low, high, (low + high) / 2, false, 1e-12);
  if (!between_.is_inside(cell)) return NoShape::too_soft;  // all branches begin alike but end one by one
  return branches_.empty() ? by_modes(between_.at(cell)) : blended(cell);
}

CellShape CombinedShapes::by_modes(const CombinedState& state) const {
  std::array<double, mode_count> modes{};
  for (int k = 0; k < mode_count; ++k) modes[std::size_t(k)] = state.value(first_mode_row + k);
  CellShape shape;
  shape.area_um2 = std::exp(state.value(log_area_row));
  const Eigen::MatrixX2d outline = outline_of_hull_modes(modes, shape.area_um2, points_of_outline);
  shape.meridian = outline.topRows(points_of_outline / 2 + 1);  // from the front to the rear
  shape.meridian.col(1) = shape.meridian.col(1).cwiseMax(0);
  shape.deformation = state.value(deformation_row);
  shape.volume_um3 = volume_of_revolution(outline);
  return shape;
}

CellShape CombinedShapes::blended(const CellCoordinates& cell) const {
  const double radius = std::exp(cell(x_radius));
  CellShape shape;
  shape.meridian = Eigen::MatrixX2d::Zero(branches_.front().contour.front().rows(), 2);
  for (const auto& [number, weight, stiffness_kPa] : between_.weights(cell)) {
    const SampledBranch& branch = branches_[std::size_t(number)];
    const double stiffness = std::clamp(stiffness_kPa, branch.stiffness.back(), branch.stiffness.front());
    const double scale = radius / branch.radius_um;
    shape.meridian += weight * scale * interpolate_contour(branch, stiffness);
    shape.volume_um3 += weight * scale * scale * scale * interpolate(branch, Measure::volume_um3, stiffness);
  }
  const CombinedState state = between_.at(cell);
  shape.area_um2 = std::exp(state.value(log_area_row));
  shape.deformation = state.value(deformation_row);
  return shape;
}

std::string CombinedShapes::description() const {
  const double width = cells_.flow.width_um / cells_.simulated.width_um;
  const auto& radii = between_.radii_um();
  const CellBox& box = between_.box();
  return fmt::format(
      "simulated branches of combined cells, {} radii from {:.4g} to {:.4g} um, fractions of the cortex from {:g} to "
      "{:g}, "
      "tensions from {:g} to {:g} E2D, {} up to {:.3g}",
      radii.size(), radii.front() * width, radii.back() * width, box.least(x_fraction), box.greatest(x_fraction),
      box.least(x_ratio), box.greatest(x_ratio),
      between_.is_elongated()
          ? fmt::format("axial tensions from {:g} to {:g} S, third modes", box.least(x_axial), box.greatest(x_axial))
          : "deformations",
      std::exp(box.greatest(x_progress)));
}

}  // namespace rheocyte
