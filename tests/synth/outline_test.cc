// A camera sees the silhouette; errors of a segmentation have the size and the length that are asked for.
#include "synth/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rheocyte::outline_test {
namespace {

using std::numbers::pi;

Eigen::MatrixX2d sphere(double radius, int points) {
  const Eigen::ArrayXd angle = Eigen::ArrayXd::LinSpaced(points, 0, pi);
  Eigen::MatrixX2d meridian(points, 2);
  meridian << radius * angle.cos(), radius * angle.sin();
  return meridian;
}

TEST(Silhouette, OfASphereIsItsCircle) {
  const auto outline = silhouette(sphere(5, 181));
  EXPECT_EQ(outline.rows(), 360) << "the poles are not repeated";
  for (Eigen::Index i = 0; i < outline.rows(); ++i) EXPECT_NEAR(outline.row(i).norm(), 5, 1e-12);
  EXPECT_NEAR(outline.col(1).sum(), 0, 1e-9);
}

TEST(Silhouette, HidesADentBehindItsRim) {
  Eigen::MatrixX2d meridian(5, 2);
  meridian << 3, 0, 2, 2, 0, 2.5, -3, 1.5, -1, 0;  // front pole ... rim of the dent, rear pole inside the dent
  const auto outline = silhouette(meridian);
  EXPECT_EQ(outline(4, 0), -3) << "the rear pole is seen at the rim";
  EXPECT_EQ(outline.col(0).maxCoeff(), 3);
}

TEST(Displacement, HasTheWantedSizeAndLength) {
  const auto outline = silhouette(sphere(10, 361));
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
  const auto outline = silhouette(sphere(10, 91));
  CellRandom random(1, 1, Purpose::contour);
  EXPECT_EQ(displaced(outline, {}, random), outline);
}

}  // namespace
}  // namespace rheocyte::outline_test
