#include "infer/added_ellipse.h"

#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

// bench/ellipse_law fitted them to shapes of the table LE-2D-26 (4000 shapes).
constexpr EllipseLaw mode_3_law{0.153744, 0.582024, 5.97711,  -23.0454, -58.0077, 137.394,
                                0.285654, -10.0629, -164.926, 308.763,  878.08,   -458.371,
                                2.72895,  28.172,   504.756,  -372.397, -856.644, -4197.99};
constexpr EllipseLaw area_law{-0.00872231, -0.0389685, -1.09821, 1.74354,  9.90303,  -20.7857,
                              -0.803694,   0.728917,   30.4572,  -11.8248, -68.9277, -240.323,
                              0.913239,    -1.49273,   -78.4632, -37.1277, -204.365, 1101.29};
constexpr double min_fitted_excess = -0.02, max_fitted_excess = 0.25, max_fitted_mode_3 = 0.15;
const double min_fitted_area = std::log(0.3), max_fitted_area = std::log(3.0);
constexpr double share_left = 0.15;  // of the change, by the law

/// What the law gives.
Packet sum_of(const EllipseLaw& law, const std::array<Packet, 18>& terms) {
  Packet sum = law[0] * terms[0];
  for (std::size_t i = 1; i < law.size(); ++i) sum += law[i] * terms[i];
  return sum;
}

}  // namespace

template <class Number>
std::array<Number, 18> ellipse_terms(const LongOutlineOf<Number>& outline) {
  constexpr std::size_t powers_of_excess = 3, powers_of_mode_3 = 3;
  using std::exp;
  const Number half = outline.log_area / 2, radius = exp(half) * std::numbers::inv_sqrtpi;
  std::array<Number, 18> terms;
  Number ellipse = outline.excess;
  for (std::size_t i = 0; i < powers_of_excess; ++i, ellipse *= outline.excess) {
    Number term = ellipse;
    for (std::size_t j = 0; j < powers_of_mode_3; ++j, term *= outline.mode_3) {
      const std::size_t at = 2 * (powers_of_mode_3 * i + j);
      terms[at] = term;
      terms[at + 1] = term * radius;
    }
  }
  return terms;
}

template std::array<double, 18> ellipse_terms(const LongOutline&);

WithoutEllipse without_ellipse(const LongOutlineOf<Packet>& outline) {
  const auto terms = ellipse_terms<Packet>({clamped(outline.excess, min_fitted_excess, max_fitted_excess),
                                            clamped(outline.mode_3, 0, max_fitted_mode_3),
                                            clamped(outline.log_area, min_fitted_area, max_fitted_area)});
  const Packet change = sum_of(mode_3_law, terms);
  return {change, sum_of(area_law, terms), share_left * change.abs()};
}

}  // namespace rheocyte
