// The law of what pixels do describes masks of shapes that were not used for it.
#include "measurement/pixel_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/mask_from_outline.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/cell_random.h"
#include "synth/analytic_shapes.h"
#include "synth/outline.h"

namespace rheocyte::pixel_errors_test {
namespace {

/// What is left of ln(area) and deformation after the correction, over many places of one shape.
struct Left {
  double log_area = 0, deformation = 0, log_area_deviation = 0, deformation_deviation = 0;  ///< means; about zero
  PixelErrors stated{};                                                                     ///< mean
};

Left left_of(const CellShape& shape, double area_px, int places) {
  const Eigen::MatrixX2d outline = silhouette(shape.meridian) * std::sqrt(area_px / shape.area_um2);
  const Eigen::RowVector2d low = outline.colwise().minCoeff();
  const ImageSize size{150, 150};
  std::vector<std::uint8_t> mask(size.pixels());
  ContourFinder finder;
  ContourMeasurer measurer;
  CellRandom random(5, static_cast<std::uint64_t>(area_px), Purpose::place);
  Left left;
  for (int i = 0; i < places; ++i) {
    const Eigen::RowVector2d shift(1 + random.uniform(), 1 + random.uniform());
    EXPECT_TRUE(fill_mask((outline.rowwise() + (shift - low)).eval(), size, mask));
    const auto seen = measurer.measure(finder.contour_of({size, mask}), 1);
    const auto errors = pixel_errors(std::log(seen.area_um2), seen.deformation);
    const double log_area = std::log(seen.area_um2 * errors.area_factor / area_px);
    const double deformation = seen.deformation - errors.deformation_excess - shape.deformation;
    left.log_area += log_area / places;
    left.deformation += deformation / places;
    left.log_area_deviation += log_area * log_area / places;
    left.deformation_deviation += deformation * deformation / places;
    left.stated.area_deviation += errors.area_deviation / places;
    left.stated.deformation_deviation += errors.deformation_deviation / places;
  }
  left.log_area_deviation = std::sqrt(left.log_area_deviation);
  left.deformation_deviation = std::sqrt(left.deformation_deviation);
  return left;
}

TEST(PixelErrors, DescribeMasksOfOtherShapes) {
  const AnalyticShapes model({.flow = {20, 0.04}, .max_deformation = 0.1});
  double ratio_of_area = 0, ratio_of_deformation = 0;
  int count = 0;
  for (const double radius : {4.5, 6.0, 7.0})
    for (const double stiffness : {4.0, 6.0, 9.0})
      for (const double area_px : {300., 900., 2500.}) {
        const auto found = model.shape({radius, stiffness, 15});
        if (!std::holds_alternative<CellShape>(found)) continue;
        const auto left = left_of(std::get<CellShape>(found), area_px, 200);
        // What the law leaves of a single shape, 95 % of all: less than 2.5e-3 and 1e-3 from 200 pixels on.
        EXPECT_NEAR(left.log_area, 0, 4e-3) << radius << " " << stiffness << " " << area_px;
        EXPECT_NEAR(left.deformation, 0, 1.3e-3) << radius << " " << stiffness << " " << area_px;
        ratio_of_area += std::log(left.stated.area_deviation / left.log_area_deviation);
        ratio_of_deformation += std::log(left.stated.deformation_deviation / left.deformation_deviation);
        ++count;
      }
  ASSERT_GE(count, 20);
  // Single shapes scatter 0.8 to 1.4 times as much as stated, many together as much.
  EXPECT_NEAR(ratio_of_area / count, 0, 0.15);
  EXPECT_NEAR(ratio_of_deformation / count, 0, 0.15);
}

/// What the law leaves of c_3, in parts of it, on average over shapes.
double left_of_mode_3(double added_ellipse, double area_px) {
  const AnalyticShapes model({.flow = {20, 0.04}, .max_deformation = 0.1});
  constexpr int third = int(ShapeFeature::first_mode) + 1;
  CellRandom random(9, std::uint64_t(area_px), Purpose::place);
  double sum = 0;
  int count = 0;
  for (const double radius : {4.5, 5.2, 6.0, 7.0})
    for (const double stiffness : {2.0, 4.0, 6.0, 9.0}) {
      const auto found = model.shape({radius, stiffness, 15});
      const auto* const shape = std::get_if<CellShape>(&found);
      if (!shape) continue;
      const Eigen::MatrixX2d outline =
          with_ellipse(silhouette(shape->meridian), added_ellipse) * std::sqrt(area_px / shape->area_um2);
      const ShapeVector smooth = shape_vector(outline_shape(outline));
      if (smooth(third) < 0.02) continue;
      sum += without_pixels(smooth + errors_in_pixels(outline, 1, 100, random).bias, 1).mode_3 / smooth(third) - 1;
      ++count;
    }
  EXPECT_GE(count, 5);
  return sum / count;
}

TEST(AsymmetryErrors, LeaveTheThirdModeOfRoundAndOfDrawnOutCellsAsItIs) {
  // The law is fitted to solved cells that a tension draws out. These are of another model: of the round ones it leaves
  // 0.2 %, of those to which an ellipse is added, which no solid has, 1 %; without it they are 3 to 8 % too small.
  // Solved cells that their shape at rest draws out: tests/verify/elongated_cells_test.cc.
  for (const double area_px : {500., 2000.}) {
    EXPECT_NEAR(left_of_mode_3(0, area_px), 0, 0.005) << area_px;
    EXPECT_NEAR(left_of_mode_3(0.15, area_px), 0, 0.015) << area_px;
  }
}

TEST(PixelErrors, AreFiniteAndOfTheRightSignEverywhere) {
  for (double log_area = 0; log_area < 12; log_area += 0.1)
    for (double deformation = -0.1; deformation < 0.5; deformation += 0.005) {
      const auto errors = pixel_errors(log_area, deformation);
      EXPECT_GT(errors.area_factor, 1);
      EXPECT_LT(errors.area_factor, 1.25);
      EXPECT_GT(errors.deformation_excess, -2e-3) << log_area << " " << deformation;
      EXPECT_LT(errors.deformation_excess, 0.05);
      EXPECT_GT(errors.area_deviation, 0);
      EXPECT_GT(errors.deformation_deviation, 0) << log_area << " " << deformation;
      EXPECT_LE(std::abs(errors.correlation), 1);
    }
}

TEST(PixelErrors, SeenThroughPixelsAndCorrectedAShapeIsTheSame) {
  for (const double area : {200., 700., 3000.})
    for (const double deformation : {0.001, 0.02, 0.15}) {
      const auto seen = seen_through_pixels({area, deformation});
      const auto errors = pixel_errors(std::log(seen.area_px), seen.deformation);
      EXPECT_NEAR(seen.area_px * errors.area_factor, area, 1e-6 * area);
      EXPECT_NEAR(seen.deformation - errors.deformation_excess, deformation, 1e-7);
    }
}

}  // namespace
}  // namespace rheocyte::pixel_errors_test
