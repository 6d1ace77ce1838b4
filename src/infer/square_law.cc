#include "infer/square_law.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

namespace {

/// A feature's change is a polynomial times c_3.
struct ChangeLaw {
  int feature;
  double left;  ///< standard deviation of what it leaves, over c_3
  std::array<double, square_term_count> coefficients;
};

constexpr int mode(int k) { return int(ShapeFeature::first_mode) + k - min_mode; }

// bench/square_law.py fitted them.
constexpr std::array<ChangeLaw, 9> laws{{
    {int(ShapeFeature::area_um2), 0.011, {-0.1013, 0.4005,  -0.1377, 0.06081, -0.01926, -0.02123, 0.1963,
                                          -0.3158, 0.1621,  -1.668,  0.01513, 0.07082,  -0.187,   0.04006,
                                          0.5849,  0.1589,  -0.1022, -0.3864, 4.364,    0.3701,   0.5311,
                                          -1.375,  -0.0173, 0.06166, 0.02036, -0.1786,  -0.2058,  -0.1742}},
    {int(ShapeFeature::deformation), 0.0064, {-0.02429,  0.0502,    0.1134,    -0.3064,  0.0143,  0.01491,  0.063,
                                              -0.005565, -0.1694,   0.764,     -0.01396, -0.1098, -0.2423,  -0.04562,
                                              -0.3884,   0.04805,   -0.08926,  -0.2311,  0.5526,  0.03605,  -0.06911,
                                              -0.1189,   -0.006287, -0.008415, 0.03468,  0.1168,  -0.01488, 0.1786}},
    {int(ShapeFeature::moment_ratio), 0.02, {0.1676,  -0.5315,  0.1028,   0.5145,  0.02532, -0.181,  -0.7464,
                                             0.2302,  0.2544,   1.083,    0.06042, 0.4315,  1.22,    -0.3186,
                                             -0.8428, 0.06362,  -0.3923,  -0.6985, -8.74,   -0.6365, 1.543,
                                             6.376,   -0.04021, -0.01752, -0.0303, -0.1045, 0.2465,  0.428}},
    {mode(2), 0.013, {-0.1052,  0.2418,  0.2018,  -0.09588, 0.012,    0.1105,   0.4509,   -0.06827, -0.2427, -0.6063,
                      -0.02819, -0.2669, -0.5631, -0.07145, -0.199,   -0.01588, -0.06953, -0.7294,  4.28,    0.1539,
                      -0.3387,  -2.956,  0.01234, -0.01777, 0.001686, 0.1144,   -0.1109,  -0.1476}},
    {mode(3), 0.013, {-0.02455, 0.1113,   -0.04162, 0.1528,  0.02213, -0.09926, -0.118,     0.02349, -0.1004, 0.1782,
                      -0.02099, -0.03409, -0.2617,  0.09983, 0.2625,  0.09979,  -0.2043,    -0.1047, -3.494,  -0.2007,
                      0.5272,   1.969,    -0.01004, 0.04315, 0.02735, 0.09848,  -0.0006809, 0.2502}},
    {mode(4), 0.011, {-0.01418,  0.07608,  0.1197,  -0.1824, -0.02705, 0.03425, 0.07087,  -0.05922, -0.04128, -1.082,
                      0.01252,   -0.00932, 0.1757,  -0.2436, 0.295,    -0.1456, 0.149,    -0.516,   4.446,    0.1692,
                      -0.007054, -0.3982,  0.01147, 0.06411, -0.06408, -0.1708, -0.06209, -0.2014}},
    {mode(5), 0.0076, {0.01067,  -0.04395,  -0.08428, 0.1558,    0.01168,  -0.02198, 0.06169,
                       -0.06724, 0.4234,    0.7496,   0.02321,   0.006391, -0.03224, -0.1184,
                       -0.4975,  0.03911,   -0.1601,  -0.2868,   -2.929,   -0.09179, -0.05734,
                       -0.7557,  -0.006811, -0.05956, -0.002158, 0.1546,   -0.02507, 0.2206}},
    {mode(6), 0.0093, {0.0177,   -0.04446, 0.1677,   -0.343,   -0.03278, 0.03657,  0.0123,  0.08523,  -0.2922, 0.2601,
                       -0.01181, -0.02084, -0.04273, -0.09821, -0.4945,  -0.02436, 0.07538, -0.06675, 1.585,   0.1057,
                       0.002424, 0.5101,   0.01997,  0.05619,  -0.03352, -0.1535,  0.05058, -0.1078}},
    {mode(7), 0.0067, {-0.03446, 0.05754,   -0.04718, 0.5342,   0.04924, -0.0902,   0.01564,
                       -0.01473, -0.004692, -0.7663,  -0.02968, 0.04032, -0.002944, 0.1697,
                       0.3377,   -0.001028, -0.01466, 0.1356,   -1.145,  -0.1848,   0.2118,
                       -0.4529,  -0.01776,  0.01733,  0.02737,  0.08414, -0.06418,  0.07088}},
}};

/// The cells to which the laws were fitted.
CellInSquare held(const CellInSquare& cell) {
  return {.radius = std::clamp(cell.radius, 0.4, 0.84),
          .mode_2 = std::clamp(cell.mode_2, -0.06, 0.32),
          .mode_3 = std::clamp(cell.mode_3, 0.0, 0.12),
          .cortex_share = std::clamp(cell.cortex_share, 0.0, 1.0),
          .cortex_tension = std::clamp(cell.cortex_tension, 0.0, 0.55),
          .thinning = std::clamp(cell.thinning, 0.0, 0.5)};
}

}  // namespace

std::array<double, square_term_count> square_terms(const CellInSquare& cell) {
  const std::array numbers{cell.radius,       cell.mode_2,         cell.mode_3,
                           cell.cortex_share, cell.cortex_tension, cell.thinning};
  std::array<double, square_term_count> terms;
  auto next = terms.begin();
  *next++ = 1;
  next = std::ranges::copy(numbers, next).out;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t j = i; j < numbers.size(); ++j) *next++ = numbers[i] * numbers[j];
  return terms;
}

ShapeErrors change_by_square(const CellInSquare& cell) {
  const CellInSquare inside = held(cell);
  const auto terms = square_terms(inside);
  ShapeErrors change;
  for (const ChangeLaw& law : laws) {
    double sum = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) sum += law.coefficients[i] * terms[i];
    change.bias(law.feature) = sum * inside.mode_3;
    change.covariance(law.feature, law.feature) = std::pow(law.left * inside.mode_3, 2);
  }
  return change;
}

}  // namespace rheocyte
