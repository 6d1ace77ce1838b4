#include "numeric/special_functions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheocyte {

double legendre(int n, double x) {
  double before = 1, now = x;
  if (n == 0) return before;
  for (int k = 2; k <= n; ++k) {
    const double next = 2 * x * now - before - (x * now - before) / k;
    before = now;
    now = next;
  }
  return now;
}

// The series of positive terms, as long as it is short; else the integral over a whole period, for which the
// trapezoidal rule converges faster than any power.
double scaled_bessel_i(int n, double x) {
  constexpr double longest_series = 30;
  if (x < longest_series) {
    double term = std::exp(-x);
    for (int k = 1; k <= n; ++k) term *= x / (2 * k);
    double sum = term;
    for (int k = 1; term > 1e-18 * sum; ++k) {
      term *= x * x / (4.0 * k * (k + n));
      sum += term;
    }
    return sum;
  }
  const int points = 40 + int(8 * std::sqrt(x));
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / points;
    sum += std::exp(-2 * x * std::pow(std::sin(angle / 2), 2)) * std::cos(n * angle);
  }
  return sum / points;
}

// K_n(x) = int exp(-x cosh t) cosh(n t) dt over t > 0: the trapezoidal rule converges in the same way, with an error of
// exp(-2 pi^2 / (step^2 x)) where x is large.
double scaled_bessel_k(int n, double x) {
  constexpr double least = 1e-20;
  const double step = std::min(1.0 / 32, 0.6 / std::sqrt(x));
  double sum = 0.5;
  for (int i = 1;; ++i) {
    const double t = i * step, term = std::exp(-2 * x * std::pow(std::sinh(t / 2), 2)) * std::cosh(n * t);
    sum += term;
    if (term < least * sum) return step * sum;
  }
}

}  // namespace rheocyte
