// Between the branches of a combined table lie the shapes of the cells from which the branches were sampled.
#include "synth/combined_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "case/user_error.h"
#include "table/invented_combined.h"

namespace rheocyte::combined_shapes_test {
namespace {

constexpr SimulatedCells same{{20, 0.04, 15}, {20, 0.04}};

CombinedShapes invented_shapes(const SimulatedCells& cells) {
  const TableSpec spec = parse_table_spec(test::combined_spec, "spec.toml");
  std::vector<SampledBranch> branches;
  for (const auto& place : sweep_places(spec)) branches.push_back(test::invented_combined_samples(place));
  return {spec, std::move(branches), cells};
}

VirtualCell cell_of(const SweepPoint& place, double S) {
  const double cortex = place.cortex_fraction * S * place.radius_um;
  return {place.radius_um, (1 - place.cortex_fraction) * S, 15, cortex, place.tension_ratio * cortex};
}

class Combined : public testing::Test {
 protected:
  NoShape reason(const VirtualCell& cell) const { return std::get<NoShape>(shapes_.shape(cell)); }
  CombinedShapes shapes_ = invented_shapes(same);
};

TEST_F(Combined, ShapesLieBetweenTheBranches) {
  // The table's interpolation leaves up to 3e-3 of the deformation, see table_test; outlines are as near as areas.
  for (const SweepPoint& place :
       {SweepPoint{6.3, 0.4, 0.15}, {7.1, 0.06, 0.2}, {5.2, 0.93, 0.02}, {7, 0, 0}, {6.6, 1, 0.3}})
    for (const double S : {1.5, 2.5}) {
      const auto found = shapes_.shape(cell_of(place, S));
      ASSERT_TRUE(std::holds_alternative<CellShape>(found)) << place.radius_um << " " << place.cortex_fraction;
      const auto& shape = std::get<CellShape>(found);
      const Eigen::MatrixX2d outline = test::invented_outline(place, S);
      const OutlineShape exact = outline_shape(outline), drawn = outline_shape(mirrored(shape.meridian));
      EXPECT_NEAR(shape.deformation, exact.deformation, 3e-3 * exact.deformation);
      EXPECT_NEAR(shape.area_um2, exact.area, 3e-4 * exact.area);
      EXPECT_NEAR(drawn.deformation, shape.deformation, 1e-3 * shape.deformation);
      EXPECT_NEAR(drawn.area, shape.area_um2, 1e-3 * shape.area_um2);
      EXPECT_NEAR(shape.volume_um3, 4 * std::numbers::pi / 3 * std::pow(place.radius_um, 3), 1e-6 * shape.volume_um3);
      EXPECT_LT((shape.meridian - outline.topRows(shape.meridian.rows())).cwiseAbs().maxCoeff(),
                3e-4 * place.radius_um);
    }
}

TEST_F(Combined, ScaleToOtherChannelsFlowsAndLiquids) {
  // Moduli of the bulk with the cube of the width, those of the surface with its square; to rounding.
  SimulatedCells wide = same;
  wide.flow.width_um = 30;
  wide.flow.rate_ul_s = 0.16;
  const VirtualCell cell = cell_of({6.3, 0.4, 0.15}, 2);
  const double load = 0.16 / 0.04 * 5 / 15, width = 1.5;
  const VirtualCell scaled{cell.radius_um * width, cell.stiffness * load / (width * width * width), 5,
                           cell.cortex_modulus_mN_per_m * load / (width * width),
                           cell.tension_mN_per_m * load / (width * width)};
  const auto in_20 = std::get<CellShape>(shapes_.shape(cell));
  const auto in_30 = std::get<CellShape>(invented_shapes(wide).shape(scaled));
  EXPECT_NEAR(in_30.deformation, in_20.deformation, 1e-12);
  EXPECT_NEAR(in_30.area_um2, 2.25 * in_20.area_um2, 1e-9);
  EXPECT_NEAR(in_30.volume_um3, 3.375 * in_20.volume_um3, 1e-9);
  EXPECT_LT((in_30.meridian - 1.5 * in_20.meridian).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Combined, SayWhyThereIsNoShape) {
  EXPECT_EQ(reason(cell_of({3, 0.5, 0.1}, 2)), NoShape::too_small);
  EXPECT_EQ(reason(cell_of({NAN, 0.5, 0.1}, 2)), NoShape::too_small);
  EXPECT_EQ(reason(cell_of({9.9, 0.5, 0.1}, 2)), NoShape::too_large);
  EXPECT_EQ(reason(cell_of({6.3, 0.5, 0.1}, 100)), NoShape::too_stiff);
  EXPECT_EQ(reason(cell_of({6.3, 0.5, 0.1}, 0.01)), NoShape::too_soft);
  EXPECT_EQ(reason({6.3, -1, 15, 0.1, 0}), NoShape::too_soft);
  EXPECT_EQ(reason(cell_of({6.3, 0.5, 0.4}, 2)), NoShape::outside_sheets) << "a tension beyond the table's";
  EXPECT_EQ(reason({6.3, -0.1, 15, 12, 0}), NoShape::outside_sheets) << "a bulk below none";
  EXPECT_EQ(reason({6.3, 2, 15, NAN, 0}), NoShape::too_soft);
}

TEST_F(Combined, NeedTwoRadii) {
  const TableSpec spec = parse_table_spec(test::combined_spec, "spec.toml");
  EXPECT_THROW(CombinedShapes(spec, {test::invented_combined_samples({6, 0.5, 0})}, same), UserError);
}

}  // namespace
}  // namespace rheocyte::combined_shapes_test
