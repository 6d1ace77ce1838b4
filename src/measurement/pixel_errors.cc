#include "measurement/pixel_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rheocyte {

namespace {

using Law = PixelErrorLaws::Law;

// Coefficients of deformation^i s^j, s = (area in pixels)^(-1/3); studies/pixel_errors fitted them to shapes of several
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

// Coefficients of x^i y^j s^k, k running fastest; studies/mode_errors fitted them to shapes of the table HE-3D-el-26
// (5000 shapes at 300 places each). Even laws, with x = c_2 and y = |c_3|: i and j to 2, and then c_4 times i and j
// to 1. Odd ones: c_3 times i to 2 and j to 3, and then c_5 times i and j to 1. By inertia, with x = deformation and y
// = inertia ratio - 1: i and j to 2.
using EvenLaw = std::array<double, 26>;
using OddLaw = std::array<double, 32>;
using InertiaLaw = std::array<double, 18>;
constexpr EvenLaw mode_2_law{-0.016569, 0.28542, -0.95268, 11.382,  0.53052, -79.006, 1.1425,  2.3491, 8.9071,
                             22.792,    43.484,  -739.88,  -1.2628, -10.32,  -203.4,  418.47,  635.07, -569.83,
                             7.9349,    -22.396, 62.863,   -60.504, 5.4965,  62.429,  -47.624, -720.2};
constexpr OddLaw mode_3_law{-1.7685, -5.8349, -23.727, 128.64,  785.65,  -1953.4,     -3803.6,     9292,
                            -86.018, 176.62,  952.61,  -4602.3, -2901.8, 47103,       22016,       -2.3919e+05,
                            6.9495,  -231.14, -5291.3, 23945,   98077,   -4.2399e+05, -5.3612e+05, 2.1003e+06,
                            23.921,  -46.25,  -344.47, 849,     -35.17,  145.25,      943.03,      -2653.4};
constexpr EvenLaw mode_4_law{-0.35992, -0.23033, 3.2155, -16.867, -27.815, 206.91,  -0.33723, 1.6527,  25.575,
                             -149,     -30.607,  341.76, 0.37999, 19.192,  109.33,  -107.86,  -1068.1, 2144.7,
                             -16.284,  31.497,   103.82, -242.83, 17.941,  -63.043, -63.187,  -79.895};
constexpr OddLaw mode_5_law{8.3378,  -11.682, 25.75,   -122.32, -996.17, 1955.9,    4492,       -10916,
                            67.764,  -141.09, -621.77, 1244.5,  -6529.1, 22544,     16417,      -37999,
                            246.23,  -1370,   -2929.2, 11406,   -47247,  1.108e+05, 4.1666e+05, -1.0713e+06,
                            -32.617, 90.966,  518.53,  -1698.3, -19.345, 134.83,    278.41,     331.23};
constexpr EvenLaw deformation_by_modes{0.62763, -0.92012, -0.53135, 2.6568,  5.7693,  -27.024, 0.056661,
                                       -0.2524, -2.1493,  6.2833,   58.513,  -244.14, -7.7927, 31.101,
                                       24.55,   -174.86,  -229.18,  519.49,  11.857,  -44.638, 2.0056,
                                       118.55,  -5.4172,  30.664,   -12.142, -152.01};
constexpr EvenLaw inertia_by_modes{-0.036481, 0.27303, -0.51854, 17.01,  14.07,   -191.97, 1.0062,  5.8941, 27.877,
                                   1.2388,    31.136,  -1261.7,  3.5704, -25.738, -372.41, 875.11,  499.67, 935.45,
                                   7.0635,    -17.649, 210.01,   -511,   16.6,    121.82,  -28.564, -1599.5};
constexpr EvenLaw mode_correlation{-0.061792, 0.40497, -9.3091, -10.703,  21.354,  111.61, -0.36118, -0.42159, -21.092,
                                   -125.94,   155.79,  978.81,  -0.31612, -5.5265, 36.978, 341.82,   352.12,   -3674.6,
                                   4.5382,    -7.6791, -130.22, 280.12,   -39.54,  109.7,  554.39,   -1555.9};
constexpr InertiaLaw long_deformation_law{0.61179, -0.022216, 0.05452, 0.27501, 3.0555,  -7.4211,
                                          -22.012, 34.413,    -15.477, 55.991,  -16.709, 38.363,
                                          390.78,  -1017,     -368.19, 964.29,  178.58,  -473.04};
constexpr InertiaLaw inertia_law{-0.095101, 2.8672,  0.80812, 3.1578, 6.6807,  -15.965, -37.793, 16.896, -35.255,
                                 118.84,    -2.0267, 51.399,  549.28, -1036.9, -713.84, 1239.2,  156.93, -375.66};
constexpr InertiaLaw inertia_correlation{-0.13275, 3.6705,  2.3577, 10.235, 5.6843,  -16.705, -46.323, 1.7578, -59.165,
                                         -23.091,  -7.1503, 118.63, 720.43, -1225.8, -517.51, 1820.2,  167.88, -962.39};
// Coefficients of 1, |c_3|, c_2, c_3^2, c_2^2, |c_3| c_2 and s.
using DeviationLaw = std::array<double, 7>;
constexpr DeviationLaw mode_2_deviation{0.38106, -1.2955, 0.55307, 9.9791, 0.39538, -10.228, 0.17242},
    mode_3_deviation{0.27794, 1.9933, -0.76769, -10.085, 1.344, 4.1018, -0.15958},
    mode_4_deviation{0.44448, -1.9938, -0.37973, 12.65, 0.62227, 0.65213, -0.48549},
    mode_5_deviation{0.30438, 2.0074, 0.034956, -12.509, -0.7885, -0.66925, -0.53371},
    long_deformation_deviation{0.088431, -0.066992, 0.14214, 5.8191, 0.40379, -2.709, 0.055633},
    inertia_deviation{0.71394, -2.0369, 2.0487, 13.57, 2.5207, -12.299, 0.30572};
// What the laws leave of single shapes (in s^2); alike in all pictures of one.
constexpr double left_of_mode_2 = 0.04, left_of_mode_3 = 0.05, left_of_mode_4 = 0.055, left_of_mode_5 = 0.06,
                 left_of_deformation_by_modes = 0.015, left_of_deformation = 0.05, left_of_inertia = 0.15;
constexpr double max_correlation = 0.95;
constexpr double min_fitted_mode_2 = -0.1, max_fitted_mode_2 = 0.4, max_fitted_mode_3 = 0.15, max_fitted_mode_4 = 0.15,
                 max_fitted_mode_5 = 0.15, min_fitted_inertia = -0.2, max_fitted_inertia = 1.2;

// Below what masks show; for shapes that few pixels cannot have.
constexpr double min_area_deviation = 0.2, min_deformation_deviation = 0.05, min_asymmetry_deviation = 0.14,
                 min_inertia_deviation = 0.4;

template <class Number>
Number value(const Law& law, const Number& deformation, const Number& s) {
  Number sum = 0 * deformation;
  for (std::size_t i = law.size(); i-- > 0;) sum = sum * deformation + law[i][0] + s * (law[i][1] + s * law[i][2]);
  return sum;
}

/// sum of law[...] x^i y^j s^k, k = 0, 1 running fastest, from a place in the law on; j up to most_y.
double polynomial(std::span<const double> law, std::size_t most_x, double x, std::size_t most_y, double y, double s) {
  double sum = 0;
  for (std::size_t i = most_x + 1; i-- > 0;) {
    double row = 0;
    for (std::size_t j = most_y + 1; j-- > 0;) {
      const std::size_t first = 2 * ((most_y + 1) * i + j);
      row = row * y + law[first] + s * law[first + 1];
    }
    sum = sum * x + row;
  }
  return sum;
}

/// Where the laws of modes are looked up.
struct ModePlace {
  double second, third, fourth, fifth, s;

  ModePlace(const OutlineModes& m, double s_of_area)
      : second(clamped(m.mode_2, min_fitted_mode_2, max_fitted_mode_2)),
        third(clamped(m.mode_3, -max_fitted_mode_3, max_fitted_mode_3)),
        fourth(clamped(m.mode_4, -max_fitted_mode_4, max_fitted_mode_4)),
        fifth(clamped(m.mode_5, -max_fitted_mode_5, max_fitted_mode_5)),
        s(s_of_area) {}

  double even(const EvenLaw& law) const {
    const std::span<const double> all(law);
    const double size = std::abs(third);
    return polynomial(all, 2, second, 2, size, s) + fourth * polynomial(all.subspan(18), 1, second, 1, size, s);
  }
  double odd(const OddLaw& law) const {
    const std::span<const double> all(law);
    const double size = std::abs(third);
    return third * polynomial(all, 2, second, 3, size, s) + fifth * polynomial(all.subspan(24), 1, second, 1, size, s);
  }
};

double value(const DeviationLaw& law, double second, double third, double s) {
  return law[0] + law[1] * third + law[2] * second + law[3] * third * third + law[4] * second * second +
         law[5] * third * second + law[6] * s;
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

ModeErrors mode_errors(double log_area_px, const OutlineModes& modes) {
  const double s = inverse_root(log_area_px), s2 = s * s;
  const ModePlace place(modes, s);
  const auto deviation = [&](const DeviationLaw& law, double least, double left) {
    return s2 * std::hypot(std::max(value(law, place.second, std::abs(place.third), s), least), left);
  };
  constexpr double least = min_asymmetry_deviation;
  const double correlation = clamped(place.even(mode_correlation), -max_correlation, max_correlation);
  return {{s2 * place.even(mode_2_law), deviation(mode_2_deviation, least, left_of_mode_2)},
          {s2 * place.odd(mode_3_law), deviation(mode_3_deviation, least, left_of_mode_3)},
          {s2 * place.even(mode_4_law), deviation(mode_4_deviation, least, left_of_mode_4)},
          {s2 * place.odd(mode_5_law), deviation(mode_5_deviation, least, left_of_mode_5)},
          place.third < 0 ? -correlation : correlation,
          s2 * place.even(deformation_by_modes),
          s2 * place.even(inertia_by_modes),
          deviation(long_deformation_deviation, min_deformation_deviation, left_of_deformation_by_modes)};
}

InertiaErrors inertia_errors(double log_area_px, double deformation, double inertia_ratio) {
  const double s = inverse_root(log_area_px), s2 = s * s;
  const double d = clamped(deformation, 0, max_fitted_deformation),
               longer = clamped(inertia_ratio - 1, min_fitted_inertia, max_fitted_inertia);
  // To second order, for the scatter: i = (1 + c_2) / (1 - c_2) and d = 3/4 c_2^2 + 2 c_3^2.
  const double mode_2 = longer / (2 + longer), mode_3 = std::sqrt(std::max(d - 0.75 * mode_2 * mode_2, 0.0) / 2);
  const auto deviation = [&](const DeviationLaw& law, double least, double left) {
    return s2 * std::hypot(std::max(value(law, mode_2, mode_3, s), least), left);
  };
  const auto by_inertia = [&](const InertiaLaw& law) { return polynomial(law, 2, d, 2, longer, s); };
  return {s2 * by_inertia(long_deformation_law), s2 * by_inertia(inertia_law),
          deviation(long_deformation_deviation, min_deformation_deviation, left_of_deformation),
          deviation(inertia_deviation, min_inertia_deviation, left_of_inertia),
          clamped(by_inertia(inertia_correlation), -max_correlation, max_correlation)};
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
  const ModeErrors modes =
      mode_errors(log_area_px, {measured(second), measured(third), measured(third + 1), measured(third + 2)});
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
