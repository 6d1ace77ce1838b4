#include "infer/square_shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

/// Of the changes of a solid, what those of a cell with a cortex are: by direct solutions of both sections for shares
/// of 0.2, 0.5 and 1 (docs/theory-extract.md, sec. "The square channel").
ShapeVector shares_of_change(double cortex_share) {
  ShapeVector shares = ShapeVector::Constant(1 - 0.4 * cortex_share);
  for (int k = min_mode + 1; k <= max_mode; k += 2)
    shares(int(ShapeFeature::first_mode) + k - min_mode) = 1 - 0.5 * std::sqrt(cortex_share);
  return shares;
}

}  // namespace

SquareShapes::SquareShapes(const CombinedInterpolation& tube, const ChannelFlow& simulated, const ModulusMap& square)
    : tube_(tube), simulated_(simulated), square_(square, simulated) {
  assert(tube.box().least(int(CellCoordinate::cortex_share)) == 0);
}

SquareShapes::Solid SquareShapes::solid_of(double area_um2, double modulus_kPa) const {
  constexpr int x_radius = int(CellCoordinate::log_radius), x_progress = int(CellCoordinate::log_progress);
  const CellBox& box = tube_.box();
  CellCoordinates cell = box.least;
  cell(int(CellCoordinate::axial_ratio)) = 0;
  cell(x_radius) = std::log(area_um2 / std::numbers::pi) / 2;
  CombinedState state;
  constexpr int rounds = 3, halvings = 30;  // the area of a cell changes by some per cent; of ten: to 1e-8
  for (int round = 0; round < rounds; ++round) {
    cell(x_radius) = std::clamp(cell(x_radius), box.least(x_radius), box.greatest(x_radius));
    double low = box.least(x_progress), high = box.greatest(x_progress);
    for (int i = 0; i < halvings; ++i) {
      cell(x_progress) = (low + high) / 2;
      state = tube_.at(cell);
      (state.value(log_stiffness_row) > std::log(modulus_kPa) ? low : high) = cell(x_progress);
    }
    cell(x_radius) += (std::log(area_um2) - state.value(log_area_row)) / 2;
  }
  Solid solid{std::exp(state.value(log_stiffness_row)), ShapeVector::Zero()};
  solid.shape(int(ShapeFeature::area_um2)) = std::log(area_um2);
  solid.shape(int(ShapeFeature::deformation)) = state.value(deformation_row);
  solid.shape(int(ShapeFeature::moment_ratio)) = state.value(moment_ratio_row);
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    solid.shape(int(ShapeFeature::first_mode) + k - min_mode) = state.value(first_mode_row + k - min_mode);
  return solid;
}

SquareShapes::Change SquareShapes::change(const ShapeVector& smooth, const ChannelFlow& flow,
                                          double cortex_share) const {
  const double area = std::exp(smooth(int(ShapeFeature::area_um2))) * scale_factors(flow, simulated_).area;
  constexpr int third = int(ShapeFeature::first_mode) + 3 - min_mode;
  // The tension that elongates cells is in both channels the same, and the third mode is not of its making.
  const double seen = tube_.is_elongated() ? square_.deformation_by_mode_3(area, std::max(smooth(third), 0.0))
                                           : std::max(smooth(int(ShapeFeature::deformation)), 0.0);
  const Solid tube = solid_of(area, square_.modulus_kPa(area, seen));
  const ShapeVector square = square_.shape(area, square_.deformation_by_modulus(area, tube.modulus_kPa));
  Change change;
  change.errors.bias = square - tube.shape;
  change.errors.covariance.diagonal() = (left_by_section * change.errors.bias).cwiseAbs2();
  change.errors.bias = change.errors.bias.cwiseProduct(shares_of_change(cortex_share));
  change.factor_of_mode_3 = square(third) / tube.shape(third);
  return change;
}

}  // namespace rheocyte
