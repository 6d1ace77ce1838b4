#include "experiment/population_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "extract/cortex_shapes.h"
#include "measurement/pixel_errors.h"
#include "population/virtual_event.h"

namespace rheocyte {
namespace {

constexpr std::size_t draws_per_event = 20, fewest_draws = 10000, most_draws = 50000;
constexpr int most_tries = 200;
constexpr int checked_measures = 6;

enum Checked { checked_area, checked_deformation, checked_inertia, checked_mode_3, checked_mode_4, checked_mode_5 };
using EventValues = std::array<double, checked_measures>;

constexpr std::array<const char*, checked_measures> checked_names{"ln A", "d", "inertia ratio", "c3", "c4", "c5"};

/// Squares of many normal numbers: with this mean and deviation, and most below the mean (Wilson and Hilferty 1931).
double sum_of_squares(double mean, double deviation, CellRandom& random) {
  if (mean <= 0) return mean + deviation * random.normal();
  const double part = deviation / mean / 3;
  return mean * std::pow(1 - part * part + part * random.normal(), 3);
}

/// A cell of the fitted population, seen with the elongation and the viscosity of an event.
class DrawnPopulation {
 public:
  DrawnPopulation(const PopulationEvents& events, const PopulationSample& sample, const FittedCells& fitted,
                  PopulationMaps& maps)
      : events_(events), sample_(sample), law_(fitted.law), maps_(maps), solids_(maps.solids(events)) {}

  /// False if no such cell passes the gates.
  bool draw(std::size_t event, CellRandom& random, EventValues& values) {
    const double elongation = sample_.elongation_of_event[event];
    const auto map = maps_.map(events_, elongation);
    const SampleGates& gates = gates_for(elongation);
    const auto [mean, unit] = sample_.elongation;
    const CellDistribution cells = law_.at(unit * (elongation - mean));
    for (int k = 0; k < most_tries; ++k) {
      DrawnCell cell = drawn_cell(cells, random);
      cell.log_modulus -= std::log(events_.of(SeenMeasure::viscosity_mPas)[event]);
      const SeenValues seen = seen_values(*map, cell, random);
      const double height = cell.log_modulus - map->soft_end(cell.log_radius).log_modulus;
      if (height < 0 || !gates.pass(seen.log_area, seen.measure)) continue;
      add_features(solids_.cell(elongation, cell.log_radius, height), seen, random, values);
      // The map is that of a class of elongations, the event has its own: i = (1 + c_2) / (1 - c_2).
      const bool by_modes = maps_.by() == StiffnessMeasure::asymmetry;
      const double off =
          maps_.by() == StiffnessMeasure::deformation ? 0 : elongation_measure(events_, maps_.by())[event] - elongation;
      values[checked_inertia] += by_modes ? 2 * off / std::pow(1 - elongation, 2) : off;
      return true;
    }
    return false;
  }

 private:
  /// Of the class whose map is nearest.
  const SampleGates& gates_for(double elongation) const {
    std::size_t best = 0;
    for (std::size_t k = 0; k < sample_.class_elongation.size(); ++k)
      if (std::abs(sample_.class_elongation[k] - elongation) < std::abs(sample_.class_elongation[best] - elongation))
        best = k;
    return sample_.sample.kept[best].gates;
  }

  void add_features(const SolidMaps::Cell& cell, const SeenValues& seen, CellRandom& random,
                    EventValues& values) const {
    const SolidFeatures f = solids_.seen(cell);
    const double log_area_px = f.log_area - 2 * std::log(events_.pixel_size_um), mode_3 = f.modes.mode_3;
    const ModeErrors errors = mode_errors(log_area_px, f.modes);
    const ShapeErrors outline = solids_.outline_errors(cell);
    const auto variance = [&](double of_pixels, int feature) {
      return std::max(of_pixels * of_pixels + outline.covariance(feature, feature), 0.0);
    };
    const auto noise = [&](double of_pixels, int mode) {
      return std::sqrt(variance(of_pixels, feature_of_mode(mode))) * random.normal();
    };
    values[checked_area] = seen.log_area;
    // The cell has the measured elongation with its noise, which the inertia ratio shares.
    values[checked_inertia] = f.inertia_ratio;
    if (maps_.by() == StiffnessMeasure::asymmetry) {
      // d = 3/4 c_2^2 + 2 c_3^2 + the squares of all that pixels and segmentation add to other modes, which is the
      // noise of a round cell. The mean d of this cell has the squares of the noise of c_2, which the measured one has,
      // too.
      constexpr int feature = int(ShapeFeature::deformation);
      const ModeErrors round = mode_errors(log_area_px, {});
      const Eigen::Vector2d slopes(1.5 * f.modes.mode_2, 4 * mode_3);
      const auto both = outline.covariance.block<2, 2>(feature_of_mode(2), feature_of_mode(2));
      const double off_3 = seen.measure - mode_3,
                   of_mode_2 = 0.75 * variance(errors.mode_2.deviation, feature_of_mode(2)),
                   of_mode_3 = 2 * variance(errors.mode_3.deviation, feature_of_mode(3)),
                   of_others = round.deformation_excess + outline.bias(feature) - of_mode_2 - of_mode_3,
                   deviation = std::sqrt(
                       std::max(variance(round.deformation_deviation, feature) - slopes.dot(both * slopes), 0.0));
      values[checked_mode_3] = seen.measure;
      values[checked_deformation] = f.deformation - of_mode_2 + 4 * mode_3 * off_3 + 2 * off_3 * off_3 - of_mode_3 +
                                    sum_of_squares(of_others, deviation, random) - of_others;
    } else {
      values[checked_mode_3] = mode_3 + errors.mode_3.deviation * random.normal();
      values[checked_deformation] = seen.measure;
    }
    values[checked_mode_4] = f.modes.mode_4 + noise(errors.mode_4.deviation, 4);
    values[checked_mode_5] = f.modes.mode_5 + noise(errors.mode_5.deviation, 5);
  }

  const PopulationEvents& events_;
  const PopulationSample& sample_;
  const CellLaw& law_;
  PopulationMaps& maps_;
  const SolidMaps& solids_;
};

EventValues measured_values(const PopulationEvents& events, std::size_t i) {
  EventValues values{};
  const auto at = [&](SeenMeasure m) { return events.of(m)[i]; };
  using enum SeenMeasure;
  values = {std::log(at(area_um2)), at(deformation), at(inertia_ratio), at(mode_3), at(mode_4), at(mode_5)};
  return values;
}

Median beyond(const MeasureCheck& check) {
  return {check.measured.value - check.predicted.value, std::hypot(check.measured.error, check.predicted.error)};
}

/// c_4 and c_5 of cells with a cortex do not fit, however small they are beside the spread.
void refuse_cortex(double pixel_size_um, std::vector<MeasureCheck>& checks) {
  const double radius_um = std::exp(checks[checked_area].measured.value / 2) * std::numbers::inv_sqrtpi;
  if (!are_of_cortex({checks[checked_mode_3].measured.value, radius_um / pixel_size_um, beyond(checks[checked_mode_4]),
                      beyond(checks[checked_mode_5])}))
    return;
  for (const int mode : {checked_mode_4, checked_mode_5})
    checks[std::size_t(mode)].fits = checks[std::size_t(mode)].fits_together = false;
}

}  // namespace

std::vector<MeasureCheck> check_population(const PopulationEvents& events, const PopulationSample& sample,
                                           const FittedCells& fitted, PopulationMaps& maps) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < events.events(); ++i)
    if (std::isfinite(sample.elongation_of_event[i])) inside.push_back(i);
  std::array<std::vector<double>, checked_measures> measured, predicted;
  DrawnPopulation population(events, sample, fitted, maps);
  for (const std::size_t i : inside) {
    const EventValues values = measured_values(events, i);
    for (std::size_t m = 0; m < values.size(); ++m) measured[m].push_back(values[m]);
  }
  const std::size_t draws = std::clamp(draws_per_event * inside.size(), fewest_draws, most_draws);
  for (std::size_t k = 0; k < draws; ++k) {
    CellRandom random(0, k, Purpose::population);
    EventValues values;
    if (!population.draw(inside[k * inside.size() / draws], random, values)) continue;
    for (std::size_t m = 0; m < values.size(); ++m) predicted[m].push_back(values[m]);
  }
  std::vector<MeasureCheck> checks;
  if (predicted[0].empty()) return checks;
  const int last = events.has_outlines         ? checked_mode_5
                   : events.has_inertia_ratios ? checked_inertia
                                               : checked_deformation;
  for (int m = 0; m <= last; ++m) {
    const int fitted_measure = maps.by() == StiffnessMeasure::asymmetry ? checked_mode_3 : checked_deformation;
    const MeasureRule rule = m == checked_area || m == fitted_measure     ? MeasureRule::fitted
                             : m == checked_mode_4 || m == checked_mode_5 ? MeasureRule::of_all_real_cells
                                                                          : MeasureRule::not_fitted;
    const double convention =
        rule == MeasureRule::fitted
            ? 0
            : mask_convention(checked_names[std::size_t(m)], events.pixel_size_um, measured[checked_area]);
    checks.push_back(compared_measure(checked_names[std::size_t(m)], rule,
                                      {measured[std::size_t(m)], measured[checked_area]},
                                      {predicted[std::size_t(m)], predicted[checked_area]}, convention));
  }
  if (events.has_outlines) refuse_cortex(events.pixel_size_um, checks);
  return checks;
}

}  // namespace rheocyte
