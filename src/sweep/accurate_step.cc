#include "sweep/accurate_step.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/hermite.h"
#include "numeric/roots.h"
#include "table/branch.h"

namespace rheocyte {
namespace {

/// Times the requested error: what a sample may be off the polynomial through those around it, and what one sample less
/// may change in the middle of an interval.
constexpr double largest_miss = 50, largest_change = 2;
constexpr double shorter = 0.75;

/// Samples around the interval before the last one, nearest first: its ends, and others before it.
class Around {
 public:
  Around(std::span<const SamplePoint> all, InitialGrowth growth) {
    const SamplePoint& origin = all[all.size() - 2];
    const auto place = [&](std::size_t i) { return std::expm1(all[i].place - origin.place); };
    for (const std::size_t i : places_around(all.size(), place, all.size() - 2, samples_around + 1)) {
      places_.push_back(place(i));
      values_.push_back(all[i].value - growth.power * (all[i].place - origin.place));
      slopes_.push_back((all[i].slope - growth.power) / (1 + places_.back()));
    }
  }

  /// How far the first sample is from the polynomial through all others.
  double miss() const { return std::abs(through(1, places_.size() - 1, 0) - values_.front()); }

  /// What the farthest of the samples of the dense output changes in the middle of the interval.
  double change() const {
    const std::size_t used = std::min(places_.size(), samples_around);
    const double middle = places_[1] / 2;
    return used < 3 ? 0 : std::abs(through(0, used, middle) - through(0, used - 1, middle));
  }

  /// The error within an interval of this length over the miss: that of one sample more on its one side, less on the
  /// other.
  double error(double length) const {
    std::vector<double> places(places_.begin(), places_.end() - 1);
    if (places.size() > 1) places[1] = length;
    double greatest = 0;
    for (const double part : {0.3, 0.4, 0.5, 0.6, 0.7})
      greatest = std::max(greatest, product_of_squares(places, part * length));
    return greatest / product_of_squares(std::span(places_).subspan(1), 0);
  }

 private:
  double through(std::size_t first, std::size_t count, double place) const {
    const auto part = [&](const std::vector<double>& all) { return std::span(all).subspan(first, count); };
    return HermitePolynomial(part(places_), part(values_), part(slopes_)).at(place).value;
  }

  static double product_of_squares(std::span<const double> places, double at) {
    double product = 1;
    for (const double place : places) product *= (at - place) * (at - place);
    return product;
  }

  std::vector<double> places_, values_, slopes_;  ///< places: of the compliance, over that of the first one, - 1
};

}  // namespace

double accurate_step(std::span<const SamplePoint> samples, InitialGrowth growth, double wanted, double limit) {
  const Around around(samples, growth);
  const double miss = around.miss();
  if (miss > largest_miss * wanted || around.change() > largest_change * wanted)
    limit = std::min(limit, shorter * (samples.back().place - samples[samples.size() - 2].place));
  const auto excess = [&](double step) { return miss * around.error(std::expm1(step)) - wanted; };
  return excess(limit) <= 0 ? limit : bracketed_root(excess, 0, limit, 1e-4 * limit);
}

}  // namespace rheocyte
