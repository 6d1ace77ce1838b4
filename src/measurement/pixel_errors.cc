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

// Coefficients of x^i y^j s^k, k running fastest, with x = c_2 and y = |c_3|, or x = deformation and y = inertia ratio
// - 1; bench/mode_errors fitted them to shapes of the table HE-3D-el-26 (3000 shapes at 100 places each).
constexpr int powers_of_shape = 3, powers_of_s = 2;
using LongLaw = std::array<double, powers_of_shape * powers_of_shape * powers_of_s>;
constexpr LongLaw mode_2_law{0.074341, -0.2486, -8.3124, 28.525, 37.927,  -169.7, 2.0016,  -2.0112, -33.712,
                             138.76,   197.36,  -957.34, 2.4937, -5.1939, 39.617, -365.87, -916.31, 4238.4};
constexpr LongLaw mode_3_law{-7.2937, 18.343,  123.79, -394.52, -518.43, 1708.8, -47.596, 108.87, 396.6,
                             -1501.3, -996.08, 6827.6, -165.06, 479.48,  3331.9, -7427.6, -13692, 13303};
constexpr LongLaw mode_correlation{-0.05813, 0.28134, -7.8654, -13.118, 20.318,  124.71,  -0.78387, 2.9352, 1.3726,
                                   -220.65,  20.317,  1474.1,  -3.0831, 0.81143, -32.719, 576.41,   917.08, -5898.2};
constexpr LongLaw long_deformation_law{0.61177, -0.015962, 0.058773, 0.25764, 3.4554,  -9.3191,
                                       -22.993, 38.318,    -19.119,  76.241,  -21.499, 55.828,
                                       416.79,  -1118.9,   -361.76,  890.28,  199,     -522.05};
constexpr LongLaw inertia_law{-0.086916, 2.6408,  0.85733, 2.291,  7.6324,  -17.564, -39.788, 35.668, -49.461,
                              205.43,    -13.901, 27.182,  602.93, -1409.4, -596.23, 677.79,  162.32, 1.3674};
constexpr LongLaw inertia_correlation{-0.15287, 3.7676,  2.379,  10.377, 6.3809, -19.458, -44.355, -7.6735, -74.094,
                                      33.392,   -10.504, 120.99, 685.52, -1059,  -304.18, 1038.1,  84.11,   -618.16};
// Coefficients of 1, |c_3| and c_2.
using DeviationLaw = std::array<double, 3>;
constexpr DeviationLaw mode_2_deviation{0.43299, -1.0171, 0.072584}, mode_3_deviation{0.26209, 1.0601, -0.17585},
    long_deformation_deviation{0.098452, 0.38616, 0.079869}, inertia_deviation{0.79366, -1.571, 1.9729};
// What the laws leave of single shapes (in s^2); alike in all pictures of one.
constexpr double left_of_mode_2 = 0.1, left_of_mode_3 = 0.065, left_of_deformation = 0.05, left_of_inertia = 0.16;
constexpr double max_correlation = 0.95;
constexpr double min_fitted_mode_2 = -0.1, max_fitted_mode_2 = 0.4, max_fitted_mode_3 = 0.15, min_fitted_inertia = -0.2,
                 max_fitted_inertia = 1.2;

// Below what masks show; for shapes that few pixels cannot have.
constexpr double min_area_deviation = 0.2, min_deformation_deviation = 0.05, min_asymmetry_deviation = 0.14,
                 min_inertia_deviation = 0.4;

template <class Number>
Number value(const Law& law, const Number& deformation, const Number& s) {
  Number sum = 0 * deformation;
  for (std::size_t i = law.size(); i-- > 0;) sum = sum * deformation + law[i][0] + s * (law[i][1] + s * law[i][2]);
  return sum;
}

double value(const LongLaw& law, double x, double y, double s) {
  double sum = 0;
  for (std::size_t i = powers_of_shape; i-- > 0;) {
    double row = 0;
    for (std::size_t j = powers_of_shape; j-- > 0;) {
      const std::size_t first = powers_of_s * (powers_of_shape * i + j);
      row = row * y + law[first] + s * law[first + 1];
    }
    sum = sum * x + row;
  }
  return sum;
}

double value(const DeviationLaw& law, double mode_2, double mode_3) {
  return law[0] + law[1] * mode_3 + law[2] * mode_2;
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

ModeErrors mode_errors(double log_area_px, double mode_2, double mode_3) {
  const double s = inverse_root(log_area_px), s2 = s * s;
  const double second = clamped(mode_2, min_fitted_mode_2, max_fitted_mode_2),
               third = clamped(mode_3, -max_fitted_mode_3, max_fitted_mode_3), size = std::abs(third);
  const auto deviation = [&](const DeviationLaw& law, double left) {
    return s2 * std::hypot(std::max(value(law, second, size), min_asymmetry_deviation), left);
  };
  const double correlation = clamped(value(mode_correlation, second, size, s), -max_correlation, max_correlation);
  return {{s2 * value(mode_2_law, second, size, s), deviation(mode_2_deviation, left_of_mode_2)},
          {s2 * third * value(mode_3_law, second, size, s), deviation(mode_3_deviation, left_of_mode_3)},
          third < 0 ? -correlation : correlation};
}

InertiaErrors inertia_errors(double log_area_px, double deformation, double inertia_ratio) {
  const double s = inverse_root(log_area_px), s2 = s * s;
  const double d = clamped(deformation, 0, max_fitted_deformation),
               longer = clamped(inertia_ratio - 1, min_fitted_inertia, max_fitted_inertia);
  // To second order, for the scatter: i = (1 + c_2) / (1 - c_2) and d = 3/4 c_2^2 + 2 c_3^2.
  const double mode_2 = longer / (2 + longer), mode_3 = std::sqrt(std::max(d - 0.75 * mode_2 * mode_2, 0.0) / 2);
  const auto deviation = [&](const DeviationLaw& law, double least, double left) {
    return s2 * std::hypot(std::max(value(law, mode_2, mode_3), least), left);
  };
  return {s2 * value(long_deformation_law, d, longer, s), s2 * value(inertia_law, d, longer, s),
          deviation(long_deformation_deviation, min_deformation_deviation, left_of_deformation),
          deviation(inertia_deviation, min_inertia_deviation, left_of_inertia),
          clamped(value(inertia_correlation, d, longer, s), -max_correlation, max_correlation)};
}

PixelErrorLaws pixel_error_laws() {
  return {area_law,        deformation_law,    area_deviation_law,       deformation_deviation_law,
          correlation_law, min_area_deviation, min_deformation_deviation};
}

template PixelErrors pixel_errors(const double&, const double&);
template PixelErrorsOf<Packet> pixel_errors(const Packet&, const Packet&);

SmoothAsymmetry without_pixels(const ShapeVector& measured, double pixel_size_um) {
  constexpr int second = int(ShapeFeature::first_mode), third = second + 1;
  const double log_area = measured(int(ShapeFeature::area_um2));
  const double log_area_px = log_area - 2 * std::log(pixel_size_um);
  const PixelErrors pixels = pixel_errors(log_area_px, measured(int(ShapeFeature::deformation)));
  const ModeErrors modes = mode_errors(log_area_px, measured(second), measured(third));
  return {std::exp(log_area) * pixels.area_factor, measured(second) - modes.mode_2.excess,
          measured(third) - modes.mode_3.excess, modes.mode_3.deviation};
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
