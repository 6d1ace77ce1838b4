#include "infer/rendered_errors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>

#include "measurement/shape_in_pixels.h"

namespace rheocyte {

namespace {

// Stiffer cells are round for a camera.
constexpr double min_deformation = 1e-3;
// Of elongated cells, not all of which go farther.
constexpr double min_mode_3 = 0.005, max_mode_3 = 0.125;
constexpr int outline_points = 400, draws_of_one_cell = 300, draws_of_mean = 500;

std::array<double, mode_count> modes_of(const CombinedState& state) {
  std::array<double, mode_count> modes{};
  for (int k = 0; k < mode_count; ++k) modes[std::size_t(k)] = state.value(first_mode_row + k);
  return modes;
}

/// Random numbers of its own for each cell: what is left of the mean over the places is not the same for all cells of a
/// recording. By what was measured of it, so that they do not depend on the other cells, and by seven digits, so that
/// they do not depend on the last ones of a machine's logarithm.
CellRandom random_of(const ShapeVector& measured) {
  const auto bits = [&](ShapeFeature f) {
    return std::uint64_t(std::bit_cast<std::uint32_t>(float(measured(int(f)))));
  };
  return {1, bits(ShapeFeature::area_um2) << 32U | bits(ShapeFeature::deformation), Purpose::picture};
}

/// Corners of the box lie beyond the table: the softest cell on the way there that it has, or the stiffest of all.
CombinedState nearest_state(const CombinedInterpolation& table, CellCoordinates cell) {
  constexpr double step = 0.05;
  const double stiffest = table.box().least(x_progress);
  while (!table.is_inside(cell) && cell(x_progress) > stiffest)
    cell(x_progress) = std::max(cell(x_progress) - step, stiffest);
  return table.at(cell);
}

}  // namespace

RenderedErrors::RenderedErrors(const CombinedInterpolation& table, double pixel_size_um, const OutlineNoise& noise_um,
                               int draws)
    : table_(table),
      pixel_size_um_(pixel_size_um),
      noise_um_(noise_um),
      box_(table.box()),
      is_over_mode_3_(table.is_elongated()) {
  if (is_over_mode_3_) {
    nodes_ = {4, 3, 5, 1, 4};
    box_.least(x_progress) = std::max(box_.least(x_progress), std::log(min_mode_3));
    box_.greatest(x_progress) = std::min(box_.greatest(x_progress), std::log(max_mode_3));
  } else {
    box_.least(x_progress) = std::max(box_.least(x_progress), std::log(min_deformation));
  }
  const std::size_t count = count_of(nodes_);
  for (std::uint64_t number = 0; errors_.size() < count; ++number) {
    CellCoordinates cell = box_.least;
    auto rest = std::size_t(number);
    for (int axis = coordinate_count - 1; axis >= 0; --axis) {
      const auto n = std::size_t(nodes_[std::size_t(axis)]);
      if (n > 1) cell(axis) = node_place(axis, double(rest % n) / double(n - 1));
      rest /= n;
    }
    CellRandom random(1, number, Purpose::picture);
    errors_.push_back(rendered(nearest_state(table, cell), draws, random));
  }
}

ShapeErrors RenderedErrors::rendered(const CombinedState& state, int draws, CellRandom& random) const {
  const auto outline = outline_of_modes(modes_of(state), std::exp(state.value(log_area_row)), outline_points);
  return errors_in_pixels(outline, pixel_size_um_, draws, random, noise_um_);
}

std::size_t RenderedErrors::count_of(const Nodes& nodes) {
  return std::accumulate(nodes.begin(), nodes.end(), std::size_t{1}, std::multiplies<>());
}

double RenderedErrors::scale(int axis, double coordinate) const {
  return axis == x_progress && is_over_mode_3_ ? std::exp(coordinate) : coordinate;
}

double RenderedErrors::node_place(int axis, double fraction) const {
  const double scaled = std::lerp(scale(axis, box_.least(axis)), scale(axis, box_.greatest(axis)), fraction);
  return axis == x_progress && is_over_mode_3_ ? std::log(scaled) : scaled;
}

ShapeErrors RenderedErrors::at(const CellCoordinates& cell) const {
  Nodes below{};
  std::array<double, coordinate_count> fraction{};
  for (std::size_t axis = 0; axis < coordinate_count; ++axis) {
    const auto a = Eigen::Index(axis);
    const double least = scale(int(axis), box_.least(a)), range = scale(int(axis), box_.greatest(a)) - least;
    const double last = nodes_[axis] - 1;
    const double place = std::clamp((scale(int(axis), cell(a)) - least) / (range > 0 ? range : 1) * last, 0., last);
    below[axis] = std::min(int(place), std::max(nodes_[axis] - 2, 0));
    fraction[axis] = place - below[axis];
  }
  ShapeErrors sum;
  for (int corner = 0; corner < 1 << coordinate_count; ++corner) {
    double weight = 1;
    std::size_t number = 0;
    for (std::size_t axis = 0; axis < coordinate_count; ++axis) {
      const int up = corner >> axis & 1;
      number = number * std::size_t(nodes_[axis]) + std::size_t(below[axis] + up);
      weight *= up ? fraction[axis] : 1 - fraction[axis];
    }
    if (weight == 0) continue;  // also what would lie beyond a single node
    const auto& node = errors_[number];
    sum.bias += weight * node.bias;
    sum.covariance += weight * node.covariance;
  }
  return sum;
}

ShapeErrors RenderedErrors::of(const CellCoordinates& cell, CellRandom random) const {
  const CombinedState state = table_.at(cell);
  return state.inside ? rendered(state, draws_of_one_cell, random) : at(cell);
}

ShapeErrors RenderedErrors::of_outline(const ShapeVector& shape, CellRandom random) const {
  return errors_in_pixels(outline_of(shape), pixel_size_um_, draws_of_mean, random, noise_um_);
}

Eigen::MatrixX2d outline_of(const ShapeVector& smooth) {
  std::array<double, mode_count> modes{};
  for (int m = 0; m < mode_count; ++m) modes[std::size_t(m)] = smooth(int(ShapeFeature::first_mode) + m);
  return outline_of_modes(modes, std::exp(smooth(int(ShapeFeature::area_um2))), outline_points);
}

namespace {

/// A shape with the errors of its pixels, as such a cell of the table, whose channel is the tube, would have them.
SeenShape with_section(const ShapeErrors& pixels, const ShapeVector& measured, const Sight& sight,
                       const CellCoordinates& cell, double table_exponent) {
  SeenShape seen{{measured, pixels}};
  ShapeErrors& added = seen.shape.errors;
  if (sight.section == Section::tube || !measured.allFinite()) return seen;
  constexpr int mode_2 = int(ShapeFeature::first_mode), mode_3 = mode_2 + 1;
  const ShapeVector smooth = measured - added.bias;
  const double fraction = cell(x_fraction);
  const ShapeErrors by_square = change_by_square(
      {.radius = std::exp(smooth(int(ShapeFeature::area_um2)) / 2) * 2 * std::numbers::inv_sqrtpi / sight.flow.width_um,
       .mode_2 = smooth(mode_2),
       .mode_3 = smooth(mode_3),
       .cortex_fraction = fraction,
       .cortex_tension = fraction * cell(x_ratio),
       .thinning = table_exponent - sight.flow.exponent});
  added.bias += by_square.bias;
  added.covariance += by_square.covariance * sight.error_factor * sight.error_factor;
  seen.section_factor = smooth(mode_3) / (smooth(mode_3) - by_square.bias(mode_3));
  return seen;
}

}  // namespace

std::optional<SeenShape> seen_shape(const BulkCortexFit& moduli, const RenderedErrors& errors,
                                    const ShapeVector& measured, const Sight& sight, const AxialTension& tension,
                                    double pictures) {
  constexpr int rounds = 2;  // the bias hardly depends on the cell: a third one changes nothing that matters
  const auto seen_at = [&](ShapeErrors pixels, const CellCoordinates& cell) {
    pixels.covariance /= pictures;
    return with_section(pixels, measured, sight, cell, moduli.simulated().exponent);
  };
  CellCoordinates cell = errors.middle();
  for (int round = 0; round < rounds; ++round) {
    const auto nearest =
        moduli.nearest(seen_at(errors.at(cell), cell).shape, sight.flow, tension, round == 0 ? nullptr : &cell);
    if (!nearest) return {};
    cell = nearest->cell;
  }
  const CellRandom random = random_of(measured);
  ShapeErrors pixels = errors.of(cell, random);
  const double log_length = std::log(scale_factors(moduli.simulated(), sight.flow).length);
  // The mean of several pictures is nearly smooth itself, and need not have the shape of a cell of the table.
  for (int round = 0; round < rounds && pictures > 1; ++round) {
    ShapeVector smooth = measured - pixels.bias;
    smooth(int(ShapeFeature::area_um2)) -= 2 * log_length;
    pixels = errors.of_outline(smooth, random);
  }
  return seen_at(pixels, cell);
}

ModuliEstimate fit_pixels(const BulkCortexFit& moduli, const RenderedErrors& errors, const ShapeVector& measured,
                          const Sight& sight, const AxialTension& tension) {
  const auto seen = seen_shape(moduli, errors, measured, sight, tension);
  if (!seen) return {};
  ModuliEstimate estimate = moduli.fit(seen->shape, sight.flow, tension);
  estimate.section_factor = seen->section_factor;
  return estimate;
}

}  // namespace rheocyte
