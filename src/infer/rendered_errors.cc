#include "infer/rendered_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "measurement/shape_in_pixels.h"

namespace rheocyte {

namespace {

// Stiffer cells are round for a camera.
constexpr double min_deformation = 1e-3;
constexpr int outline_points = 400;

std::array<double, mode_count> modes_of(const CombinedState& state) {
  std::array<double, mode_count> modes{};
  for (int k = 0; k < mode_count; ++k) modes[std::size_t(k)] = state.value(first_mode_row + k);
  return modes;
}

}  // namespace

RenderedErrors::RenderedErrors(const CombinedInterpolation& table, double pixel_size_um, int draws)
    : box_(table.box()) {
  double& least = box_.least(int(CellCoordinate::log_deformation));
  least = std::max(least, std::log(min_deformation));
  std::uint64_t number = 0;
  for (int i = 0; i < nodes[0]; ++i)
    for (int j = 0; j < nodes[1]; ++j)
      for (int k = 0; k < nodes[2]; ++k) {
        CellCoordinates cell = box_.least;
        const std::array<double, axes> share{double(i) / (nodes[0] - 1), double(j) / (nodes[1] - 1),
                                             double(k) / (nodes[2] - 1)};
        for (int axis = 0; axis < axes; ++axis)
          cell(axis) += share[std::size_t(axis)] * (box_.greatest(axis) - box_.least(axis));
        const auto state = table.at(cell);
        CellRandom random(1, number++, Purpose::picture);
        const auto outline = outline_of_modes(modes_of(state), std::exp(state.value(log_area_row)), outline_points);
        errors_.push_back(errors_in_pixels(outline, pixel_size_um, draws, random));
      }
}

ShapeErrors RenderedErrors::at(const CellCoordinates& cell) const {
  std::array<int, axes> below{};
  std::array<double, axes> share{};
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto a = Eigen::Index(axis);
    const double range = box_.greatest(a) - box_.least(a);
    const double place =
        std::clamp((cell(a) - box_.least(a)) / (range > 0 ? range : 1) * (nodes[axis] - 1), 0., nodes[axis] - 1.);
    below[axis] = std::min(int(place), nodes[axis] - 2);
    share[axis] = place - below[axis];
  }
  ShapeErrors sum;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, axes> at{};
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const int up = corner >> axis & 1;
      at[axis] = below[axis] + up;
      weight *= up ? share[axis] : 1 - share[axis];
    }
    const auto& node = errors_[std::size_t((at[0] * nodes[1] + at[1]) * nodes[2] + at[2])];
    sum.bias += weight * node.bias;
    sum.covariance += weight * node.covariance;
  }
  return sum;
}

ModuliEstimate fit_pixels(const SeveralModuli& moduli, const RenderedErrors& errors, const ShapeVector& measured,
                          const ChannelFlow& flow, const SquareShapes* square) {
  constexpr int rounds = 3;  // the bias hardly depends on the cell: the third one changes nothing that matters
  constexpr int x_share = int(CellCoordinate::cortex_share);
  CellCoordinates cell = errors.middle();
  ModuliEstimate estimate;
  for (int round = 0; round < rounds; ++round) {
    ShapeErrors added = errors.at(cell);
    SquareShapes::Change by_square;
    if (square && measured.allFinite()) by_square = square->change(measured - added.bias, flow, cell(x_share));
    added.bias += by_square.errors.bias;
    added.covariance += by_square.errors.covariance;
    estimate = moduli.fit({measured, added}, flow);
    estimate.section_factor = by_square.factor_of_mode_3;
    if (estimate.status == ModuliStatus::no_data) break;
    cell = estimate.cell;
  }
  return estimate;
}

}  // namespace rheocyte
