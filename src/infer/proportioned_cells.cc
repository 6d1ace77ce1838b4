#include "infer/proportioned_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "case/user_error.h"
#include "measurement/shape_in_pixels.h"

namespace rheocyte {

namespace {

constexpr std::array figure{int(ShapeFeature::area_um2), int(ShapeFeature::deformation),
                            int(ShapeFeature::moment_ratio)};
constexpr int mode_2 = feature_of_mode(2), mode_3 = feature_of_mode(3);

/// Of the noise of one picture, what stays in the median of many: the rest of the laws of pixels, and which pixels of
/// the edge belong to a mask (extract/common_errors.h has the same parts of the deformation's).
constexpr double left_of_picture = 0.39;
constexpr int draws = 400;
constexpr int rounds_of_section = 3;  // the change by the square hardly depends on the shape
/// From which cells alike are looked for, in parts of the stiffness; those whose features cannot be distinguished at 90
/// % and whose moduli differ by more than this logarithm count.
constexpr std::array other_stiffnesses{0.35, 0.6, 1.7, 2.8};
constexpr double same_chi_squared = 2.7, same_modulus = 0.1;
/// Variances that leave the covariance regular where there are neither pixels nor a square channel.
constexpr double least_variance = 1e-8;

/// Where the search begins. The third mode of elongated cells is near this.
ShapeVector first_shape(const SeenFigure& seen) {
  constexpr double usual_mode_3 = 0.06;
  ShapeVector shape = ShapeVector::Zero();
  for (std::size_t i = 0; i < figure.size(); ++i) shape(figure[i]) = seen.value(Eigen::Index(i));
  const double axes = 1 / std::sqrt(shape(int(ShapeFeature::moment_ratio)));
  shape(mode_2) = (axes - 1) / (axes + 1);
  shape(mode_3) = usual_mode_3;
  return shape;
}

/// With that of the modes, which are not fitted.
void set_figure(const Eigen::Matrix3d& covariance, ShapeErrors& errors) {
  errors.covariance.setIdentity();
  for (std::size_t i = 0; i < figure.size(); ++i)
    for (std::size_t k = 0; k < figure.size(); ++k)
      errors.covariance(figure[i], figure[k]) = covariance(Eigen::Index(i), Eigen::Index(k));
}

/// A dented rear has a hull with corners, of which the outline by twelve modes lacks a part of the deformation; pixels
/// take a part of that. By 345 contours of HL-2D-NH-26 in pixels of 0.34 um: of the deformation's excess 13 +- 8 % of
/// what is lacking, of that of Lambda1 / Lambda2 26 +- 30 % (rms without it 0.0011 and 0.0026, with it 0.0004 and
/// 0.0017).
void add_lost_corners(double lacking_deformation, ShapeErrors& pixels) {
  constexpr int deformation = int(ShapeFeature::deformation), moment_ratio = int(ShapeFeature::moment_ratio);
  struct Part {
    int feature;
    double mean, deviation;
  };
  for (const auto& [feature, mean, deviation] : {Part{deformation, -0.13, 0.08}, Part{moment_ratio, 0.26, 0.3}}) {
    pixels.bias(feature) += mean * lacking_deformation;
    pixels.covariance(feature, feature) += std::pow(deviation * lacking_deformation / left_of_picture, 2);
  }
}

/// Lambda1 / Lambda2 has an error within which every cell lies.
Eigen::Matrix3d without_ratio(Eigen::Matrix3d covariance) {
  constexpr double variance = 1e4;
  covariance.row(2).setZero();
  covariance.col(2).setZero();
  covariance(2, 2) = variance;
  return covariance;
}

Eigen::Matrix3d figure_of(const ShapeErrors& errors) { return errors.covariance(figure, figure); }

}  // namespace

ProportionedCells::ProportionedCells(const CombinedTable& table)
    : between_(table),
      simulated_(channel_flow_of(table.spec.base)),
      fit_(between_, simulated_, {features_of_figure(), false, between_.tension_ratios().front()}) {
  const CellBox& box = between_.box();
  if (!between_.is_elongated() || between_.tension_ratios().size() > 1 ||
      box.least(x_fraction) != box.greatest(x_fraction))
    throw UserError(fmt::format(
        "{}: cells of fixed proportions have one table.cortex_fraction, one table.tension_ratio and table.axial_ratio.",
        table.spec.identifier));
}

double ProportionedCells::effective_modulus_kPa(const CellCoordinates& cell) const {
  CombinedState state;
  state.value.setZero();
  state.value(log_stiffness_row) = between_.line(cell).log_stiffness(cell(x_progress)).value;
  state.gradient.setZero();
  return rheocyte::effective_modulus_kPa(fit_.at_rest(), cell, state).value;
}

ShapeVector ProportionedCells::in_tube(const CellCoordinates& cell, const ChannelFlow& flow) const {
  const auto values = between_.values_at(cell);
  ShapeVector shape;
  for (int feature = 0; feature < feature_count; ++feature) shape(feature) = values(row_of(feature));
  shape(int(ShapeFeature::area_um2)) += std::log(scale_factors(simulated_, flow).area);
  return shape;
}

CellInSquare ProportionedCells::in_square(const CellCoordinates& cell, const ShapeVector& smooth,
                                          const Sight& sight) const {
  return {
      .radius = std::exp(smooth(int(ShapeFeature::area_um2)) / 2) * 2 * std::numbers::inv_sqrtpi / sight.flow.width_um,
      .mode_2 = smooth(mode_2),
      .mode_3 = smooth(mode_3),
      .cortex_fraction = cell(x_fraction),
      .cortex_tension = cell(x_fraction) * cell(x_ratio),
      .thinning = simulated_.exponent - sight.flow.exponent};
}

ShapeVector ProportionedCells::change_by_section(const CellCoordinates& cell, const ShapeVector& in_tube,
                                                 const Sight& sight, int rounds) const {
  ShapeVector change = ShapeVector::Zero();
  if (sight.section != Section::square) return change;
  for (int round = 0; round < rounds; ++round) change = mean_change_by_square(in_square(cell, in_tube + change, sight));
  return change;
}

ShapeErrors ProportionedCells::added_by_section(const CellCoordinates& cell, const ShapeVector& in_tube,
                                                const Sight& sight) const {
  if (sight.section != Section::square) return {};
  const ShapeVector smooth = in_tube + change_by_section(cell, in_tube, sight, rounds_of_section - 1);
  return change_by_square(in_square(cell, smooth, sight));
}

ShapeVector ProportionedCells::change_by_section(const CellCoordinates& cell, const Sight& sight) const {
  return change_by_section(cell, in_tube(cell, sight.flow), sight, rounds_of_section);
}

ProportionedCells::Added ProportionedCells::added(const CellCoordinates& cell, const Sight& sight,
                                                  double pixel_size_um) const {
  const ShapeVector in_tube = this->in_tube(between_.nearest_inside(cell), sight.flow);
  ShapeErrors by_square = added_by_section(cell, in_tube, sight);
  by_square.covariance *= sight.error_factor * sight.error_factor;
  if (!(pixel_size_um > 0)) return {by_square, {}};
  const ShapeVector smooth = in_tube + by_square.bias;
  CellRandom random{1, 0, Purpose::picture};  // the same places for all recordings, whose ratios they leave alone
  const Eigen::MatrixX2d outline = outline_of(smooth);
  ShapeErrors by_pixels = errors_in_pixels(outline, pixel_size_um, draws, random);
  add_lost_corners(smooth(int(ShapeFeature::deformation)) - outline_shape(outline).deformation, by_pixels);
  return {by_square, by_pixels};
}

ShapeVector ProportionedCells::mean_of_pixels(const ShapeVector& smooth, double pixel_size_um) const {
  // Even more than random ones: multiples of two numbers that no small multiples bring near to whole ones (Roberts
  // 2018).
  constexpr int places = 64;
  constexpr double along = 0.7548776662466927, across = 0.5698402909980532;
  const auto part = [](double number) { return number - std::floor(number); };
  const Eigen::MatrixX2d outline = outline_of(smooth);
  const OutlineShape of_outline = outline_figure(outline);
  FigureInPixels figure(outline, pixel_size_um);
  Eigen::Vector3d mean = -shape_vector(of_outline).head<3>();
  for (int i = 0; i < places; ++i) mean += figure.at({part(i * along), part(i * across)}) / places;
  ShapeErrors by_pixels;
  by_pixels.bias.head<3>() = mean;
  add_lost_corners(smooth(int(ShapeFeature::deformation)) - of_outline.deformation, by_pixels);
  return by_pixels.bias;
}

std::vector<BulkCortexFit::Candidate> ProportionedCells::from_other_stiffnesses(const MeasuredShape& shape,
                                                                                const ChannelFlow& flow,
                                                                                const AxialTension& tension,
                                                                                const CellCoordinates& cell) const {
  std::vector<BulkCortexFit::Candidate> others;
  for (const double factor : other_stiffnesses) {
    CellCoordinates start = cell;
    start(x_progress) -= std::log(factor), start(x_axial) /= factor;
    start = start.cwiseMax(between_.box().least).cwiseMin(between_.box().greatest);
    const auto other = fit_.nearest(shape, flow, tension, &start);
    if (other && other->chi_squared < same_chi_squared && between_.is_inside(other->cell)) others.push_back(*other);
  }
  return others;
}

std::optional<BulkCortexFit::Candidate> ProportionedCells::nearest(const MeasuredShape& shape, const ChannelFlow& flow,
                                                                   const AxialTension& tension,
                                                                   const CellCoordinates* start) const {
  auto nearest = fit_.nearest(shape, flow, tension, start);
  if (!nearest || between_.is_inside(nearest->cell)) return nearest;
  const auto others = from_other_stiffnesses(shape, flow, tension, nearest->cell);
  if (others.empty()) return nearest;
  return *std::ranges::min_element(others, {}, &BulkCortexFit::Candidate::chi_squared);
}

bool ProportionedCells::has_others_alike(const MeasuredShape& shape, const ChannelFlow& flow,
                                         const AxialTension& tension, const CellCoordinates& cell) const {
  const double own = effective_modulus_kPa(cell);
  return std::ranges::any_of(from_other_stiffnesses(shape, flow, tension, cell), [&](const auto& other) {
    return std::abs(std::log(effective_modulus_kPa(other.cell) / own)) > same_modulus;
  });
}

ProportionedEstimate ProportionedCells::estimate(SeenFigure seen, const Sight& sight, double pixel_size_um,
                                                 const AxialTension& tension) const {
  constexpr int rounds = 4;  // the errors hardly depend on the cell
  constexpr double usual_ratio = 0.4;
  const bool has_ratio = !std::isnan(seen.value(2)) || !tension.is_known();
  if (!has_ratio) seen = {{seen.value(0), seen.value(1), usual_ratio}, without_ratio(seen.covariance)};
  MeasuredShape shape{first_shape(seen), {}};
  set_figure(seen.covariance, shape.errors);
  std::optional<BulkCortexFit::Candidate> nearest;
  Added errors;
  for (int round = 0; round < rounds; ++round) {
    nearest = this->nearest(shape, sight.flow, tension, nearest ? &nearest->cell : nullptr);
    if (!nearest) return {};
    errors = added(nearest->cell, sight, pixel_size_um);
    shape.errors.bias = errors.by_square.bias + errors.by_pixels.bias;
  }
  const auto with_errors = [&](const Eigen::Matrix3d& covariance) {
    set_figure(has_ratio ? covariance : without_ratio(covariance), shape.errors);
    return fit_.fit(shape, sight.flow, tension, &nearest->cell);
  };
  const Eigen::Matrix3d of_picture = figure_of(errors.by_pixels);
  Eigen::Matrix3d in_common = left_of_picture * left_of_picture * of_picture + figure_of(errors.by_square);
  in_common.diagonal().array() += least_variance;
  in_common(1, 1) += std::pow(between_.spec().accuracy * seen.value(1), 2);
  ProportionedEstimate found{with_errors(seen.covariance), with_errors(in_common), {}};
  found.is_ambiguous = has_others_alike(shape, sight.flow, tension, found.by_scatter.cell);
  if (pixel_size_um > 0) found.of_picture = with_errors(of_picture);
  if (found.by_scatter.status == ModuliStatus::outside_table) {
    found.softest_kPa = effective_modulus_kPa(between_.nearest_inside(found.by_scatter.cell)) *
                        scale_factors(simulated_, sight.flow).modulus;
  }
  return found;
}

}  // namespace rheocyte
