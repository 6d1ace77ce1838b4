#include "infer/combined_population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "infer/combined_moments.h"
#include "measurement/shape_in_pixels.h"

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t pictures_of_event = 10, fewest_pictures = 10'000, most_pictures = 40'000;
constexpr std::size_t virtual_events = 5'000, virtual_cells = 1'000;
constexpr int turns_of_beginning = 3, turns_of_round = 20, rounds_of_pictures = 3, pictures_of_median = 2'000;

/// As if the measured outline were smooth: for a beginning.
ShapeErrors pixels_of(const ShapeVector& measured, const SeenPopulation& seen) {
  CellRandom random(1, 0, Purpose::picture);
  return errors_in_pixels(outline_of(measured), seen.pixel_size_um, pictures_of_median, random, seen.outline_noise);
}

/// Means within the table, but for the radius and the stiffness; spreads above what no one sees. `axial`: the tension
/// over the wall's shear stress, if it is known.
MomentSettings moment_settings(const CombinedInterpolation& table, const std::optional<double>& axial,
                               const Watch& watch) {
  using enum CombinedParameter;
  const CellBox& box = table.box();
  MomentSettings settings;
  settings.least = VectorXd::Constant(combined_parameters, -HUGE_VAL);
  settings.greatest = -settings.least;
  const auto within = [&](CombinedParameter p, double least, double greatest) {
    settings.least(int(p)) = least, settings.greatest(int(p)) = greatest;
  };
  within(cortex_fraction, box.least(x_fraction), box.greatest(x_fraction));
  within(tension_ratio, box.least(x_ratio), box.greatest(x_ratio));
  within(axial_tension, axial.value_or(0), axial.value_or(HUGE_VAL));
  within(log_radius_spread, std::log(0.003), 0);
  within(log_stiffness_spread, std::log(0.01), std::log(0.5));
  within(log_fraction_spread, std::log(0.01), std::log(0.12));
  within(log_ratio_spread, std::log(0.01), std::log(0.15));
  within(log_axial_spread, std::log(0.01), std::log(0.3));
  settings.watch = watch;
  return settings;
}

CombinedVector start_from(const ModuliEstimate& median, const ScaleFactors& scale, double wall_stress_Pa) {
  constexpr double fraction = 0.4, ratio = 0.3;  // from others the search comes to the same end
  CombinedLaw law;
  law.mean << median.cell(x_radius) + std::log(scale.length), std::log(median.stiffness_kPa), fraction;
  law.tension_ratio = ratio;
  law.axial_tension = median.axial_tension_Pa / wall_stress_Pa;
  law.axial_spread = 0.1, law.ratio_spread = 0.1;
  law.root.diagonal() << 0.07, 0.2, 0.1;
  return law.parameters();
}

std::optional<double> axial_tension_of(const SeenPopulation& seen, const ChannelFlow& flow) {
  if (!seen.axial_tension_Pa) return {};
  return *seen.axial_tension_Pa / wall_shear_stress_Pa(flow);
}

/// What no cell of the table has: by how much the means are off beyond two standard errors of their own.
VectorXd missed(const MomentFit& fit, const VectorXd& residual) {
  const VectorXd error = (fit.measured.covariance.diagonal() / double(fit.events)).cwiseSqrt();
  return (residual.cwiseAbs() - 2 * error).cwiseMax(0);
}

std::array<double, feature_count + 1> numbers_of(const MeasuredCell& cell) {
  std::array<double, feature_count + 1> numbers;
  std::ranges::copy(cell.shape, numbers.begin());
  numbers.back() = cell.flow.viscosity_mPas;
  return numbers;
}

double log_area_of(const MeasuredCell& cell) { return cell.shape(int(ShapeFeature::area_um2)); }

ValueGate within_both(const ValueGate& a, const ValueGate& b) {
  return {std::max(a.least, b.least), std::min(a.greatest, b.greatest)};
}

class CombinedSearch {
 public:
  CombinedSearch(const BulkCortexFit& moduli, const SeenPopulation& seen, std::span<const MeasuredCell> cells,
                 const Watch& watch)
      : moduli_(moduli),
        seen_(seen),
        cells_(cells),
        median_(median_of(cells)),
        model_(moduli, {median_.flow, seen.sight.section, seen.sight.error_factor}, seen.pixel_size_um,
               seen.outline_noise),
        settings_(moment_settings(moduli.table(), axial_tension_of(seen, median_.flow), watch)) {
    inside_.resize(cells.size());
    std::iota(inside_.begin(), inside_.end(), 0);
    std::ranges::sort(inside_,
                      [&](std::size_t a, std::size_t b) { return numbers_of(cells[a]) < numbers_of(cells[b]); });
  }

  CombinedPopulation find() {
    if (!begin()) {
      found_.fit.is_found = false;
      return std::move(found_);
    }
    settings_.most_turns = turns_of_round;
    for (int round = 0; round < rounds_of_pictures; ++round) {
      const std::size_t pictures = std::clamp(pictures_of_event * inside_.size(), fewest_pictures, most_pictures);
      if (!model_.render(q_, pictures)) {
        found_.fit.is_found = false;
        return std::move(found_);
      }
      fit();
    }
    if (found_.fit.is_found) tell();
    return std::move(found_);
  }

 private:
  /// With what the pixels do to the median outline. The gates of the table are determined by the cells that are found
  /// so.
  bool begin() {
    const ShapeErrors of_median_outline = pixels_of(median_.shape, seen_);
    model_.take_pixels(of_median_outline);
    const ModuliEstimate of_median =
        moduli_.fit({median_.shape, of_median_outline}, median_.flow, AxialTension::unknown());
    if (!std::isfinite(of_median.stiffness_kPa)) return false;
    q_ = start_from(of_median, scale_factors(moduli_.simulated(), median_.flow), wall_shear_stress_Pa(median_.flow));
    settings_.most_turns = turns_of_beginning;
    if (std::isfinite(seen_.log_area.least) || std::isfinite(seen_.log_area.greatest)) take_gate(seen_.log_area);
    fit();
    leave_out_other_sizes();
    return inside_.size() >= fewest_cells_of_population;
  }

  void leave_out_other_sizes() {
    const ValueGate both = within_both(seen_.log_area, model_.gate_of_table(q_));
    const bool is_in_table = both.pass(log_area_of(median_));
    if (is_in_table && !std::ranges::all_of(cells_, [&](const auto& cell) { return both.pass(log_area_of(cell)); }))
      take_gate(both);
  }

  void take_gate(const ValueGate& gate) {
    model_.take_gate(gate);
    std::erase_if(inside_, [&](std::size_t i) { return !gate.pass(log_area_of(cells_[i])); });
  }

  void fit() {
    settings_.common_covariance = model_.common_covariance(q_);
    found_.fit = fit_moments(model_, rows(), q_, settings_);
    q_ = found_.fit.parameters;
  }

  MatrixXd rows() const {
    const VectorXd by_log_viscosity = model_.by_log_viscosity(q_);
    MatrixXd rows(Eigen::Index(inside_.size()), Eigen::Index(model_.features().size()));
    for (std::size_t k = 0; k < inside_.size(); ++k) {
      const MeasuredCell& cell = cells_[inside_[k]];
      const double thicker = std::log(cell.flow.viscosity_mPas / median_.flow.viscosity_mPas);
      rows.row(Eigen::Index(k)) = (cell.shape(model_.features()) - thicker * by_log_viscosity).transpose();
    }
    return rows;
  }

  void tell() {
    found_.law = CombinedLaw::of(q_);
    found_.at_rest = moduli_.at_rest().scaled(scale_factors(moduli_.simulated(), median_.flow));
    found_.features = model_.features();
    found_.mean_cell = model_.mean_cell(q_);
    found_.residual = found_.fit.measured.mean - found_.fit.fitted.mean;
    found_.kept_fraction = model_.kept_fraction(q_);
    const auto is_small = [&](const MeasuredCell& cell) { return log_area_of(cell) < log_area_of(median_); };
    const auto small = std::size_t(std::ranges::count_if(cells_, is_small)),
               small_inside = std::size_t(std::ranges::count_if(inside_, [&](auto i) { return is_small(cells_[i]); }));
    found_.smaller = small - small_inside;
    found_.larger = cells_.size() - inside_.size() - found_.smaller;
    found_.counts.assign(cells_.size(), false);
    for (std::size_t k = 0; k < inside_.size(); ++k) found_.counts[inside_[k]] = !found_.fit.is_stranger[k];
    MatrixXd common = model_.common_covariance(q_);
    common.diagonal() += missed(found_.fit, found_.residual).cwiseAbs2();
    found_.common_covariance = found_.fit.by_shift * common * found_.fit.by_shift.transpose();
    found_.drawn = model_.drawn(q_, virtual_events);
    found_.beyond = model_.beyond(q_, virtual_cells);
  }

  const BulkCortexFit& moduli_;
  const SeenPopulation& seen_;
  std::span<const MeasuredCell> cells_;
  MeasuredCell median_;
  CombinedMoments model_;
  MomentSettings settings_;
  std::vector<std::size_t> inside_;  ///< events that pass the gates, in an order that what was measured tells
  CombinedVector q_;
  CombinedPopulation found_;
};

}  // namespace

ValueGate log_area_gate(double least_um2, double greatest_um2) {
  return {std::log(std::max(least_um2, 0.0)), std::log(greatest_um2)};
}

NumberOfLaw number_of_law(const CombinedPopulation& population, double CombinedLogs::*log) {
  const CombinedVector slopes = slopes_of_mean(population.fit.parameters, population.at_rest, log);
  return {log_means(population.law, population.at_rest).*log, slopes.dot(population.fit.covariance * slopes),
          log_spreads(population.law, population.at_rest).*log,
          std::sqrt(slopes.dot(population.common_covariance * slopes))};
}

LawOfCells law_of_cells(const CombinedPopulation& population, double wall_stress_Pa) {
  const MomentFit& fit = population.fit;
  constexpr int axial = int(CombinedParameter::axial_tension), means = int(CombinedParameter::log_radius_spread);
  const double variance = fit.covariance(axial, axial) + population.common_covariance(axial, axial);
  return {.is_found = true,
          .cells = fit.events,
          .misfit = fit.misfit / std::max(int(population.features.size()) - means, 1),
          .axial_tension = {population.law.axial_tension * wall_stress_Pa, std::sqrt(variance) * wall_stress_Pa},
          .stiffness = number_of_law(population, &CombinedLogs::stiffness),
          .effective_modulus = number_of_law(population, &CombinedLogs::effective),
          .young = number_of_law(population, &CombinedLogs::young),
          .cortex = number_of_law(population, &CombinedLogs::cortex)};
}

CombinedPopulation fit_combined_population(const BulkCortexFit& moduli, const SeenPopulation& seen,
                                           std::span<const MeasuredCell> cells, const Watch& watch) {
  return CombinedSearch(moduli, seen, cells, watch).find();
}

}  // namespace rheocyte
