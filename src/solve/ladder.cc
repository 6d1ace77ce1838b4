#include "solve/ladder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rheocyte {
namespace {

/// Only deformations below this are accepted for their small absolute error.
constexpr double tiny_deformation = 1e-5;
/// Less than the standard error that pixels leave of the mean deformation of a thousand events (0.005 each).
constexpr double seen_deformation = 1e-4;
/// A drift is distinguished from none down to this.
constexpr double fraction_of_velocity = 1e-4;

}  // namespace

double estimate_error(const std::vector<double>& values, const ErrorRule& rule) {
  const std::size_t n = values.size();
  if (n < 2) return std::numeric_limits<double>::infinity();
  const double size = std::max(std::abs(values[n - 1]), 1e-300);
  if (n > 2) return error_of_last(values, rule.fraction_of_change_before) / size;
  return std::max(rule.fraction_of_first_change * std::abs(values[1] - values[0]) / size, rule.min_of_two);
}

double deformation_floor(const Problem& problem) {
  if (problem.offset != 0) return seen_deformation;
  return std::min(deformation_round_off / problem.accuracy, tiny_deformation);
}

void Ladder::add(ResolvedState state, const StateNumbers& of_state) {
  rungs.push_back(std::move(state));
  numbers.push_back(of_state);
  std::vector<double> deformations;
  for (const StateNumbers& rung : numbers) deformations.push_back(rung.shape.deformation);
  estimated_error = estimate_error(deformations, rule);
  if (numbers.size() < 2) return;
  const StateNumbers &last = numbers.back(), &before = numbers[numbers.size() - 2];
  const double size = std::max(deformation(), 1e-300);
  estimated_error = std::max(estimated_error, rule.fraction_of_outline * change_of_outline(before, last) / size);
  if (numbers.size() > 2) return;
  const double by_inertia = std::abs(last.shape.inertia_ratio - before.shape.inertia_ratio),
               by_margin =
                   std::abs(last.stability_margin - before.stability_margin) * std::pow(1 - last.stability_margin, 2);
  if (rule.fraction_of_inertia > 0)
    estimated_error = std::max(estimated_error, rule.fraction_of_inertia * by_inertia / size);
  if (rule.fraction_of_margin > 0) estimated_error = std::max(estimated_error, rule.fraction_of_margin * by_margin);
}

double Ladder::stated_error(const Problem& problem) const {
  if (problem.accuracy_of == AccuracyOf::motion && problem.offset != 0) return motion_error(problem.place);
  const double size = std::max(std::abs(deformation()), 1e-300);
  return estimated_error * size / std::max(size, deformation_floor(problem));
}

double Ladder::motion_error(CellPlace place) const {
  if (numbers.size() < 2) return std::numeric_limits<double>::infinity();
  const auto error_of = [this](double StateNumbers::*member, double size) {
    std::vector<double> values;
    for (const StateNumbers& rung : numbers) values.push_back(rung.*member);
    const double own = std::abs(values.back());
    return estimate_error(values, rule) * own / std::max(own, size);
  };
  double error = std::max(error_of(&StateNumbers::cell_velocity, 0), error_of(&StateNumbers::spin, 0));
  if (place == CellPlace::given)
    error =
        std::max(error, error_of(&StateNumbers::drift_velocity, fraction_of_velocity * numbers.back().cell_velocity));
  return numbers.size() == 2 ? std::max(error, rule.min_of_two) : error;
}

}  // namespace rheocyte
