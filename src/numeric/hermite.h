// Polynomials through values with slopes: the cubic through two, and that through several.
#pragma once
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "numeric/lagrange.h"
#include "numeric/roots.h"

namespace rheocyte {

/// Weights of the values and slopes at the ends of an interval at a place of it, 0 .. 1; slopes per interval.
struct HermiteWeights {
  double first, last, first_slope, last_slope;

  template <class Value>
  auto operator()(const Value& a, const Value& b, const Value& slope_a, const Value& slope_b) const {
    return first * a + last * b + first_slope * slope_a + last_slope * slope_b;
  }
};

inline HermiteWeights hermite(double t) {
  const double s = 1 - t;
  return {s * s * (1 + 2 * t), t * t * (3 - 2 * t), s * s * t, -s * t * t};
}

/// Of the derivative, per interval.
inline HermiteWeights hermite_slope(double t) {
  const double s = 1 - t;
  return {-6 * t * s, 6 * t * s, s * (1 - 3 * t), t * (3 * t - 2)};
}

/// The polynomial of degree 2 n - 1 through values and slopes at n places: what it has at `x` is the sum of the values
/// and slopes times these weights.
inline LagrangeWeights hermite_weights(std::span<const double> places, double x) {
  LagrangeWeights weights{lagrange_weights(places, x).value, {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    double change = 0;  // of ln(Lagrange's polynomial) at its own place
    for (std::size_t k = 0; k < places.size(); ++k)
      if (k != i) change += 1 / (places[i] - places[k]);
    const double square = weights.value[i] * weights.value[i], distance = x - places[i];
    weights.value[i] = square * (1 - 2 * distance * change);
    weights.slope.push_back(square * distance);
  }
  return weights;
}

/// The same polynomial of numbers, in Newton's form, to be asked at many places and for its slope.
class HermitePolynomial {
 public:
  /// Of the places those first between which it is asked for: that is what rounding likes best.
  HermitePolynomial(std::span<const double> places, std::span<const double> values, std::span<const double> slopes) {
    const std::size_t count = 2 * places.size();
    terms_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) terms_.push_back({places[i / 2], values[i / 2]});
    // Divided differences; that of a place with itself is the slope.
    for (std::size_t order = 1; order < count; ++order)
      for (std::size_t i = count - 1; i >= order; --i) {
        const double distance = terms_[i].place - terms_[i - order].place;
        double& here = terms_[i].coefficient;
        here = distance == 0 ? slopes[i / 2] : (here - terms_[i - 1].coefficient) / distance;
      }
  }

  ValueAndSlope at(double x) const {
    ValueAndSlope sum{0, 0};
    for (std::size_t i = terms_.size(); i-- > 0;) {
      sum.slope = sum.slope * (x - terms_[i].place) + sum.value;
      sum.value = sum.value * (x - terms_[i].place) + terms_[i].coefficient;
    }
    return sum;
  }

 private:
  struct Term {
    double place, coefficient;
  };
  std::vector<Term> terms_;
};

/// Up to `most` of `count` places for a polynomial between place(interval) and the next one: these two and others
/// around them. No two are nearer to each other than a third of the interval, because what is uncertain in near ones
/// would be magnified far from them. The places rise or fall.
template <class Place>
std::vector<std::size_t> places_around(std::size_t count, const Place& place, std::size_t interval, std::size_t most) {
  constexpr double least_distance = 1.0 / 3;
  const double distance = least_distance * std::abs(place(interval + 1) - place(interval));
  const auto next = [&](std::size_t from, bool behind) -> std::optional<std::size_t> {
    const double here = place(from);
    for (std::size_t i = from; behind ? ++i < count : i-- > 0;)
      if (std::abs(place(i) - here) >= distance) return i;
    return {};
  };
  std::vector<std::size_t> chosen{interval, interval + 1};
  chosen.reserve(most);
  std::optional<std::size_t> first = interval, last = interval + 1;
  const auto take = [&](std::optional<std::size_t>& end, bool behind) {
    if (!end || chosen.size() == most) return;
    end = next(*end, behind);
    if (end) chosen.push_back(*end);
  };
  while ((first || last) && chosen.size() < most) {
    take(first, false);
    take(last, true);
  }
  return chosen;
}

}  // namespace rheocyte
