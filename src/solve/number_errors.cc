#include "solve/number_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rheocyte {

double error_of_last(std::span<const double> values, double share_of_change_before) {
  const std::size_t n = values.size();
  if (n < 2) return std::numeric_limits<double>::infinity();
  const double change = values[n - 1] - values[n - 2];
  if (n == 2) return 2 * std::abs(change);
  const double before = values[n - 2] - values[n - 3];
  const double ratio = before == 0 ? 0 : std::min(change / before, 0.9);
  const double share = ratio < 0 ? 1 : std::max(0.5, ratio / (1 - ratio));  // below 0: changes of alternating sign
  return std::max(share * std::abs(change), share_of_change_before * std::abs(before));
}

StateNumbers unknown_numbers() {
  StateNumbers numbers;
  for (const StateMeasure& measure : state_measures) measure.of(numbers) = no_value;
  return numbers;
}

StateNumbers errors_of_last(std::span<const StateNumbers> rungs, double error_of_deformation, double least_of_two) {
  constexpr double share_of_rounding = 1e-12;
  StateNumbers errors = unknown_numbers();
  if (rungs.size() < 2) return errors;
  for (const StateMeasure& measure : state_measures) {
    std::vector<double> values;
    for (const StateNumbers& rung : rungs) values.push_back(measure.value(rung));
    double error = error_of_last(values);
    const double size = std::abs(values.back());
    if (rungs.size() == 2 && error > share_of_rounding * size) error = std::max(error, least_of_two * size);
    measure.of(errors) = error;
  }
  errors.shape.deformation = error_of_deformation * std::abs(rungs.back().shape.deformation);
  return errors;
}

StateNumbers distance(const StateNumbers& a, const StateNumbers& b) {
  StateNumbers differences;
  for (const StateMeasure& measure : state_measures)
    measure.of(differences) = std::abs(measure.value(a) - measure.value(b));
  return differences;
}

void add_errors(double factor, const StateNumbers& more, StateNumbers& errors) {
  for (const StateMeasure& measure : state_measures) measure.of(errors) += factor * measure.value(more);
}

}  // namespace rheocyte
