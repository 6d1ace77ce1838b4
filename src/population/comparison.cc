#include "population/comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "numeric/roots.h"
#include "population/statistics_laws.h"

namespace rheocyte {
namespace {

double mean_of(std::span<const RecordingMean> means) {
  double sum = 0;
  for (const auto& m : means) sum += m.value;
  return sum / double(means.size());
}

/// Variance of the mean by the scatter of the values.
double variance_of_mean(std::span<const RecordingMean> means) {
  const double mean = mean_of(means), n = double(means.size());
  double sum = 0;
  for (const auto& m : means) sum += (m.value - mean) * (m.value - mean);
  return sum / (n - 1) / n;
}

double sampling_variance(std::span<const RecordingMean> means) {
  double sum = 0;
  for (const auto& m : means) sum += m.variance;
  return sum / double(means.size() * means.size());
}

/// Half the width of an interval, and the two-sided p; none without an error.
struct TestReach {
  double half = 0, p = 0;
};

/// Student's t by the scatter of the recordings, or the normal law of their sampling where that is wider.
void add_wider_test(ConditionDifference& d, double level) {
  TestReach scatter, sampling;
  const double within = (1 + level) / 2;
  if (d.standard_error > 0)
    scatter = {students_t_quantile(d.freedom, within) * d.standard_error,
               students_t_beyond(d.freedom, d.value / d.standard_error)};
  if (d.sampling_error > 0)
    sampling = {normal_quantile(within) * d.sampling_error, normal_beyond(d.value / d.sampling_error)};
  d.is_by_sampling = sampling.half > scatter.half;
  const double half = std::max(scatter.half, sampling.half);
  if (half == 0) return;
  d.lower = d.value - half;
  d.upper = d.value + half;
  d.p = std::max(scatter.p, sampling.p);
}

/// `of_recordings`: variance of the difference by recordings that scatter with a standard deviation of 1.
void add_normal(ConditionDifference& d, double of_recordings, const ComparisonSettings& settings) {
  const double z = normal_quantile((1 + settings.level) / 2);
  d.sampling_lower = d.value - z * d.sampling_error;
  d.sampling_upper = d.value + z * d.sampling_error;
  if (!settings.between_recordings) return;
  const double error = std::hypot(d.sampling_error, *settings.between_recordings * std::sqrt(of_recordings));
  d.known_lower = d.value - z * error;
  d.known_upper = d.value + z * error;
  d.known_p = normal_beyond(d.value / error);
}

/// Sum of squares over the variances, and what restricted maximum likelihood needs.
struct WeightedMeans {
  double mean = 0, sum = 0, squares = 0;

  WeightedMeans(std::span<const RecordingMean> means, double variance) {
    for (const auto& m : means) {
      sum += 1 / (m.variance + variance);
      mean += m.value / (m.variance + variance);
    }
    mean /= sum;
    for (const auto& m : means) squares += (m.value - mean) * (m.value - mean) / (m.variance + variance);
  }
};

/// Where the squares have fallen to a value; 0 if they never are so great.
double deviation_where(std::span<const RecordingMean> means, double squares) {
  const auto excess = [&](double variance) { return WeightedMeans(means, variance).squares - squares; };
  if (excess(0) <= 0) return 0;
  double high = 1e-6;
  while (excess(high) > 0) high *= 4;
  return std::sqrt(bracketed_root(excess, 0, high));
}

/// Slope of the restricted likelihood by the variance between.
double restricted_slope(std::span<const RecordingMean> means, double variance) {
  const double mean = WeightedMeans(means, variance).mean;
  double first = 0, second = 0, third = 0;
  for (const auto& m : means) {
    const double w = 1 / (m.variance + variance);
    first += w;
    second += w * w;
    third += w * w * (m.value - mean) * (m.value - mean);
  }
  return third - first + second / first;
}

}  // namespace

ConditionDifference paired_difference(std::span<const RecordingMean> control, std::span<const RecordingMean> treated,
                                      const ComparisonSettings& settings) {
  assert(control.size() == treated.size());
  std::vector<RecordingMean> differences;
  for (std::size_t j = 0; j < control.size(); ++j)
    differences.push_back({treated[j].value - control[j].value, treated[j].variance + control[j].variance});
  const double sessions = double(control.size());
  ConditionDifference d;
  d.value = mean_of(differences);
  d.sampling_error = std::sqrt(sampling_variance(differences));
  if (differences.size() > 1) {
    d.standard_error = std::sqrt(variance_of_mean(differences));
    d.freedom = sessions - 1;
    add_wider_test(d, settings.level);
  }
  add_normal(d, 2 / sessions, settings);
  return d;
}

ConditionDifference unpaired_difference(std::span<const RecordingMean> control, std::span<const RecordingMean> treated,
                                        const ComparisonSettings& settings) {
  ConditionDifference d;
  d.value = mean_of(treated) - mean_of(control);
  d.sampling_error = std::sqrt(sampling_variance(control) + sampling_variance(treated));
  if (control.size() > 1 && treated.size() > 1) {
    const double a = variance_of_mean(control), b = variance_of_mean(treated);
    d.standard_error = std::sqrt(a + b);
    d.freedom = (a + b) * (a + b) / (a * a / double(control.size() - 1) + b * b / double(treated.size() - 1));
    add_wider_test(d, settings.level);
  }
  add_normal(d, 1 / double(control.size()) + 1 / double(treated.size()), settings);
  return d;
}

ScatterBetween scatter_between(std::span<const RecordingMean> means, double level) {
  if (means.size() < 2) return {};
  const auto slope = [&](double variance) { return restricted_slope(means, variance); };
  double variance = 0;
  if (slope(0) > 0) {
    double high = 1e-6;
    while (slope(high) > 0) high *= 4;
    variance = bracketed_root(slope, 0, high);
  }
  const auto quantile = [&](double p) { return chi_squared_quantile(double(means.size() - 1), p); };
  return {std::sqrt(variance), deviation_where(means, quantile((1 + level) / 2)),
          deviation_where(means, quantile((1 - level) / 2))};
}

}  // namespace rheocyte
