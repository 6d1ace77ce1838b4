#include "measurement/pixel_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rheocyte {

namespace {

using Law = PixelErrorLaws::Law;

// Coefficients of deformation^i s^j, s = (area in pixels)^(-1/3); bench/pixel_errors fitted them to shapes of the table
// LE-2D-26 (3000 shapes at 200 places each).
constexpr Law area_law{{{3.94262, -7.32887, 15.9769},
                        {-9.27827, 102.943, -333.656},
                        {60.4384, -1161.07, 3844.76},
                        {-107.715, 3548.28, -12038.4}}};
constexpr Law deformation_law{{{0.665119, -1.80376, 3.93623},
                               {-6.85248, 37.1915, -99.2552},
                               {36.9698, -368.271, 1008.98},
                               {-55.7111, 1037.55, -2871.52}}};
constexpr Law area_deviation_law{{{0.375726, 0.74986, -2.88345},
                                  {-0.195399, 17.2389, -35.4547},
                                  {19.8009, -324.359, 743.517},
                                  {-89.6644, 1263.87, -2986.36}}};
constexpr Law deformation_deviation_law{{{0.0920098, -0.00839, -1.2748},
                                         {0.419083, 28.0091, -53.0592},
                                         {8.35079, -382.294, 973.785},
                                         {-40.5009, 1287.57, -3819.62}}};
constexpr Law correlation_law{{{-1.0575, 2.81051, -9.41081},
                               {16.342, -153.175, 590.268},
                               {-213.815, 2413.81, -8839.48},
                               {728.66, -8786.06, 31960.6}}};

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
