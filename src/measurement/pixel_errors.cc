#include "measurement/pixel_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rheocyte {

namespace {

using Law = PixelErrorLaws::Law;

// Coefficients of deformation^i s^j, s = (area in pixels)^(-1/3); bench/pixel_errors fitted them to shapes of several
// models: LE-2D-26 (to d = 0.19 and, by its modes, to 0.06), HE-3D-26, HE-3D-MC083-26 and LE-3D-MC049-26 (500 shapes of
// each at 60 places).
constexpr Law area_law{{{3.95086, -7.00899, 13.1321},
                        {-20.2256, 197.827, -468.645},
                        {324.267, -3711.12, 9134.66},
                        {-1384.83, 16350.1, -41474.5}}};
constexpr Law deformation_law{{{0.669843, -1.65438, 2.94628},
                               {-12.3629, 80.4938, -169.002},
                               {151.988, -1354.67, 3007.39},
                               {-592.891, 5883.52, -13727}}};
constexpr Law area_deviation_law{{{0.359697, 1.31717, -6.03224},
                                  {0.129849, 2.29342, 80.2986},
                                  {22.59, -155.88, -812.134},
                                  {-96.0034, 321.426, 4108.41}}};
constexpr Law deformation_deviation_law{{{0.0909649, 0.121596, -2.3013},
                                         {-0.364209, 38.9552, -55.5344},
                                         {45.6183, -861.063, 1888.32},
                                         {-240.972, 3877.99, -9298.85}}};
constexpr Law correlation_law{{{-1.11222, 3.80416, -14.5582},
                               {25.7011, -281.941, 1112.77},
                               {-437, 5265.94, -19648.1},
                               {1789.2, -22097.7, 81869.6}}};

// Coefficients of c_2^i |c_3|^j s^k, k running fastest; bench/asymmetry_errors fitted them to shapes of the table
// LE-2D-26 with added ellipses (4000 shapes at 80 places each).
constexpr int powers_of_mode = 3, powers_of_s = 2;
using AsymmetryLaw = std::array<double, powers_of_mode * powers_of_mode * powers_of_s>;
constexpr AsymmetryLaw asymmetry_law{-2.67223, 6.18995, 19.351,   -57.3574, -1.98186, 2.82509,
                                     -153.477, 289.294, 1775.81,  -3741.11, -5332.71, 11215.8,
                                     241.079,  27.5765, -1895.08, -3100.73, 1605.49,  25223.2};
constexpr double min_fitted_mode_2 = -0.02, max_fitted_mode_2 = 0.28, max_fitted_mode_3 = 0.15;

// Below what masks show; for shapes that few pixels cannot have.
constexpr double min_area_deviation = 0.2, min_deformation_deviation = 0.05, min_asymmetry_deviation = 0.14;

template <class Number>
Number value(const Law& law, const Number& deformation, const Number& s) {
  Number sum = 0 * deformation;
  for (std::size_t i = law.size(); i-- > 0;) sum = sum * deformation + law[i][0] + s * (law[i][1] + s * law[i][2]);
  return sum;
}

template <class Number>
Number value(const AsymmetryLaw& law, const Number& ellipse, const Number& asymmetry, const Number& s) {
  Number sum = 0 * ellipse;
  for (std::size_t i = powers_of_mode; i-- > 0;) {
    Number row = 0 * ellipse;
    for (std::size_t j = powers_of_mode; j-- > 0;) {
      const std::size_t first = powers_of_s * (powers_of_mode * i + j);
      row = row * asymmetry + law[first] + s * law[first + 1];
    }
    sum = sum * ellipse + row;
  }
  return sum;
}

/// (area in pixels)^(-1/3)
template <class Number>
Number inverse_root(const Number& log_area_px) {
  static const double least = std::log(min_fitted_area_px), greatest = std::log(max_fitted_area_px);
  const Number third = clamped(log_area_px, least, greatest) / -3;
  using std::exp;
  return exp(third);
}

}  // namespace

template <class Number>
PixelErrorsOf<Number> pixel_errors(const Number& log_area_px, const Number& deformation) {
  const Number s = inverse_root(log_area_px), s2 = s * s, d = clamped(deformation, 0, max_fitted_deformation);
  return {1 + s2 * value(area_law, d, s), s2 * value(deformation_law, d, s),
          s2 * at_least(value(area_deviation_law, d, s), min_area_deviation),
          s2 * at_least(value(deformation_deviation_law, d, s), min_deformation_deviation),
          clamped(value(correlation_law, d, s), -1, 1)};
}

template <class Number>
AsymmetryErrorsOf<Number> asymmetry_errors(const Number& log_area_px, const Number& mode_2, const Number& mode_3) {
  using std::abs, std::sqrt;
  const Number s = inverse_root(log_area_px), s2 = s * s;
  const Number ellipse = clamped(mode_2, min_fitted_mode_2, max_fitted_mode_2),
               held = clamped(mode_3, -max_fitted_mode_3, max_fitted_mode_3), asymmetry = abs(held);
  const Number by_chance = s2 * at_least(Number(0.28 + 0.75 * asymmetry - 0.38 * ellipse), min_asymmetry_deviation),
               by_law = left_by_asymmetry_law * asymmetry;
  return {s2 * held * value(asymmetry_law, ellipse, asymmetry, s), sqrt(by_chance * by_chance + by_law * by_law)};
}

PixelErrorLaws pixel_error_laws() {
  return {area_law,        deformation_law,    area_deviation_law,       deformation_deviation_law,
          correlation_law, min_area_deviation, min_deformation_deviation};
}

template PixelErrors pixel_errors(const double&, const double&);
template PixelErrorsOf<Packet> pixel_errors(const Packet&, const Packet&);
template AsymmetryErrors asymmetry_errors(const double&, const double&, const double&);
template AsymmetryErrorsOf<Packet> asymmetry_errors(const Packet&, const Packet&, const Packet&);

SmoothAsymmetry without_pixels(const ShapeVector& measured, double pixel_size_um) {
  constexpr int second = int(ShapeFeature::first_mode), third = second + 1;
  const double log_area = measured(int(ShapeFeature::area_um2));
  const double log_area_px = log_area - 2 * std::log(pixel_size_um);
  const PixelErrors pixels = pixel_errors(log_area_px, measured(int(ShapeFeature::deformation)));
  const AsymmetryErrors asymmetry = asymmetry_errors(log_area_px, measured(second), measured(third));
  return {std::exp(log_area) * pixels.area_factor, measured(second), measured(third) - asymmetry.excess,
          asymmetry.deviation};
}

PixelShape seen_through_pixels(const PixelShape& smooth) {
  PixelShape seen = smooth;
  // The errors are small and change little: each step gains two digits.
  for (int step = 0; step < 8; ++step) {
    const auto errors = pixel_errors(std::log(seen.area_px), seen.deformation);
    seen = {smooth.area_px / errors.area_factor, smooth.deformation + errors.deformation_excess};
  }
  return seen;
}

}  // namespace rheocyte
