#include "solve/local_errors.h"

#include <algorithm>
#include <cmath>

#include "solve/bdf.h"

namespace rheocyte {
namespace {

/// A step that is done: its formula, and the levels before it from which it is extrapolated.
class DoneStep {
 public:
  DoneStep(const std::vector<TimePoint>& levels, std::size_t end) : levels_(levels), end_(end) {
    const std::size_t order = std::min<std::size_t>(levels[end].order, end), count = std::min(order + 1, end);
    std::vector<double> past;
    for (std::size_t i = 1; i <= count; ++i) past.push_back(levels[end - i].time);
    formula_ = bdf_formula(past, int(order), levels[end].time);
    weights_ = extrapolation_weights(past, levels[end].time);
  }

  double distance_from_extrapolated(const auto& value) const {
    double extrapolated = 0;
    for (int i = 0; i < weights_.size(); ++i) extrapolated += weights_(i) * value(levels_[end_ - 1 - std::size_t(i)]);
    const double distance = std::abs(value(levels_[end_]) - extrapolated);
    return std::isfinite(distance) ? distance : 0;
  }
  double local_error(const auto& value) const {
    return (is_first() ? error_fraction_of_first_step : formula_.error_fraction) * distance_from_extrapolated(value);
  }
  /// Of the position, which goes on with the extrapolated velocity; in the first step that is all there is.
  double error_of_position() const {
    const double by_formula = is_first() ? 0 : local_error([](const TimePoint& level) { return level.position; });
    const auto velocity = [](const TimePoint& level) { return level.state.cell_velocity; };
    return by_formula + distance_from_extrapolated(velocity) / formula_.rate;
  }

 private:
  bool is_first() const { return end_ == 1; }

  const std::vector<TimePoint>& levels_;
  std::size_t end_;
  BdfFormula formula_;
  Eigen::VectorXd weights_;
};

}  // namespace

LocalErrors local_errors(const std::vector<TimePoint>& levels) {
  LocalErrors errors;
  double position = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    StateNumbers numbers;
    for (const StateMeasure& measure : state_measures) measure.of(numbers) = 0;
    if (i > 0) {
      const DoneStep step(levels, i);
      for (const StateMeasure& measure : state_measures)
        measure.of(numbers) = step.local_error([&](const TimePoint& level) { return measure.value(level.state); });
      position += step.error_of_position();
    }
    errors.numbers.push_back(numbers);
    errors.positions.push_back(position);
  }
  return errors;
}

}  // namespace rheocyte
