// A camera sees the silhouette.
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

}  // namespace
}  // namespace rheocyte::outline_test
