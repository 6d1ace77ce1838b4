// Moduli of single images.
#include "population/single_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "invented_map.h"
#include "population/fit_cells.h"

namespace rheocyte::single_images_test {
namespace {

using test::InventedMap;

TEST(SingleImage, OfACellWithoutNoiseHasItsModulus) {
  const InventedMap map;
  for (const double u : {1.6, 1.8, 2.0})
    for (const double x : {0.05, 1.0, 4.0}) {
      const MapPoint p = map.at(u, x);
      const SampleEvent event{p.log_area, p.measure, std::log(2.0)};
      EXPECT_NEAR(log_modulus_of_image(map, event), map.soft_end(u).log_modulus + x + std::log(2.0), 1e-5) << u << x;
    }
}

TEST(SingleImage, ThatLooksRounderThanASphereOrSofterThanTheMapHasNone) {
  const InventedMap map;
  EXPECT_TRUE(std::isnan(log_modulus_of_image(map, {4.75, -0.002})));
  EXPECT_TRUE(std::isnan(log_modulus_of_image(map, {4.75, 0.2})));
}

TEST(SingleImages, AreCountedEachOnce) {
  const Sample sample = test::drawn_sample(test::usual_cells(), 3000, 4, test::whole_map());
  const FittedCells fitted = fit_cells(sample, {});
  const SingleImages images = single_images(sample, fitted.cells, fitted.event_error);
  double count = images.without;
  for (const double each : images.counts) count += each;
  EXPECT_EQ(count, 3000);
  EXPECT_LT(images.without, 30) << "four standard deviations at both ends";
}

}  // namespace
}  // namespace rheocyte::single_images_test
