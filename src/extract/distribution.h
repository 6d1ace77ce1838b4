// Quartiles, mean and scatter of numbers.
#pragma once
#include <span>
#include <string>

namespace rheocyte {

/// Of the events with a modulus (kPa); NaN if there are none, the standard deviation (n - 1) and the standard error of
/// the median also for a single one.
struct Distribution {
  double median = 0, first_quartile = 0, third_quartile = 0, mean = 0, standard_deviation = 0, median_error = 0;
};

/// Quartiles between two values are interpolated linearly.
Distribution distribution_of(std::span<const double> values);

/// "1.352 +- 0.008", without the error where there is none.
std::string median_text(const Distribution& distribution);

}  // namespace rheocyte
