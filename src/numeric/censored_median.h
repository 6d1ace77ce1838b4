// The median of all numbers of a sample, some of which are known only to lie below or above the others.
#pragma once
#include <cstddef>
#include <span>
#include <tuple>

#include "numeric/no_value.h"

namespace rheocyte {

/// How many numbers of a sample are not known: those below the known ones, those above, and those that may be anywhere.
struct CensoredCounts {
  std::size_t below = 0, above = 0, anywhere = 0;
};

/// Where the median of all numbers lies: between known ones; below or above most of them; or nowhere that is known.
enum class MedianPlace { inside, below, above, undetermined };

struct CensoredMedian {
  MedianPlace place = MedianPlace::undetermined;
  double value = no_value;  ///< NaN unless the place is `inside`
  double error = no_value;  ///< standard error by the scatter of the numbers
  /// Half of the range over which the value moves if all of the numbers that may be anywhere lie on one side.
  double half_range = no_value;
  /// Of a median below (above) most known numbers: one that it does not exceed (fall short of) by two standard errors;
  /// NaN if none of the known numbers is such.
  double bound = no_value;
  std::size_t known = 0, below = 0, above = 0, anywhere = 0;

  std::size_t all() const { return known + below + above + anywhere; }
  /// Fraction of the numbers that are known; 0 of none.
  double share() const { return all() == 0 ? 0 : double(known) / double(all()); }

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.place, s.value, s.error, s.half_range, s.bound, s.known, s.below, s.above, s.anywhere);
  }
};

/// The median is `inside` if at least half of the numbers are known and its rank, with its standard error sqrt(n) / 2,
/// lies among them, wherever the numbers are that may be anywhere. Its error is that of a normal distribution, from the
/// widest central range within the quartiles that is known; without unknown numbers error_of_median (quantile.h). None
/// of the known numbers is NaN.
CensoredMedian censored_median(std::span<const double> known, const CensoredCounts& counts);

}  // namespace rheocyte
