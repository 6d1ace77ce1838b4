#include "experiment/measure_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "numeric/quantile.h"

namespace rheocyte {
namespace {

/// What counts as misfit of a distribution, at n events, of measures that were fitted and of others: these have no
/// parameters to follow chance with, and the laws of the pixels leave them up to a fifth of their spread.
constexpr double chance_of_fitted = 1.2, least_of_fitted = 0.04, chance_of_others = 1.63, least_of_others = 0.08;
/// Of one third of the events, of which there are three for each measure: one of 1000.
constexpr double chance_of_third = 1.95;
constexpr std::size_t fewest_in_third = 30;
/// Of the medians.
constexpr double most_errors = 5, fraction_of_fitted = 0.1, fraction_of_others = 0.2;
/// Of c_4 and c_5, in which all real cells differ a little from solids.
constexpr double least_mode_difference = 0.01, most_spreads_of_modes = 0.5;

double greatest_difference(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double greatest = 0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const double at = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= at) ++i;
    while (j < b.size() && b[j] <= at) ++j;
    greatest = std::max(greatest, std::abs(double(i) / double(a.size()) - double(j) / double(b.size())));
  }
  return greatest;
}

/// Beyond which distance of the distributions and which fraction of the spread between the medians there is a misfit,
/// once all values are moved as far towards the others as the convention of the masks allows.
struct Tolerance {
  double chance, least, fraction, convention;
};
Tolerance tolerance_of(MeasureRule rule, double convention) {
  if (rule == MeasureRule::fitted) return {chance_of_fitted, least_of_fitted, fraction_of_fitted, convention};
  return {chance_of_others, least_of_others, fraction_of_others, convention};
}
/// Nothing is fitted to a third by itself.
Tolerance tolerance_of_third(double convention) {
  return {chance_of_third, least_of_others, fraction_of_others, convention};
}

std::vector<double> moved(std::vector<double> values, double by) {
  for (double& value : values) value += by;
  return values;
}

ThirdCheck compared(MeasureRule rule, const Tolerance& tolerance, const std::vector<double>& measured,
                    const std::vector<double>& predicted) {
  ThirdCheck check;
  const CountedSample<double> of_measured(measured), of_predicted(predicted);
  check.events = measured.size();
  check.measured = {of_measured.quantile(0.5), error_of_median(of_measured)};
  check.predicted = {of_predicted.quantile(0.5), error_of_median(of_predicted)};
  const double apart = check.predicted.value - check.measured.value,
               move = std::clamp(apart, -tolerance.convention, tolerance.convention);
  check.distance = greatest_difference(moved(measured, move), predicted);
  const double spread = robust_deviation(of_measured), off = std::abs(apart - move),
               chance = most_errors * std::hypot(check.measured.error, check.predicted.error);
  if (rule == MeasureRule::of_all_real_cells) {
    check.fits = off < std::max(std::min(least_mode_difference, most_spreads_of_modes * spread), chance);
    return check;
  }
  const double by_chance = tolerance.chance / std::sqrt(double(check.events));
  check.fits =
      check.distance <= std::max(by_chance, tolerance.least) && off <= std::max(chance, tolerance.fraction * spread);
  return check;
}

/// Of the values whose area lies between two limits.
std::vector<double> within(const CheckedValues& all, double least, double greatest) {
  std::vector<double> values;
  for (std::size_t i = 0; i < all.values.size(); ++i)
    if (all.log_area[i] >= least && all.log_area[i] < greatest) values.push_back(all.values[i]);
  return values;
}

std::vector<ThirdCheck> compared_thirds(MeasureRule rule, double convention, const CheckedValues& measured,
                                        const CheckedValues& predicted) {
  const CountedSample<double> areas(measured.log_area);
  const double lower = areas.quantile(1.0 / 3), upper = areas.quantile(2.0 / 3);
  std::vector<ThirdCheck> thirds;
  for (const auto& [least, greatest] :
       {std::pair(-HUGE_VAL, lower), std::pair(lower, upper), std::pair(upper, HUGE_VAL)}) {
    const auto of_measured = within(measured, least, greatest), of_predicted = within(predicted, least, greatest);
    if (of_measured.size() < fewest_in_third || of_predicted.size() < fewest_in_third) return {};
    thirds.push_back(compared(rule, tolerance_of_third(convention), of_measured, of_predicted));
  }
  return thirds;
}

/// Of all events where these do not fit, else of the first third that does not.
std::string off_text(const MeasureCheck& check) {
  const auto text = [&](std::string_view of_what, const Median& measured, const Median& predicted) {
    return fmt::format("{}{} is {:.4g}, predicted {:.4g}{}", check.name, of_what, measured.value, predicted.value,
                       check.is_fitted ? "" : " (not fitted)");
  };
  constexpr std::array of_thirds{" of the smallest third", " of the middle third", " of the largest third"};
  const auto third = std::ranges::find(check.thirds, false, &ThirdCheck::fits);
  if (!check.fits_together || third == check.thirds.end()) return text("", check.measured, check.predicted);
  return text(of_thirds[std::size_t(third - check.thirds.begin())], third->measured, third->predicted);
}

}  // namespace

std::vector<double> check_places() {
  std::vector<double> places;
  for (int k = 1; k < 20; ++k) places.push_back(0.05 * k);
  return places;
}

double mask_convention(std::string_view measure, double pixel_size_um, const std::vector<double>& log_area) {
  // Median differences over cells in channels of 15 to 40 um (bench/independent_recordings.py; of c6 and c7 round and
  // elongated virtual cells of 6.5 um).
  constexpr std::array of_pixel_over_radius{std::pair("d", 0.0055), std::pair("c4", 0.016), std::pair("c5", 0.008),
                                            std::pair("c6", 0.005), std::pair("c7", 0.005)};
  for (const auto& [name, factor] : of_pixel_over_radius)
    if (measure == name) return factor * pixel_size_um / std::sqrt(std::exp(median_of(log_area)) / std::numbers::pi);
  return 0;
}

MeasureCheck compared_measure(std::string name, MeasureRule rule, const CheckedValues& measured,
                              const CheckedValues& predicted, double convention) {
  MeasureCheck check;
  check.is_fitted = rule == MeasureRule::fitted || rule == MeasureRule::fitted_among_others;
  check.name = std::move(name);
  const CountedSample<double> of_measured(measured.values), of_predicted(predicted.values);
  check.spread = robust_deviation(of_measured);
  for (const double place : check_places()) {
    check.measured_quantiles.push_back(of_measured.quantile(place));
    check.predicted_quantiles.push_back(of_predicted.quantile(place));
  }
  const ThirdCheck together = compared(rule, tolerance_of(rule, convention), measured.values, predicted.values);
  check.events = together.events;
  check.distance = together.distance;
  check.measured = together.measured;
  check.predicted = together.predicted;
  check.fits_together = together.fits;
  check.thirds = compared_thirds(rule, convention, measured, predicted);
  check.fits = together.fits && std::ranges::all_of(check.thirds, &ThirdCheck::fits);
  return check;
}

std::string check_text(const std::vector<MeasureCheck>& checks) {
  std::string off;
  double greatest = 0;
  for (const MeasureCheck& check : checks) {
    greatest = std::max(greatest, check.distance);
    if (!check.fits) off += (off.empty() ? "" : "; ") + off_text(check);
  }
  if (checks.empty()) return "nothing could be checked";
  if (off.empty())
    return fmt::format("all measures fit, also those that were not fitted (greatest distance {:.2f})", greatest);
  return "does not fit: " + off;
}

}  // namespace rheocyte
