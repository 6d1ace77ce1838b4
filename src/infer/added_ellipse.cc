#include "infer/added_ellipse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

// bench/ellipse_law fitted them to shapes of the table LE-2D-26 (4000 shapes).
const EllipseLaw mode_3_law{{0.153744, 0.582024, 5.97711, -23.0454, -58.0077, 137.394, 0.285654, -10.0629, -164.926,
                             308.763, 878.08, -458.371, 2.72895, 28.172, 504.756, -372.397, -856.644, -4197.99}};
const EllipseLaw area_law{{-0.00872231, -0.0389685, -1.09821, 1.74354, 9.90303, -20.7857, -0.803694, 0.728917, 30.4572,
                           -11.8248, -68.9277, -240.323, 0.913239, -1.49273, -78.4632, -37.1277, -204.365, 1101.29}};
constexpr double min_fitted_excess = -0.02, max_fitted_excess = 0.25, max_fitted_mode_3 = 0.15;
const double min_fitted_area = std::log(0.3), max_fitted_area = std::log(3.0);
constexpr double share_left = 0.15;  // of the change, by the law

}  // namespace

EllipseTerms ellipse_terms(const LongOutline& outline) {
  constexpr int powers_of_excess = 3, powers_of_mode_3 = 3;
  const double radius = std::exp(outline.log_area / 2) * std::numbers::inv_sqrtpi;
  EllipseTerms terms;
  double ellipse = outline.excess;
  for (int i = 0; i < powers_of_excess; ++i, ellipse *= outline.excess) {
    double term = ellipse;
    for (int j = 0; j < powers_of_mode_3; ++j, term *= outline.mode_3) {
      const int at = 2 * (powers_of_mode_3 * i + j);
      terms(at) = term;
      terms(at + 1) = term * radius;
    }
  }
  return terms;
}

WithoutEllipse without_ellipse(const LongOutline& outline) {
  const auto terms = ellipse_terms({std::clamp(outline.excess, min_fitted_excess, max_fitted_excess),
                                    std::min(outline.mode_3, max_fitted_mode_3),
                                    std::clamp(outline.log_area, min_fitted_area, max_fitted_area)});
  const double change = terms.dot(mode_3_law);
  return {change, terms.dot(area_law), share_left * std::abs(change)};
}

}  // namespace rheocyte
