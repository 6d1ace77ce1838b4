#include "infer/combined_population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "measurement/shape_in_pixels.h"
#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int newton_steps_to_progress = 30;
/// Beyond the table's soft and stiff end shapes go straight on, so far in ln of the progress.
constexpr double beyond_soft_end = 0.5, beyond_stiff_end = 3;
/// A slope of ln of the stiffness by ln of the progress that is never exceeded.
constexpr double least_slope_of_stiffness = -0.1;
constexpr std::size_t pictures_of_event = 10, fewest_pictures = 10'000, most_pictures = 40'000;
constexpr int pictures_of_cell = 8;
/// Of what the law of the square leaves of single cells, what two cells of one population have in common
/// (bench/square_law.py: 0.4 and 0.07 of cells that are within and about two and more of its spreads from one another).
constexpr double variance_in_common = 0.2;
constexpr std::size_t virtual_events = 5'000;
constexpr int turns_of_beginning = 3, turns_of_round = 20, rounds_of_pictures = 3, pictures_of_median = 2'000;

CellCoordinates held(const CellCoordinates& cell, const CellBox& box) {
  return cell.cwiseMax(box.least).cwiseMin(box.greatest);
}

/// Far beyond the table shapes that go straight on are none.
bool is_plausible(const ShapeVector& shape, double channel_width_um) {
  constexpr double most_mode = 0.6;
  const double radius_um = std::exp(shape(int(ShapeFeature::area_um2)) / 2) * std::numbers::inv_sqrtpi;
  return shape.allFinite() && shape.tail<mode_count>().cwiseAbs().sum() < most_mode && radius_um < channel_width_um;
}

}  // namespace

CombinedMoments::CombinedMoments(const BulkCortexFit& moduli, const Sight& sight, double pixel_size_um)
    : moduli_(moduli),
      sight_(sight),
      pixel_size_um_(pixel_size_um),
      wall_stress_kPa_(1e-3 * wall_shear_stress_Pa(sight.flow)),
      scale_(scale_factors(moduli.simulated(), sight.flow)) {}

/// Of normally distributed numbers: exact for polynomials up to the fifth degree (Smolyak's sum of Gauss-Hermite rules
/// of three nodes).
std::vector<CombinedMoments::Node> CombinedMoments::nodes() {
  const double far = std::sqrt(3.0);
  constexpr double n = varying;
  std::vector<Node> all{{1 + n * (n - 7) / 18, Numbers::Zero()}};
  for (int i = 0; i < varying; ++i)
    for (const double a : {-far, far}) {
      all.push_back({(4 - n) / 18, a * Numbers::Unit(i)});
      for (int k = 0; k < i; ++k)
        for (const double b : {-far, far}) all.push_back({1.0 / 36, a * Numbers::Unit(i) + b * Numbers::Unit(k)});
    }
  return all;
}

CombinedMoments::Numbers CombinedMoments::numbers(const CombinedLaw& law, const Node& node) const {
  Numbers numbers;
  numbers << law.mean + law.root * node.place.head<combined_numbers>(),
      law.tension_ratio + law.ratio_spread * node.place(combined_numbers),
      (law.axial_tension + law.axial_spread * node.place(combined_numbers + 1)) * wall_stress_kPa_;
  return numbers;
}

Eigen::Matrix<double, CombinedMoments::varying, combined_parameters> CombinedMoments::by_parameters(
    const CombinedLaw& law, const Node& node) const {
  using enum CombinedParameter;
  const auto& place = node.place;
  Eigen::Matrix<double, varying, combined_parameters> by = Eigen::Matrix<double, varying, combined_parameters>::Zero();
  for (int k = 0; k <= combined_numbers; ++k) by(k, k) = 1;
  by(4, int(axial_tension)) = wall_stress_kPa_;
  by(0, int(log_radius_spread)) = law.root(0, 0) * place(0);
  by(1, int(stiffness_by_radius)) = by(2, int(share_by_radius)) = place(0);
  by(1, int(log_stiffness_spread)) = law.root(1, 1) * place(1);
  by(2, int(share_by_stiffness)) = place(1);
  by(2, int(log_share_spread)) = law.root(2, 2) * place(2);
  by(3, int(log_ratio_spread)) = law.ratio_spread * place(3);
  by(4, int(log_axial_spread)) = law.axial_spread * place(4) * wall_stress_kPa_;
  return by;
}

CellCoordinates CombinedMoments::place_in_table(const Numbers& numbers, double log_progress) const {
  CellCoordinates cell;
  cell(x_radius) = numbers(0) - std::log(scale_.length);
  cell(x_share) = numbers(2);
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
  CombinedState state;
  CellCoordinates beyond;
  bool is_there = false;
  for (int step = 0; step < newton_steps_to_progress; ++step) {
    beyond = cell - held(cell, box);
    state = moduli_.table().at(cell - beyond);
    if (is_there) break;
    const double off =
        state.value(log_stiffness_row) + state.gradient.row(log_stiffness_row).dot(beyond) - log_stiffness;
    const double slope = std::min(state.gradient(log_stiffness_row, x_progress), least_slope_of_stiffness);
    const double next = std::clamp(cell(x_progress) - std::clamp(off / slope, -1.0, 1.0), least, greatest);
    is_there = std::abs(next - cell(x_progress)) < 1e-10;
    cell(x_progress) = next;
  }
  Eigen::Matrix<double, coordinate_count, varying> by = Eigen::Matrix<double, coordinate_count, varying>::Zero();
  by(x_radius, 0) = by(x_share, 2) = by(x_ratio, 3) = 1;
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
  const Numbers mean = numbers(law, nodes_[0]);
  const Shape there = shape_in_tube(mean, (box.least + box.greatest)(x_progress) / 2);
  return {there.progress, there.progress_by_number, mean};
}

CombinedMoments::Shape CombinedMoments::shape(const CombinedLaw& law, const Node& node,
                                              const Progress& progress) const {
  const Numbers of_node = numbers(law, node);
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
                              .cortex_share = numbers(2),
                              .cortex_tension = numbers(2) * numbers(3),
                              .thinning = moduli_.simulated().exponent - sight_.flow.exponent});
  }
  added.covariance *= sight_.error_factor * sight_.error_factor;
  return added;
}

MomentSlopes CombinedMoments::slopes_or_not(const VectorXd& parameters, bool with_slopes) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const int count = with_slopes ? combined_parameters : 0;
  const auto n = Eigen::Index(features().size());
  MomentSlopes all{{VectorXd::Zero(n), pixels_.middle.covariance(features(), features())},
                   std::vector<Moments>(std::size_t(count), {VectorXd::Zero(n), MatrixXd::Zero(n, n)})};
  MatrixXd seen(n, Eigen::Index(nodes_.size()));
  std::vector<MatrixXd> by(nodes_.size());  // features by parameters
  const Progress of_mean = progress(law);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const double weight = nodes_[k].weight;
    const Shape smooth = shape(law, nodes_[k], of_mean);
    seen.col(Eigen::Index(k)) = (smooth.value + pixels_.middle.bias + pixels_.slope * nodes_[k].place)(features());
    all.there.mean += weight * seen.col(Eigen::Index(k));
    if (with_slopes) by[k] = smooth.by_number(features(), Eigen::all) * by_parameters(law, nodes_[k]);
    for (int a = 0; a < count; ++a) all.by_parameter[std::size_t(a)].mean += weight * by[k].col(a);
  }
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const VectorXd off = seen.col(Eigen::Index(k)) - all.there.mean;
    all.there.covariance += nodes_[k].weight * off * off.transpose();
    for (int a = 0; a < count; ++a) {
      const VectorXd change = by[k].col(a) - all.by_parameter[std::size_t(a)].mean;
      all.by_parameter[std::size_t(a)].covariance +=
          nodes_[k].weight * (change * off.transpose() + off * change.transpose());
    }
  }
  return all;
}

bool CombinedMoments::render(const CombinedVector& parameters, std::size_t pictures) {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const auto cells = Eigen::Index(pictures / pictures_of_cell);
  const Progress of_mean = progress(law);
  MatrixXd terms(cells, varying + 1), bias(cells, feature_count);
  pixels_.middle = {};
  Eigen::Index i = 0;
  for (std::uint64_t number = 0; i < cells && number < 2 * std::uint64_t(cells); ++number) {
    const Node drawn = drawn_node(1, number);
    const ShapeVector smooth = shape(law, drawn, of_mean).value;
    if (!is_plausible(smooth, sight_.flow.width_um)) continue;
    CellRandom random(1, number, Purpose::picture);
    const ShapeErrors errors = errors_in_pixels(outline_of(smooth), pixel_size_um_, pictures_of_cell, random);
    terms.row(i) << 1, drawn.place.transpose();
    bias.row(i) = errors.bias.transpose();
    pixels_.middle.covariance += errors.covariance;
    ++i;
  }
  if (i < cells) return false;
  pixels_.middle.covariance /= double(cells);
  const MatrixXd found = solve_dense(terms.transpose() * terms, terms.transpose() * bias);
  pixels_.middle.bias = found.row(0).transpose();
  pixels_.slope = found.bottomRows(varying).transpose();
  return true;
}

std::vector<ShapeVector> CombinedMoments::drawn(const CombinedVector& parameters, std::size_t events) const {
  const MatrixXd white = whitening(pixels_.middle.covariance);
  if (white.size() == 0) return {};
  const MatrixXd root = solve_dense(white, MatrixXd::Identity(feature_count, feature_count));
  std::vector<ShapeVector> all = drawn_smooth(parameters, events, 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CellRandom random(0, i, Purpose::picture);
    ShapeVector noise;
    for (double& number : noise) number = random.normal();
    all[i] += pixels_.middle.bias + pixels_.slope * drawn_node(0, i).place + root * noise;
  }
  return all;
}

std::vector<ShapeVector> CombinedMoments::drawn_smooth(const CombinedVector& parameters, std::size_t events,
                                                       std::uint64_t seed) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  const Progress of_mean = progress(law);
  std::vector<ShapeVector> all;
  for (std::size_t i = 0; i < events; ++i) all.push_back(shape(law, drawn_node(seed, i), of_mean).value);
  return all;
}

CombinedMoments::Node CombinedMoments::drawn_node(std::uint64_t seed, std::uint64_t number) {
  CellRandom random(seed, number, Purpose::population);
  Node node{1, {}};
  for (double& place : node.place) place = random.normal();
  return node;
}

VectorXd CombinedMoments::by_log_viscosity(const CombinedVector& parameters) const {
  return -slopes(parameters).by_parameter[int(CombinedParameter::log_stiffness)].mean;
}

VectorXd CombinedMoments::bend(const CombinedVector& parameters) const {
  const CombinedLaw law = CombinedLaw::of(parameters);
  return at(parameters).mean - (shape(law, nodes_[0], progress(law)).value + pixels_.middle.bias)(features());
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
  return variance_in_common * section(numbers(law, nodes_[0]), shape(law, nodes_[0], progress(law)).value)
                                  .covariance(features(), features());
}

namespace {

/// As if the measured outline were smooth: for a beginning.
ShapeErrors pixels_of(const ShapeVector& measured, double pixel_size_um) {
  CellRandom random(1, 0, Purpose::picture);
  return errors_in_pixels(outline_of(measured), pixel_size_um, pictures_of_median, random);
}

MatrixXd rows_of(std::span<const MeasuredCell> cells, const std::vector<int>& features,
                 const VectorXd& by_log_viscosity, double median_viscosity_mPas) {
  MatrixXd rows(Eigen::Index(cells.size()), Eigen::Index(features.size()));
  for (std::size_t i = 0; i < cells.size(); ++i)
    rows.row(Eigen::Index(i)) =
        (cells[i].shape(features) - by_log_viscosity * std::log(cells[i].flow.viscosity_mPas / median_viscosity_mPas))
            .transpose();
  return rows;
}

/// Means within the table, but for the radius and the stiffness; spreads above what nobody sees.
MomentSettings moment_settings(const CombinedInterpolation& table, const std::function<void()>& goes_on) {
  using enum CombinedParameter;
  const CellBox& box = table.box();
  MomentSettings settings;
  settings.least = VectorXd::Constant(combined_parameters, -HUGE_VAL);
  settings.greatest = -settings.least;
  const auto within = [&](CombinedParameter p, double least, double greatest) {
    settings.least(int(p)) = least, settings.greatest(int(p)) = greatest;
  };
  within(cortex_share, box.least(x_share), box.greatest(x_share));
  within(tension_ratio, box.least(x_ratio), box.greatest(x_ratio));
  within(axial_tension, 0, HUGE_VAL);
  within(log_radius_spread, std::log(0.003), 0);
  within(log_stiffness_spread, std::log(0.01), std::log(0.5));
  within(log_share_spread, std::log(0.01), std::log(0.12));
  within(log_ratio_spread, std::log(0.01), std::log(0.15));
  within(log_axial_spread, std::log(0.01), std::log(0.3));
  settings.goes_on = goes_on;
  return settings;
}

CombinedVector start_from(const ModuliEstimate& median, const ScaleFactors& scale, double wall_stress_Pa) {
  constexpr double share = 0.4, ratio = 0.3;  // from others the search comes to the same end
  CombinedLaw law;
  law.mean << median.cell(x_radius) + std::log(scale.length), std::log(median.stiffness_kPa), share;
  law.tension_ratio = ratio;
  law.axial_tension = median.axial_tension_Pa / wall_stress_Pa;
  law.axial_spread = 0.1, law.ratio_spread = 0.1;
  law.root.diagonal() << 0.07, 0.2, 0.1;
  return law.parameters();
}

/// What no cell of the table has: by how much the means are off beyond two standard errors of their own.
VectorXd missed(const MomentFit& fit, const VectorXd& residual) {
  const VectorXd error = (fit.measured.covariance.diagonal() / double(fit.events)).cwiseSqrt();
  return (residual.cwiseAbs() - 2 * error).cwiseMax(0);
}

}  // namespace

CombinedPopulation fit_combined_population(const BulkCortexFit& moduli, const Sight& sight, double pixel_size_um,
                                           std::span<const MeasuredCell> cells, const std::function<void()>& goes_on) {
  const MeasuredCell median = median_of(cells);
  Sight at_median{median.flow, sight.section, sight.error_factor};
  CombinedMoments model(moduli, at_median, pixel_size_um);
  const ShapeErrors of_median_outline = pixels_of(median.shape, pixel_size_um);
  model.take_pixels(of_median_outline);
  const ModuliEstimate of_median =
      moduli.fit({median.shape, of_median_outline}, at_median.flow, AxialTension::unknown());
  CombinedPopulation found;
  if (!std::isfinite(of_median.stiffness_kPa)) return found;
  MomentSettings settings = moment_settings(moduli.table(), goes_on);
  const auto fit_from = [&](const CombinedVector& q) {
    settings.common_covariance = model.common_covariance(q);
    const MatrixXd rows = rows_of(cells, model.features(), model.by_log_viscosity(q), at_median.flow.viscosity_mPas);
    found.fit = fit_moments(model, rows, q, settings);
    return found.fit.parameters;
  };
  settings.most_turns = turns_of_beginning;
  CombinedVector q = fit_from(
      start_from(of_median, scale_factors(moduli.simulated(), at_median.flow), wall_shear_stress_Pa(at_median.flow)));
  settings.most_turns = turns_of_round;
  const std::size_t pictures = std::clamp(pictures_of_event * cells.size(), fewest_pictures, most_pictures);
  for (int round = 0; round < rounds_of_pictures; ++round) {
    if (!model.render(q, pictures)) return found;
    q = fit_from(q);
  }
  if (!found.fit.is_found) return found;
  found.law = CombinedLaw::of(q);
  found.features = model.features();
  found.bend = model.bend(q);
  found.mean_cell = model.mean_cell(q);
  found.residual = found.fit.measured.mean - found.fit.fitted.mean;
  MatrixXd common = model.common_covariance(q);
  common.diagonal() += missed(found.fit, found.residual).cwiseAbs2();
  found.common_covariance = found.fit.by_shift * common * found.fit.by_shift.transpose();
  found.drawn = model.drawn(q, virtual_events);
  return found;
}

}  // namespace rheocyte
