// Errors of a segmentation have the size and the length that are asked for, and pictures with them lie where those
// without them do.
#include "measurement/outline_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measurement/shape_in_pixels.h"

namespace rheocyte::outline_noise_test {
namespace {

using std::numbers::pi;

Eigen::MatrixX2d circle(double radius, int points) { return outline_of_modes({}, pi * radius * radius, points); }

TEST(Displacement, HasTheWantedSizeAndLength) {
  const auto outline = circle(10, 720);
  double squares = 0, half = 0, far = 0;
  constexpr int cells = 300;
  int count = 0;
  for (int cell = 0; cell < cells; ++cell) {
    CellRandom random(3, static_cast<std::uint64_t>(cell), Purpose::contour);
    const auto moved = displaced(outline, {0.2, 1.0}, random);
    const Eigen::VectorXd offset = moved.rowwise().norm().array() - 10;
    const double step = 2 * pi * 10 / double(moved.rows());
    const auto lag = [&](double length) {
      const auto shift = Eigen::Index(std::lround(length / step));
      double sum = 0;
      for (Eigen::Index i = 0; i < offset.size(); ++i) sum += offset(i) * offset((i + shift) % offset.size());
      return sum;
    };
    squares += offset.squaredNorm();
    half += lag(2);
    far += lag(8);
    count += int(offset.size());
  }
  // About 300 cells x 60 um / (4 um) independent values; the statistical error is 2 %.
  EXPECT_NEAR(std::sqrt(squares / count), 0.2, 0.01);
  EXPECT_NEAR(half / squares, std::exp(-1), 0.06) << "a smoothing Gaussian of 1 um: correlation exp(-s^2 / 4)";
  EXPECT_NEAR(far / squares, 0, 0.05);
}

TEST(Displacement, NoneLeavesTheOutlineAsItIs) {
  const auto outline = circle(10, 180);
  CellRandom random(1, 1, Purpose::contour);
  EXPECT_EQ(displaced(outline, {}, random), outline);
}

TEST(Displacement, OfTheOtherSignGoesToTheOtherSide) {
  const auto outline = circle(10, 512);
  CellRandom random(1, 1, Purpose::contour), again = random;
  const Eigen::ArrayXd out = displaced(outline, {0.2}, random).rowwise().norm().array() - 10,
                       in = displaced(outline, {-0.2}, again).rowwise().norm().array() - 10;
  EXPECT_GT(out.abs().maxCoeff(), 0.1);
  EXPECT_LT((out + in).abs().maxCoeff(), 1e-3);
}

/// What a displacement adds is found from few pictures only because the pixels are the same with it and without it.
TEST(Displacement, OfPicturesDoesNotChangeTheirPlaces) {
  const auto outline = circle(6, 512);
  CellRandom random(1, 1, Purpose::picture), again = random, other(1, 2, Purpose::picture);
  const ShapeErrors without = errors_in_pixels(outline, 0.34, 10, random),
                    nearly = errors_in_pixels(outline, 0.34, 20, again, {1e-6}),
                    elsewhere = errors_in_pixels(outline, 0.34, 10, other);
  EXPECT_LT((nearly.bias - without.bias).norm(), 1e-4);
  EXPECT_GT((elsewhere.bias - without.bias).norm(), 1e-3);
}

}  // namespace
}  // namespace rheocyte::outline_noise_test
