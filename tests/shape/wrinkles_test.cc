#include "shape/wrinkles.h"

#include <gtest/gtest.h>

#include "shape/measures.h"
#include "shapes.h"

namespace rheocyte::wrinkles_test {
namespace {

using test::interpolate;

constexpr test::Resolution fine{.degree = 8, .pieces = 16};

TEST(Wrinkles, AConvexCellShowsNone) {
  // An egg has no sign change, no bridge, and its hull hides nothing.
  const auto egg = interpolate(test::polar([](double t) { return 1 + 0.1 * std::cos(t) - 0.05 * std::cos(2 * t); }));
  const SurfaceSmoothness smoothness = surface_smoothness(egg);
  EXPECT_EQ(smoothness.curvature_sign_changes, 0);
  EXPECT_EQ(smoothness.flank_bridges, 0);
  EXPECT_EQ(smoothness.hidden_deformation, 0);
}

TEST(Wrinkles, ARearDentIsNotAWrinkle) {
  // The dent turns the curvature once; its own chord counts neither as a bridge nor as hidden deformation.
  const auto dented = interpolate(test::polar([](double t) { return 1 + 0.7 * std::cos(t); }), fine);
  const SurfaceSmoothness smoothness = surface_smoothness(dented);
  EXPECT_EQ(smoothness.curvature_sign_changes, 1);
  EXPECT_EQ(smoothness.flank_bridges, 0);
  EXPECT_NEAR(smoothness.hidden_deformation, 0, 1e-14);  // rounding of two deformations
  EXPECT_GT(measure(dented).deformation_raw - measure(dented).deformation, 1e-3);
}

TEST(Wrinkles, ShortWavesOnAShoulderAreCounted) {
  // Waves of length 0.2 below a Gaussian window: several bridges, two sign changes each, deformation is hidden.
  const auto shoulder = test::polar([](double t) {
    const double from_shoulder = (t - 2.2) / 0.25;
    return 1 + 0.01 * std::exp(-from_shoulder * from_shoulder) * std::cos(30 * (t - 2.2));
  });
  const SurfaceSmoothness smoothness = surface_smoothness(interpolate(shoulder, {.degree = 10, .pieces = 24}));
  EXPECT_GE(smoothness.flank_bridges, 2);
  EXPECT_GE(smoothness.curvature_sign_changes, 2 * smoothness.flank_bridges);
  EXPECT_GT(smoothness.hidden_deformation, 1e-3);
}

TEST(Wrinkles, AnInvalidContourHidesAnUnknownDeformation) {
  // No contour, no numbers: NaN, never a crash.
  EXPECT_TRUE(std::isnan(surface_smoothness({}).hidden_deformation));
}

}  // namespace
}  // namespace rheocyte::wrinkles_test
