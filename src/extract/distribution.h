// Quartiles, mean and scatter of numbers.
#pragma once
#include <span>

namespace rheocyte {

/// Of the events with a modulus (kPa); NaN if there are none, the standard deviation (n - 1) also for a single one.
struct Distribution {
  double median = 0, first_quartile = 0, third_quartile = 0, mean = 0, standard_deviation = 0;
};

/// Quartiles between two values are interpolated linearly.
Distribution distribution_of(std::span<const double> values);

}  // namespace rheocyte
