// Polynomials through values and slopes give back polynomials; their places keep a distance.
#include "numeric/hermite.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace rheocyte::hermite_test {
namespace {

double cubic(double x) { return 2 - x + 3 * x * x - 0.5 * x * x * x; }
double slope(double x) { return -1 + 6 * x - 1.5 * x * x; }

TEST(Hermite, GivesBackACubicWithItsSlope) {
  const double a = 1, width = 2.5, b = a + width;
  for (const double t : {0.0, 0.3, 1.0}) {
    const double x = a + t * width;
    EXPECT_NEAR(hermite(t)(cubic(a), cubic(b), width * slope(a), width * slope(b)), cubic(x), 1e-13);
    EXPECT_NEAR(hermite_slope(t)(cubic(a), cubic(b), width * slope(a), width * slope(b)) / width, slope(x), 1e-13);
  }
}

double seventh(double x) { return 1 + x * (2 - x * (1 - x * x * (0.5 - x * (0.25 - 0.1 * x * x)))); }
double slope_of_seventh(double x) { return 2 - 2 * x + 2 * x * x * x - 1.25 * std::pow(x, 4) + 0.7 * std::pow(x, 6); }

TEST(HermitePolynomial, OfFourPlacesGivesBackTheSeventhDegreeWithItsSlope) {
  const std::array<double, 4> places{0.5, 1, -1, 3};
  std::array<double, 4> values{}, slopes{};
  for (std::size_t i = 0; i < places.size(); ++i) {
    values[i] = seventh(places[i]);
    slopes[i] = slope_of_seventh(places[i]);
  }
  const HermitePolynomial polynomial(places, values, slopes);
  for (const double x : {-1.5, -1.0, 0.7, 1.0, 2.5}) {
    EXPECT_NEAR(polynomial.at(x).value, seventh(x), 1e-12) << "rounding";
    EXPECT_NEAR(polynomial.at(x).slope, slope_of_seventh(x), 1e-11) << "rounding";
    const LagrangeWeights weights = hermite_weights(places, x);
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) sum += weights.value[i] * values[i] + weights.slope[i] * slopes[i];
    EXPECT_NEAR(sum, seventh(x), 1e-12) << "rounding";
  }
  EXPECT_EQ(hermite_weights(places, 1).value, (std::vector<double>{0, 1, 0, 0}));
}

using Places = std::vector<std::size_t>;

Places around(const std::vector<double>& places, std::size_t interval, std::size_t most) {
  return places_around(
      places.size(), [&](std::size_t i) { return places[i]; }, interval, most);
}

TEST(PlacesAround, TheNearestOnBothSidesInTurn) {
  const std::vector<double> places{0, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(around(places, 3, 4), (Places{3, 4, 2, 5}));
  EXPECT_EQ(around(places, 3, 3), (Places{3, 4, 2}));
  EXPECT_EQ(around(places, 0, 4), (Places{0, 1, 2, 3}));
  EXPECT_EQ(around(places, 5, 4), (Places{5, 6, 4, 3}));
}

TEST(PlacesAround, ThoseThatAreTooNearAreLeftOut) {
  // In an interval of 1 none is nearer to the next than 1/3.
  EXPECT_EQ(around({0.0, 0.9, 1.0, 2.0, 2.1, 2.4}, 2, 4), (Places{2, 3, 0, 5}));
  EXPECT_EQ(around({-2.0, -2.1, -3.1}, 1, 4), (Places{1, 2})) << "falling";
  EXPECT_EQ(around({1.0, 2.0}, 0, 4), (Places{0, 1}));
}

}  // namespace
}  // namespace rheocyte::hermite_test
