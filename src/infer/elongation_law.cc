#include "infer/elongation_law.h"

#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

// studies/elongation_law fitted them to cells of the table HE-3D-el-26.
constexpr ElongationLaw mode_3_law{-2.11005, 6.58713,  93.3806,  -170.144, -568.017, 1045.2,
                                   14.8043,  -24.2761, -509.359, 1025.96,  4365.03,  -8614.17,
                                   -10.1284, 29.703,   1005.97,  -2212.25, -11722.5, 24430.8};
constexpr ElongationLaw area_law{-0.71753,  0.0865149, 6.92623,  -12.0116, -49.4855, 78.7665,
                                 -0.441368, 0.676054,  26.8486,  -36.6973, -247.092, 325.369,
                                 2.26927,   -3.81413,  -175.135, 265.684,  1219.39,  -1745.24};
constexpr double min_fitted_excess = -0.08, max_fitted_excess = 0.33, max_fitted_mode_3 = 0.14;
const double min_fitted_area = std::log(0.3), max_fitted_area = std::log(3.0);
constexpr double fraction_left = 0.1;  // of the change, by the law

/// What the law gives.
Packet sum_of(const ElongationLaw& law, const std::array<Packet, 18>& terms) {
  Packet sum = law[0] * terms[0];
  for (std::size_t i = 1; i < law.size(); ++i) sum += law[i] * terms[i];
  return sum;
}

}  // namespace

template <class Number>
std::array<Number, 18> elongation_terms(const LongOutlineOf<Number>& outline) {
  constexpr std::size_t powers_of_excess = 3, powers_of_mode_3 = 3;
  using std::exp;
  const Number half = outline.log_area / 2, radius = exp(half) * std::numbers::inv_sqrtpi;
  std::array<Number, 18> terms;
  Number power = outline.excess;
  for (std::size_t i = 0; i < powers_of_excess; ++i, power *= outline.excess) {
    Number term = power;
    for (std::size_t j = 0; j < powers_of_mode_3; ++j, term *= outline.mode_3) {
      const std::size_t at = 2 * (powers_of_mode_3 * i + j);
      terms[at] = term;
      terms[at + 1] = term * radius;
    }
  }
  return terms;
}

template std::array<double, 18> elongation_terms(const LongOutline&);

WithoutElongation without_elongation(const LongOutlineOf<Packet>& outline) {
  const auto terms = elongation_terms<Packet>({clamped(outline.excess, min_fitted_excess, max_fitted_excess),
                                               clamped(outline.mode_3, 0, max_fitted_mode_3),
                                               clamped(outline.log_area, min_fitted_area, max_fitted_area)});
  const Packet change = sum_of(mode_3_law, terms);
  return {change, sum_of(area_law, terms), fraction_left * change.abs()};
}

}  // namespace rheocyte
