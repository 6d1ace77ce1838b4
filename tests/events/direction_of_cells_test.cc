// In which direction the cells of a recording move.
#include "events/direction_of_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measurement/recording_writer.h"

namespace rheocyte::direction_of_cells_test {
namespace {

/// Of twenty ellipses of this area, 2.6 times as long as wide, with a third mode.
int direction_of(double area_um2, double mode_3) {
  constexpr double pixel_um = 0.34, aspect = 2.6;
  constexpr int points = 120;
  const test::ScratchFolder folder;
  {
    test::RecordingWriter writer(folder / "cells.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("pos_x", std::vector<double>(20, 20));
    for (int event = 0; event < 20; ++event) {
      const double radius_px = std::sqrt(area_um2 / std::numbers::pi) / pixel_um + 0.05 * event;
      std::vector<int> xy;
      for (int k = 0; k < points; ++k) {
        const double angle = 2 * std::numbers::pi * k / points,
                     ellipse = radius_px /
                               std::hypot(std::cos(angle) / std::sqrt(aspect), std::sin(angle) * std::sqrt(aspect)),
                     r = ellipse * (1 + mode_3 * std::cos(3 * angle));
        xy.push_back(int(std::lround(60 + 0.1 * event + r * std::cos(angle))));
        xy.push_back(int(std::lround(40 + r * std::sin(angle))));
      }
      writer.contour(xy);
    }
  }
  const Recording recording(folder / "cells.rtdc");
  EventOutlines outlines(recording, pixel_um);
  return direction_of_cells(outlines, 1);
}

TEST(DirectionOfCells, LongCellsCountUnlessTheyAreAsSmallAsRedOnes) {
  EXPECT_EQ(direction_of(100, 0.06), 1);
  EXPECT_EQ(direction_of(100, -0.06), -1);
  EXPECT_EQ(direction_of(35, 0.06), 0) << "red cells tell nothing";
}

}  // namespace
}  // namespace rheocyte::direction_of_cells_test
