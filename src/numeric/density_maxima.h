// Whether a sample has two maxima, as two populations have.
#pragma once
#include <span>
#include <tuple>

#include "numeric/no_value.h"

namespace rheocyte {

/// The two maxima of a density, the minimum between them, and the fraction of the sample below that; NaN of a sample
/// that has one maximum, or whose minimum is not deep enough to count.
struct DensityMaxima {
  double lower = no_value, minimum = no_value, upper = no_value, fraction_below = no_value;

  bool are_two() const { return lower < upper; }

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.lower, s.minimum, s.upper, s.fraction_below);
  }
};

/// Of a Gaussian kernel estimate with Silverman's bandwidth 1.06 s n^(-1/5) (Density Estimation, 1986, eq. 3.28), which
/// smooths two maxima too much rather than too little. They count if the minimum lies below both by a quarter of the
/// lower one and by four standard errors, with a tenth of the sample on either side. Of at least 100 finite numbers.
DensityMaxima density_maxima(std::span<const double> values);

}  // namespace rheocyte
