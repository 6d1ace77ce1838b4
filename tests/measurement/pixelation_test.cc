// The correction of the deformation for finite pixels is that of the field's programs.
#include "measurement/pixelation.h"

#include <cmath>
#include <vector>

#include "measurement/reference_files.h"

namespace rheocyte::pixelation_test {
namespace {

TEST(Pixelation, MeetsThePublishedValues) {
  // Tests of dclab: a cell of 100 um^3 and one of 90 um^2 at 0.34 um; printed digits.
  EXPECT_NEAR(deformation_by_pixels_at_volume(100, 0.34), 0.011464479831134636, 1e-17);
  EXPECT_NEAR(deformation_by_pixels_at_area(10, 0.34), 0.01864204947493241, 1e-17);
}

TEST(Pixelation, MeetsEveryGoldenRow) {
  RHEOCYTE_NEED_REFERENCE("golden/pixelation.csv");
  const auto golden = test::read_csv(test::reference_folder() / "golden/pixelation.csv");
  ASSERT_EQ(golden.rows(), 52U);
  for (std::size_t i = 0; i < golden.rows(); ++i) {
    const double value = golden.number("value", i), px = golden.number("px_um", i);
    const double excess = golden.text("abscissa", i) == "area_um" ? deformation_by_pixels_at_area(value, px)
                                                                  : deformation_by_pixels_at_volume(value, px);
    // A sum of four positive terms: rounding of the last place, times the condition of exp(-30).
    const double expected = std::abs(golden.number("delta_deform", i));
    EXPECT_NEAR(excess, expected, 1e-14 * expected) << "row " << i;
  }
}

TEST(Pixelation, ManyEventsAreCorrectedAsEachAlone) {
  const std::vector<double> areas{10, 25.5, 60, 100, 150, 220, 400, 800, 1250};
  std::vector<double> deformations(areas.size(), 0.05);
  remove_pixelation(areas, 0.2645, deformations);
  for (std::size_t i = 0; i < areas.size(); ++i)
    EXPECT_NEAR(deformations[i], 0.05 - deformation_by_pixels_at_area(areas[i], 0.2645), 1e-16);
}

TEST(Pixelation, APixelSizeOfZeroMeansNoCorrection) {
  std::vector<double> deformation{0.03};
  remove_pixelation(std::vector<double>{80.0}, 0, deformation);
  EXPECT_EQ(deformation[0], 0.03);
}

}  // namespace
}  // namespace rheocyte::pixelation_test
