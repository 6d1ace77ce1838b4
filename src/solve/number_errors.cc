#include "solve/number_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rheocyte {
namespace {

double size_of(const StateMeasure& measure, double value) { return measure.is_departure() ? 1 : std::abs(value); }

/// How much changes from the last but one of some states to the last one.
struct LastChange {
  double outline;     ///< as in change_of_outline, or a fraction of that of the surface's stretch at single points
  double points = 0;  ///< the greatest relative change of a number at single points

  LastChange(const StateNumbers& before, const StateNumbers& last) {
    double stretch = 0;
    for (const StateMeasure& measure : state_measures) {
      const double change = std::abs(measure.value(last) - measure.value(before));
      const double size = size_of(measure, measure.value(last));
      if (measure.settles_with != SettlesWith::points || !(change > 0 && size > 0)) continue;
      points = std::max(points, change / size);
      if (unit_of(measure.name).dimension == no_unit.dimension) stretch = std::max(stretch, change / size);
    }
    // Outlines may agree by chance; the stretch at one point, which is right later, hardly does then, too.
    constexpr double fraction_of_stretch = 1e-3;
    outline = std::max(change_of_outline(before, last), fraction_of_stretch * stretch);
  }
};

/// The factors are those of random cells of all kinds (docs/verification.md, "The stated error of every number").
double error_with_others(const StateMeasure& measure, double error, double value, const LastChange& change) {
  constexpr double of_pressures = 2, of_points = 3, of_greatest_at_points = 0.5;
  const double size = size_of(measure, value);
  if (error == 0) return 0;  // given, or a limit that is not passed
  switch (measure.settles_with) {
    case SettlesWith::itself: return error;
    case SettlesWith::points: return std::max(of_points * error, of_greatest_at_points * size * change.points);
    case SettlesWith::pressure: return std::max(of_pressures * error, size * change.outline);
    case SettlesWith::outline: break;
  }
  return std::max(error, size * change.outline);
}

}  // namespace

double error_of_last(std::span<const double> values, double fraction_of_change_before) {
  const std::size_t n = values.size();
  if (n < 2) return std::numeric_limits<double>::infinity();
  const double change = values[n - 1] - values[n - 2];
  if (n == 2) return 2 * std::abs(change);
  const double before = values[n - 2] - values[n - 3];
  const double ratio = before == 0 ? 0 : std::min(change / before, 0.9);
  const double fraction = ratio < 0 ? 1 : std::max(0.5, ratio / (1 - ratio));  // below 0: changes of alternating sign
  return std::max(fraction * std::abs(change), fraction_of_change_before * std::abs(before));
}

double change_of_outline(const StateNumbers& before, const StateNumbers& after) {
  const RadiusModes &a = before.shape.modes_raw, &b = after.shape.modes_raw;
  double squares = 0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += std::pow(b[k] - a[k], 2);
  return std::sqrt(squares / double(a.size()));
}

StateNumbers unknown_numbers() {
  StateNumbers numbers;
  for (const StateMeasure& measure : state_measures) measure.of(numbers) = no_value;
  return numbers;
}

StateNumbers errors_of_last(std::span<const StateNumbers> rungs, double error_of_deformation) {
  StateNumbers errors = unknown_numbers();
  if (rungs.size() < 2) return errors;
  const LastChange change(rungs[rungs.size() - 2], rungs.back());
  for (const StateMeasure& measure : state_measures) {
    std::vector<double> values;
    for (const StateNumbers& rung : rungs) values.push_back(measure.value(rung));
    measure.of(errors) = error_with_others(measure, error_of_last(values), values.back(), change);
  }
  errors.shape.deformation = error_of_deformation * std::abs(rungs.back().shape.deformation);
  return errors;
}

StateNumbers errors_of_change(const StateNumbers& coarser, const StateNumbers& numbers, double min_outline) {
  constexpr double of_outline = 1;
  StateNumbers errors = unknown_numbers();
  LastChange change(coarser, numbers);
  change.outline = std::max(change.outline, min_outline);
  for (const StateMeasure& measure : state_measures) {
    const double value = measure.value(numbers);
    measure.of(errors) = error_with_others(measure, std::abs(measure.value(coarser) - value), value, change);
  }
  // It is of second order in the outline's modes: relative to itself it changes by twice as much as they do.
  const double d = numbers.shape.deformation, outline = change_of_outline({}, numbers);
  errors.shape.deformation = std::abs(coarser.shape.deformation - d);
  if (outline > 0)
    errors.shape.deformation =
        std::max(errors.shape.deformation, change.outline * std::min(of_outline * std::abs(d) / outline, 1.0));
  return errors;
}

StateNumbers distance(const StateNumbers& a, const StateNumbers& b) {
  StateNumbers differences;
  for (const StateMeasure& measure : state_measures)
    measure.of(differences) = std::abs(measure.value(a) - measure.value(b));
  return differences;
}

void take_greater(const StateNumbers& others, StateNumbers& errors) {
  for (const StateMeasure& measure : state_measures)
    measure.of(errors) = std::max(measure.value(errors), measure.value(others));
}

void add_errors(double factor, const StateNumbers& more, StateNumbers& errors) {
  for (const StateMeasure& measure : state_measures) measure.of(errors) += factor * measure.value(more);
}

}  // namespace rheocyte
