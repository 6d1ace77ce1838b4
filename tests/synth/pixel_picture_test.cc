// The picture of a cell looks as in bright field.
#include "synth/pixel_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "measurement/circle_outline.h"

namespace rheocyte::pixel_picture_test {
namespace {

using std::numbers::pi;
using test::circle;

constexpr ImageSize size{64, 48};

TEST(Grey, ShowsADarkRimABrightHaloAndTheWalls) {
  const Scene scene{0.34, 23.5, 14};
  CellRandom random(1, 1, Purpose::picture);
  std::vector<std::uint8_t> image(size.pixels());
  draw_grey(circle(30, 23.5, 15), scene, size, random, image);
  const auto mean_of_column = [&](int x) {  // over a few rows near the axis
    int sum = 0;
    for (int y = 22; y < 26; ++y) sum += image[std::size_t(y) * size.width + std::size_t(x)];
    return sum / 4;
  };
  const int background = mean_of_column(60), rim = mean_of_column(45), halo = mean_of_column(48),
            inside = mean_of_column(30);
  EXPECT_LT(rim, background - 40);
  EXPECT_GT(halo, background + 8);
  EXPECT_GT(inside, background + 4);
  EXPECT_LT(image[3 * size.width + 60], background - 30) << "the wall, 7 um from the axis";
}

}  // namespace
}  // namespace rheocyte::pixel_picture_test
