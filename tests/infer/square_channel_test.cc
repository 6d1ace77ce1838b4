// Cells that were solved in the square channel itself give back their moduli by tables of the tube.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "../table/invented_combined.h"
#include "../table/invented_dynamic.h"
#include "infer/read_modulus_map.h"
#include "infer/square_course.h"
#include "infer/square_shapes.h"

namespace rheocyte::square_channel_test {
namespace {

namespace fs = std::filesystem;

/// Shapes as `rheocyte solve` gives them: a channel of 20 um, 0.04 ul/s, 15 mPa s, without inertia.
struct Solved {
  double radius_um, young_modulus_kPa, area_um2, deformation, mode_2, mode_3;
};

/// Neo-Hookean solids in the square (accuracy 1e-3), none of them a node of the shipped table.
constexpr std::array<Solved, 4> in_square{{{6, 3, 112.924, 0.02329, 0.01144, 0.10507},
                                           {6.5, 8, 132.783, 0.00408, 0.00324, 0.04468},
                                           {7, 3.5, 154.977, 0.02941, 0.03276, 0.11373},
                                           {7.5, 5, 178.089, 0.01950, 0.02935, 0.09214}}};

std::unique_ptr<const ModulusMap> shipped(const std::string& identifier) {
  return read_modulus_map(fs::path(SHIPPED_TABLES) / ("grid_" + identifier + ".cbor"));
}

TEST(SquareSolids, TheShippedTableHasTheCellsThatWereSolved) {
  // Moduli within the 0.5 % that is counted for both tables, by deformation and by asymmetry; c_2 to 3e-4.
  const auto map = shipped("HE-3D-26");
  const SquareSolids solids(*map, {20, 0.04, 15});
  for (const Solved& cell : in_square) {
    const double d = solids.deformation_by_mode_3(cell.area_um2, cell.mode_3);
    EXPECT_NEAR(d, cell.deformation, 0.01 * cell.deformation);
    EXPECT_NEAR(solids.modulus_kPa(cell.area_um2, d), cell.young_modulus_kPa, 0.005 * cell.young_modulus_kPa);
    EXPECT_NEAR(solids.modulus_kPa(cell.area_um2, cell.deformation), cell.young_modulus_kPa,
                0.005 * cell.young_modulus_kPa);
    EXPECT_NEAR(solids.deformation_by_modulus(cell.area_um2, cell.young_modulus_kPa), cell.deformation,
                0.01 * cell.deformation);
    EXPECT_NEAR(solids.shape(cell.area_um2, d)(int(ShapeFeature::first_mode)), cell.mode_2, 3e-4);
  }
}

/// Settled cells of the tube as they were solved, for 5, 6.5 and 8 um and four moduli each.
struct Settled {
  double area_ratio, inertia_ratio, mode_2, mode_3;
};
constexpr std::array<Settled, 12> in_tube{{{0.985987, 0.990738, -0.003665, 0.146696},
                                           {0.996053, 1.000143, 0.000250, 0.088935},
                                           {0.999400, 1.000184, 0.000108, 0.036310},
                                           {0.999753, 1.000083, 0.000048, 0.023423},
                                           {1.009129, 1.057538, 0.030106, 0.131812},
                                           {1.003884, 1.023541, 0.012190, 0.084876},
                                           {1.000677, 1.004053, 0.002091, 0.035526},
                                           {1.000283, 1.001692, 0.000873, 0.022981},
                                           {1.044583, 1.175705, 0.086953, 0.122411},
                                           {1.020639, 1.079514, 0.040306, 0.088400},
                                           {1.003932, 1.014907, 0.007681, 0.040002},
                                           {1.001666, 1.006300, 0.003253, 0.026152}}};

/// A dynamic table whose cells end as these, and approach it exponentially.
DynamicTable tube_table() {
  constexpr int times = 3;
  DynamicContent content{
      parse_dynamic_spec(test::dynamic_spec_text, "tube.toml",
                         std::vector<std::string>{"dynamic.radii=3", "dynamic.moduli=4", "dynamic.times=3",
                                                  "dynamic.checks=0", "dynamic.min_young_modulus_kPa=3.5"}),
      "a test",
      {}};
  const auto cells = cells_of(content.spec);
  const auto places = places_of(content.spec);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Settled& end = in_tube[i / times];
    CellCourse course = test::invented_course(content.spec, cells[i]);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double share = 1 - std::exp(-(places[k] + 15) / (170 * (cells[i].time_ms + 0.03)));
      const auto set = [&](CourseMeasure measure, double value) {
        course.value(Eigen::Index(k), int(measure)) = value;
      };
      set(CourseMeasure::area_ratio, 1 + share * (end.area_ratio - 1));
      set(CourseMeasure::inertia_ratio, 1 + share * (end.inertia_ratio - 1));
      set(CourseMeasure::mode_2, share * end.mode_2);
      set(CourseMeasure::mode_3, share * end.mode_3);
    }
    content.courses.push_back(std::move(course));
  }
  return DynamicTable(dynamic_from_bytes(to_bytes(content), "tube"));
}

CellImages images_of(const Solved& cell, const SquareCourse* square) {
  constexpr double deviation = 5e-4;
  CellImages images;
  for (const double place : {40.0, 140.0, 290.0}) {
    const CourseImage image{place, cell.area_um2, cell.mode_3, deviation, cell.mode_2};
    images.push_back(square ? square->in_tube(image) : image);
  }
  return images;
}

TEST(SquareCourse, CellsSolvedInTheSquareGiveBackTheirModuliByATableOfTheTube) {
  const DynamicTable table = tube_table();
  const auto map = shipped("HE-3D-26");
  const SquareCourse square(table, *map);
  EXPECT_LT(square.unsettled(), 1e-3);
  const TimeCourse course(table);
  for (const Solved& cell : in_square) {
    const CellImages images = images_of(cell, &square);
    const double found = course.cell(images).young_modulus_kPa.value,
                 by_tube = course.cell(images_of(cell, nullptr)).young_modulus_kPa.value;
    const double factor = images.front().section_factor;
    // Solids need less than what is left for cells of other kinds: tables and polynomials between few nodes, 1 %.
    EXPECT_NEAR(std::log(found / cell.young_modulus_kPa), 0, 0.015) << cell.radius_um;
    EXPECT_LT(std::abs(std::log(found / cell.young_modulus_kPa)),
              normal_quantile_of_credible * error_left_by_section(factor));
    EXPECT_LT(by_tube, 0.97 * cell.young_modulus_kPa) << "what there was to correct";
    // E falls somewhat faster than 1 / c_3, by 2 % of a correction of 9 %.
    EXPECT_NEAR(factor, cell.young_modulus_kPa / by_tube, 0.03);
  }
}

TEST(SquareCourse, NothingIsChangedMoreThanTheLargestCellsAndAllIsFinite) {
  const DynamicTable table = tube_table();
  const auto map = shipped("HE-3D-26");
  const SquareCourse square(table, *map);
  for (double area = 80; area < 200; area += 7)
    for (const double mode_3 : {-0.01, 0.0, 0.003, 0.03, 0.1, 0.3}) {
      const auto change = square.change(area, mode_3);
      EXPECT_GT(change.factor, 1.0) << area << " " << mode_3;
      EXPECT_LT(change.factor, 1.15) << area << " " << mode_3;
      EXPECT_NEAR(change.mode_2, 0, 0.02);
    }
}

TEST(SquareShapes, TheChangeOfASolidIsItsShapeInTheSquareLessThatOfTheTubeInAnyChannel) {
  // The change is that at the measured shape: what is left is that of interpolations, 5 % of it.
  const CombinedTable& table = test::whole_combined_table();
  const CombinedInterpolation between(table);
  const ChannelFlow simulated = channel_flow_of(table.spec.base), flow{30, 0.12, 8};
  const auto map = shipped("HE-3D-26");
  const SquareShapes square(between, simulated, *map);
  const SquareSolids solids(*map, simulated);
  const ScaleFactors scale = scale_factors(simulated, flow);
  for (const double stiffness : {4.0, 6.0}) {
    const BranchPlace place{6.5, 0, 0};
    const ShapeVector tube = test::invented_features(place, stiffness);
    const double area = std::exp(tube(0));
    ShapeVector seen = solids.shape(area, solids.deformation_by_modulus(area, stiffness));
    const ShapeVector by_square = seen - tube;
    seen(0) += std::log(scale.area);
    const auto change = square.change(seen, flow, 0);
    for (int k = 1; k <= int(ShapeFeature::first_mode) + 4; ++k)
      EXPECT_NEAR(change.errors.bias(k), by_square(k), 0.05 * std::abs(by_square(k)) + 5e-4) << stiffness << " " << k;
    EXPECT_NEAR(change.errors.covariance(1, 1), std::pow(left_by_section * change.errors.bias(1), 2), 1e-12);
    EXPECT_LT(std::abs(square.change(seen, flow, 1).errors.bias(1)), std::abs(change.errors.bias(1)));
  }
}

}  // namespace
}  // namespace rheocyte::square_channel_test
