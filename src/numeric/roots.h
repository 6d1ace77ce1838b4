// Zeros of functions of one variable between two places where the signs differ.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace rheocyte {

inline constexpr int max_root_steps = 200;

/// Of a continuous function, to rounding or to `tolerance` in the place: inverse quadratic interpolation where it is
/// safe, else bisection (Chandrupatla 1997, doi 10.1016/S0965-9978(96)00051-8).
template <class Function>
double bracketed_root(const Function& f, double a, double b, double tolerance = 0) {
  double fa = f(a), fb = f(b), fraction = 0.5;
  for (int step = 0;; ++step) {
    const double best = std::abs(fa) < std::abs(fb) ? a : b;
    const double narrow = 2 * std::numeric_limits<double>::epsilon() * std::abs(best) + tolerance;
    if (fa == 0 || fb == 0 || std::abs(b - a) <= 2 * narrow || step == max_root_steps) return best;
    const double rim = narrow / std::abs(b - a), x = a + std::clamp(fraction, rim, 1 - rim) * (b - a), fx = f(x);
    const bool is_beside_a = (fx > 0) == (fa > 0);
    const double c = is_beside_a ? a : b, fc = is_beside_a ? fa : fb;  // the place that leaves the bracket
    if (!is_beside_a) b = a, fb = fa;
    a = x, fa = fx;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    const bool is_safe = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
    fraction = is_safe ? fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb) : 0.5;
  }
}

struct ValueAndSlope {
  double value, slope;
};

/// Of a monotonic function that knows its slope, to `tolerance` in the place: Newton's steps from `x`, bisection where
/// they leave the bracket.
template <class Function>
double bracketed_newton(const Function& f, double low, double high, double x, bool rises, double tolerance) {
  for (int step = 0; step < max_root_steps; ++step) {
    const auto [value, slope] = f(x);
    if (value == 0) break;
    ((value > 0) == rises ? high : low) = x;
    const double newton = x - value / slope, before = x;
    x = newton > low && newton < high ? newton : (low + high) / 2;
    if (std::abs(x - before) <= tolerance) break;
  }
  return x;
}

}  // namespace rheocyte
