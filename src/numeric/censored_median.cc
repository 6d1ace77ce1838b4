#include "numeric/censored_median.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/quantile.h"

namespace rheocyte {
namespace {

/// Of the standard normal distribution at 1/2 + p, |p| <= 1/4, to 2e-4: the first terms of the inverse error function.
double normal_quantile(double p) {
  const double x = std::sqrt(2 * std::numbers::pi) * p, square = x * x;
  return x * (1 + square * (1.0 / 6 + square * (7.0 / 120 + square * 127.0 / 5040)));
}

/// Numbers in the order of size, of which the first one known has the rank 0.
class KnownRanks {
 public:
  explicit KnownRanks(std::span<const double> known) : sample_(known), last_(double(known.size() - 1)) {}

  bool holds(double rank) const { return rank >= 0 && rank <= last_; }
  double at(double rank) const {
    return last_ > 0 ? sample_.quantile(std::clamp(rank / last_, 0.0, 1.0)) : sample_.quantile(0);
  }
  double last() const { return last_; }

 private:
  CountedSample<double> sample_;
  double last_;
};

}  // namespace

CensoredMedian censored_median(std::span<const double> known, const CensoredCounts& counts) {
  CensoredMedian m{.known = known.size(), .below = counts.below, .above = counts.above, .anywhere = counts.anywhere};
  if (known.empty()) {
    const bool decided = 2 * std::max(m.below, m.above) > m.all();
    if (decided) m.place = m.below > m.above ? MedianPlace::below : MedianPlace::above;
    return m;
  }
  const KnownRanks ranks(known);
  // Those that may be anywhere leave the median where it is if they lie as the others do.
  const double placed = double(m.known + m.below + m.above), shift = 0.5 * double(m.anywhere),
               middle = 0.5 * (placed - 1) - double(m.below), deviation = 0.5 * std::sqrt(placed);
  const bool most_are_known = 2 * m.known >= m.all();
  if (most_are_known && ranks.holds(middle - shift - deviation) && ranks.holds(middle + shift + deviation)) {
    const double quarter = (placed - 1) / 4, width = std::min({quarter, middle, ranks.last() - middle});
    const double spread =
        (ranks.at(middle + width) - ranks.at(middle - width)) / (2 * normal_quantile(width / (placed - 1)));
    m.place = MedianPlace::inside;
    m.value = ranks.at(middle);
    m.error = 1.25 * spread / std::sqrt(placed);
    m.half_range = (ranks.at(middle + shift) - ranks.at(middle - shift)) / 2;
    return m;
  }
  const bool is_below = m.below > m.above;
  const double farthest = is_below ? middle + shift + 2 * deviation : middle - shift - 2 * deviation;
  const bool is_bounded = is_below ? farthest <= ranks.last() : m.above > m.below && farthest >= 0;
  if (!is_bounded) return m;
  m.place = is_below ? MedianPlace::below : MedianPlace::above;
  if (ranks.holds(farthest)) m.bound = ranks.at(farthest);
  return m;
}

}  // namespace rheocyte
