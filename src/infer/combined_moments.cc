#include "infer/combined_moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int newton_steps_to_progress = 30;
/// Beyond the table's soft and stiff end shapes go straight on, so far in ln of the progress.
constexpr double beyond_soft_end = 0.5, beyond_stiff_end = 3;
/// A slope of ln of the stiffness by ln of the progress that is never exceeded.
constexpr double least_slope_of_stiffness = -0.1;
/// Of what the law of the square leaves of single cells, what two cells of one population have in common
/// (studies/square_law.py: 0.4 and 0.07 of cells that are within and about two and more of its spreads from one
/// another).
constexpr double variance_in_common = 0.2;

CellCoordinates held(const CellCoordinates& cell, const CellBox& box) {
  return cell.cwiseMax(box.least).cwiseMin(box.greatest);
}

}  // namespace

CombinedMoments::CombinedMoments(const BulkCortexFit& moduli, const Sight& sight, double pixel_size_um,
                                 const OutlineNoise& outline_noise)
    : moduli_(moduli),
      sight_(sight),
      pixel_size_um_(pixel_size_um),
      wall_stress_kPa_(1e-3 * wall_shear_stress_Pa(sight.flow)),
      outline_noise_(outline_noise),
      scale_(scale_factors(moduli.simulated(), sight.flow)) {}

CombinedMoments::Numbers CombinedMoments::numbers(const CombinedLaw& law, const Numbers& place) const {
  Numbers numbers;
  numbers << law.mean + law.root * place.head<combined_numbers>(),
      law.tension_ratio + law.ratio_spread * place(combined_numbers),
      (law.axial_tension + law.axial_spread * place(combined_numbers + 1)) * wall_stress_kPa_;
  return numbers;
}

Eigen::Matrix<double, CombinedMoments::varying, combined_parameters> CombinedMoments::by_parameters(
    const CombinedLaw& law, const Numbers& place) const {
  using enum CombinedParameter;
  Eigen::Matrix<double, varying, combined_parameters> by = Eigen::Matrix<double, varying, combined_parameters>::Zero();
  for (int k = 0; k <= combined_numbers; ++k) by(k, k) = 1;
  by(4, int(axial_tension)) = wall_stress_kPa_;
  by(0, int(log_radius_spread)) = law.root(0, 0) * place(0);
  by(1, int(stiffness_by_radius)) = by(2, int(fraction_by_radius)) = place(0);
  by(1, int(log_stiffness_spread)) = law.root(1, 1) * place(1);
  by(2, int(fraction_by_stiffness)) = place(1);
  by(2, int(log_fraction_spread)) = law.root(2, 2) * place(2);
  by(3, int(log_ratio_spread)) = law.ratio_spread * place(3);
  by(4, int(log_axial_spread)) = law.axial_spread * place(4) * wall_stress_kPa_;
  return by;
}

CellCoordinates CombinedMoments::place_in_table(const Numbers& numbers, double log_progress) const {
  CellCoordinates cell;
  cell(x_radius) = numbers(0) - std::log(scale_.length);
  cell(x_fraction) = numbers(2);
  cell(x_progress) = log_progress;
  cell(x_ratio) = numbers(3);
  cell(x_axial) = numbers(4) / std::exp(numbers(1));
  return cell;
}

/// Of the cell of the table with these numbers; how far the flow deforms it is found by Newton's method.
CombinedMoments::Shape CombinedMoments::shape_in_tube(const Numbers& numbers, double first) const {
  const double log_stiffness = numbers(1) - std::log(scale_.modulus);
  CellCoordinates cell = place_in_table(numbers, first);
  const double axial = cell(x_axial);
  const CellBox& box = moduli_.table().box();
  const double least = box.least(x_progress) - beyond_stiff_end, greatest = box.greatest(x_progress) + beyond_soft_end;
  cell(x_progress) = std::clamp(first, least, greatest);
  CellLine line = moduli_.table().line(held(cell, box));
  CellCoordinates beyond;
  const auto go_to = [&](double progress) {
    cell(x_progress) = progress;
    beyond = cell - held(cell, box);
    return progress - beyond(x_progress);
  };
  bool is_there = false;
  for (int step = 0; step < newton_steps_to_progress && !is_there; ++step) {
    const CellFunction found = line.log_stiffness(go_to(cell(x_progress)));
    const double off = found.value + found.gradient.dot(beyond) - log_stiffness;
    const double slope = std::min(found.gradient(x_progress), least_slope_of_stiffness);
    const double next = std::clamp(cell(x_progress) - std::clamp(off / slope, -1.0, 1.0), least, greatest);
    is_there = std::abs(next - cell(x_progress)) < 1e-10;
    cell(x_progress) = next;
  }
  const CombinedState state = line.at(go_to(cell(x_progress)));
  Eigen::Matrix<double, coordinate_count, varying> by = Eigen::Matrix<double, coordinate_count, varying>::Zero();
  by(x_radius, 0) = by(x_fraction, 2) = by(x_ratio, 3) = 1;
  by(x_axial, 1) = -axial, by(x_axial, 4) = std::exp(-numbers(1));
  if (cell(x_progress) > least && cell(x_progress) < greatest) {
    const Eigen::Matrix<double, 1, coordinate_count> g = state.gradient.row(log_stiffness_row);
    const Numbers wanted = Numbers::Unit(1) - (g * by).transpose();
    by.row(x_progress) = wanted.transpose() / g(x_progress);
  }
  Shape shape;
  for (int feature = 0; feature < feature_count; ++feature) {
    const auto gradient = state.gradient.row(row_of(feature));
    shape.value(feature) = state.value(row_of(feature)) + gradient.dot(beyond);
    shape.by_number.row(feature) = gradient * by;
  }
  shape.value(int(ShapeFeature::area_um2)) += std::log(scale_.area);
  shape.progress = cell(x_progress);
  shape.progress_by_number = by.row(x_progress).transpose();
  return shape;
}

CombinedMoments::Progress CombinedMoments::progress(const CombinedLaw& law) const {
  const CellBox& box = moduli_.table().box();
  const Numbers mean = numbers(law, Numbers::Zero());
  const Shape there = shape_in_tube(mean, (box.least + box.greatest)(x_progress) / 2);
  return {there.progress, there.progress_by_number, mean};
}

CombinedMoments::Shape CombinedMoments::shape(const CombinedLaw& law, const Numbers& place,
                                              const Progress& progress) const {
  const Numbers of_node = numbers(law, place);
  Shape seen = shape_in_tube(of_node, progress.at(of_node));
  if (sight_.section == Section::tube) return seen;
  constexpr double step = 1e-4;
  const Shape tube = seen;
  seen.value += section(of_node, tube.value).bias;
  for (int k = 0; k < varying; ++k) {
    const Numbers change = step * Numbers::Unit(k);
    const ShapeVector of_shape = tube.by_number * change;
    seen.by_number.col(k) += (section(of_node + change, tube.value + of_shape).bias -
                              section(of_node - change, tube.value - of_shape).bias) /
                             (2 * step);
  }
  return seen;
}

/// What the section adds; the law is over the shape in the square.
ShapeErrors CombinedMoments::section(const Numbers& numbers, const ShapeVector& in_tube) const {
  if (sight_.section == Section::tube) return {};
  constexpr int mode_2 = int(ShapeFeature::first_mode), mode_3 = mode_2 + 1, rounds = 3;
  ShapeErrors added;
  for (int round = 0; round < rounds; ++round) {
    const ShapeVector seen = in_tube + added.bias;
    added = change_by_square({.radius = std::exp(seen(int(ShapeFeature::area_um2)) / 2) * 2 * std::numbers::inv_sqrtpi /
                                        sight_.flow.width_um,
                              .mode_2 = seen(mode_2),
                              .mode_3 = seen(mode_3),
                              .cortex_fraction = numbers(2),
                              .cortex_tension = numbers(2) * numbers(3),
                              .thinning = moduli_.simulated().exponent - sight_.flow.exponent});
  }
  added.covariance *= sight_.error_factor * sight_.error_factor;
  return added;
}

Eigen::Matrix<double, CombinedMoments::varying, CombinedMoments::varying> CombinedMoments::by_place(
    const CombinedLaw& law) const {
  Eigen::Matrix<double, varying, varying> by = Eigen::Matrix<double, varying, varying>::Zero();
  by.topLeftCorner<combined_numbers, combined_numbers>() = law.root;
  by(3, 3) = law.ratio_spread;
  by(4, 4) = law.axial_spread * wall_stress_kPa_;
  return by;
}

VectorXd CombinedMoments::noise_with_area() const {
  constexpr int area = int(ShapeFeature::area_um2);
  const VectorXd covariance = pixels_.middle.covariance.col(area)(features());
  const double variance = pixels_.middle.covariance(area, area);
  return variance > 0 ? VectorXd(covariance / std::sqrt(variance)) : covariance;
}

CombinedMoments::SeenNodes CombinedMoments::seen(const CombinedLaw& law, const NormalNodes& nodes,
                                                 const NodeSlopes& moved, bool with_slopes) const {
  const auto n = Eigen::Index(features().size()), count = nodes.weight.size();
  const bool has_noise = nodes.place.rows() > varying;
  SeenNodes all{nodes,
                MatrixXd(n, count),
                {std::size_t(with_slopes ? combined_parameters : 0), MatrixXd(n, count)},
                pixels_.middle.covariance(features(), features())};
  MatrixXd by_place(n, nodes.place.rows());
  if (has_noise) {
    by_place.col(varying) = noise_with_area();
    all.noise -= by_place.col(varying) * by_place.col(varying).transpose();
  }
  const Progress of_mean = progress(law);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Numbers place = nodes.place.col(k).head<varying>();
    const Shape smooth = shape(law, place, of_mean);
    all.value.col(k) = (smooth.value + pixels_.middle.bias + pixels_.slope * place)(features());
    if (has_noise) all.value.col(k) += nodes.place(varying, k) * by_place.col(varying);
    if (!with_slopes) continue;
    const MatrixXd by_number = smooth.by_number(features(), Eigen::all);
    const MatrixXd by = by_number * by_parameters(law, place);
    by_place.leftCols<varying>() = by_number * this->by_place(law) + pixels_.slope(features(), Eigen::all);
    for (std::size_t a = 0; a < all.by.size(); ++a) {
      all.by[a].col(k) = by.col(Eigen::Index(a));
      if (!moved.empty()) all.by[a].col(k) += by_place * moved[a].place.col(k);
    }
  }
  return all;
}

MomentSlopes CombinedMoments::moments_of(const SeenNodes& seen, const NodeSlopes& moved) {
  const VectorXd& weight = seen.nodes.weight;
  MomentSlopes all{{seen.value * weight, seen.noise}, {}};
  const MatrixXd off = seen.value.colwise() - all.there.mean;
  all.there.covariance += off * weight.asDiagonal() * off.transpose();
  for (std::size_t a = 0; a < seen.by.size(); ++a) {
    Moments by{seen.by[a] * weight, {}};
    const MatrixXd change = (seen.by[a].colwise() - by.mean) * weight.asDiagonal() * off.transpose();
    by.covariance = change + change.transpose();
    if (!moved.empty()) {
      by.mean += off * moved[a].weight;
      by.covariance += off * moved[a].weight.asDiagonal() * off.transpose();
    }
    all.by_parameter.push_back(std::move(by));
  }
  return all;
}

MomentSlopes CombinedMoments::moments(const VectorXd& parameters, bool with_slopes) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const SeenNodes all = seen(law, nodes_, {}, with_slopes);
  if (!gate_) return moments_of(all, {});
  const NodeSlopes moved = with_slopes ? slopes_of_kept(all) : NodeSlopes();
  return moments_of(seen(law, kept_nodes(*gate_, area(all)), moved, with_slopes), moved);
}

VectorXd CombinedMoments::by_log_viscosity(const CombinedVector& parameters) const {
  const SeenNodes all = seen(CombinedLaw::of(parameters), nodes_, {}, true);
  return -moments_of(all, {}).by_parameter[int(CombinedParameter::log_stiffness)].mean;
}

CellCoordinates CombinedMoments::mean_cell(const CombinedVector& parameters) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const Progress of_mean = progress(law);
  return place_in_table(of_mean.mean, of_mean.value);
}

MatrixXd CombinedMoments::common_covariance(const CombinedVector& parameters) const {
  const auto n = Eigen::Index(features().size());
  if (sight_.section == Section::tube) return std::pow(error_between_branches, 2) * MatrixXd::Identity(n, n);
  const CombinedLaw law = CombinedLaw::of(parameters);
  return variance_in_common * section(numbers(law, Numbers::Zero()), shape(law, Numbers::Zero(), progress(law)).value)
                                  .covariance(features(), features());
}

}  // namespace rheocyte
