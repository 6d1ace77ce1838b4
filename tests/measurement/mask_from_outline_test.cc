// A pixel belongs to the mask if its centre lies inside the outline; the mask of a circle has the circle's area.
#include "measurement/mask_from_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "measurement/circle_outline.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "numeric/cell_random.h"

namespace rheocyte::mask_from_outline_test {
namespace {

using std::numbers::pi;
using test::circle;

constexpr ImageSize size{64, 48};

int pixels_in(const Eigen::MatrixX2d& outline) {
  std::vector<std::uint8_t> mask(size.pixels(), 7);
  EXPECT_TRUE(fill_mask(outline, size, mask));
  return std::accumulate(mask.begin(), mask.end(), 0);
}

TEST(Mask, HoldsTheCentresInsideAPolygon) {
  Eigen::MatrixX2d box(4, 2);
  box << 9.5, 4.5, 20.5, 4.5, 20.5, 10.5, 9.5, 10.5;
  EXPECT_EQ(pixels_in(box), 11 * 6);
  std::vector<std::uint8_t> mask(size.pixels());
  fill_mask(box, size, mask);
  EXPECT_EQ(mask[5 * size.width + 10], 1);
  EXPECT_EQ(mask[4 * size.width + 10], 0);
  EXPECT_EQ(mask[5 * size.width + 9], 0);
}

TEST(Mask, OfACircleIsThatOfItsDistanceLaw) {
  CellRandom random(5, 0, Purpose::place);
  for (int trial = 0; trial < 20; ++trial) {
    const double x = 30 + random.uniform(), y = 24 + random.uniform(), radius = 10 + 8 * random.uniform();
    int expected = 0;
    for (int row = 0; row < int(size.height); ++row)
      for (int column = 0; column < int(size.width); ++column) expected += std::hypot(column - x, row - y) < radius;
    EXPECT_NEAR(pixels_in(circle(x, y, radius)), expected, 1) << "the polygon is 1e-5 smaller than the circle";
  }
}

TEST(Mask, CountedPixelsHaveTheTrueAreaOnAverage) {
  CellRandom random(6, 0, Purpose::place);
  constexpr int trials = 2000;
  double sum = 0, squares = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const double radius = 15 + random.uniform();
    const double error = pixels_in(circle(30 + random.uniform(), 24 + random.uniform(), radius)) - pi * radius * radius;
    sum += error;
    squares += error * error;
  }
  const double deviation = std::sqrt(squares / trials);
  // Kendall 1948: the number of lattice points in a circle at a random place has the standard deviation
  // 0.6765 sqrt(radius), averaged over radii; 3 % is the statistical error.
  EXPECT_NEAR(deviation, 0.676497 * std::sqrt(15.5), 0.05 * deviation);
  EXPECT_NEAR(sum / trials, 0, 4 * deviation / std::sqrt(double(trials)) + 1e-4 * pi * 15.5 * 15.5);
}

TEST(Mask, ContourThroughCentresLosesHalfAPixelAllRound) {
  // The field's contours run through centres of the outermost pixels: the hull of a circle of radius r pixels loses
  // between 0 and 1 pixel of radius, on average nearly half of one.
  CellRandom random(8, 0, Purpose::place);
  ContourFinder finder;
  ContourMeasurer measurer;
  std::vector<std::uint8_t> mask(size.pixels());
  for (const double radius : {10.0, 20.0}) {
    double lost = 0;
    constexpr int trials = 400;
    for (int trial = 0; trial < trials; ++trial) {
      fill_mask(circle(30 + random.uniform(), 24 + random.uniform(), radius), size, mask);
      lost += radius - std::sqrt(measurer.measure(finder.contour_of({size, mask}), 1).area_um2 / pi);
    }
    EXPECT_GT(lost / trials, 0.2);
    EXPECT_LT(lost / trials, 0.5);
  }
}

TEST(Mask, RefusesWhatReachesBeyondThePicture) {
  std::vector<std::uint8_t> mask(size.pixels());
  EXPECT_TRUE(fill_mask(circle(30, 24, 20), size, mask));
  EXPECT_FALSE(fill_mask(circle(30, 24, 24.5), size, mask));
  EXPECT_FALSE(fill_mask(circle(5, 24, 6), size, mask));
  EXPECT_FALSE(fill_mask(circle(60, 24, 6), size, mask));
}

}  // namespace
}  // namespace rheocyte::mask_from_outline_test
