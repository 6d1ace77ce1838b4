// The figure of an outline by the ends of the rows is that of its contour, to the last bit.
#include "measurement/shape_in_pixels.h"

#include <gtest/gtest.h>

#include <array>

namespace rheocyte::shape_in_pixels_test {
namespace {

using Modes = std::array<double, mode_count>;

void expect_same(const Eigen::MatrixX2d& outline, double pixel_size_um) {
  FigureInPixels figure(outline, pixel_size_um);
  CellRandom random(3, 0, Purpose::place);
  for (int i = 0; i < 100; ++i) {
    const Eigen::RowVector2d place(random.uniform() - 0.5, random.uniform() - 0.5);
    const Eigen::Vector3d rows = figure.at(place),
                          contour = features_in_pixels(outline, pixel_size_um, place).head<3>();
    EXPECT_EQ(rows, contour) << rows.transpose() << " and " << contour.transpose();
  }
}

TEST(FigureInPixels, OfConvexCellsOfAllSizes) {
  for (const double radius_um : {1.5, 4.0, 9.0})
    for (const Modes& modes : {Modes{}, Modes{0.1, 0.04}, Modes{0.35, 0.1, 0.03, 0.01}})
      expect_same(outline_of_modes(modes, 3.14 * radius_um * radius_um, 400), 0.34);
}

TEST(FigureInPixels, OfDentedCells) {
  expect_same(outline_of_modes({0.2, 0.25, 0.1, 0.08}, 120, 400), 0.34);
  expect_same(outline_of_modes({-0.3, 0, 0.2}, 120, 400), 0.34);
}

/// Rows that the outline crosses four times, and pieces.
TEST(FigureInPixels, OfOutlinesWithSeveralStretchesInARow) {
  Eigen::MatrixX2d fork(7, 2);
  fork << 0, 0, 12, 0, 12, 6, 8, 1, 5, 6.2, 2, 1, 0, 5;
  expect_same(fork, 0.34);
  Eigen::MatrixX2d dumbbell(8, 2);
  dumbbell << 0, 0, 4, 0, 4, 1.9, 4.05, 2, 8, 2.2, 8, 6, 3.95, 6, 3.95, 2;
  expect_same(dumbbell, 0.5);
}

}  // namespace
}  // namespace rheocyte::shape_in_pixels_test
