// How a property is spread over a population.
#pragma once
#include <cmath>

namespace rheocyte {

struct Spread {
  enum class Law { normal, lognormal };
  Law law = Law::normal;
  double mean = 0, deviation = 0;  ///< of the property itself, also for the lognormal law

  /// The value that belongs to a standard normal number.
  double at(double normal) const {
    if (law == Law::normal) return mean + deviation * normal;
    const double variance = std::log1p(deviation * deviation / (mean * mean));
    return mean * std::exp(std::sqrt(variance) * normal - 0.5 * variance);
  }
};

}  // namespace rheocyte
