// Cells that were solved in the square channel itself give back their moduli by tables of the tube.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "../table/invented_dynamic.h"
#include "infer/read_modulus_map.h"
#include "infer/square_course.h"
#include "infer/square_law.h"

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
      const double fraction = 1 - std::exp(-(places[k] + 15) / (170 * (cells[i].time_ms + 0.03)));
      const auto set = [&](CourseMeasure measure, double value) {
        course.value(Eigen::Index(k), int(measure)) = value;
      };
      set(CourseMeasure::area_ratio, 1 + fraction * (end.area_ratio - 1));
      set(CourseMeasure::inertia_ratio, 1 + fraction * (end.inertia_ratio - 1));
      set(CourseMeasure::mode_2, fraction * end.mode_2);
      set(CourseMeasure::mode_3, fraction * end.mode_3);
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
    images.push_back(square ? square->in_table(image) : image);
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

/// ln(area / um2), deformation, Lambda1 / Lambda2 and modes 2 to 7 of one cell.
using Features = std::array<double, 9>;
/// Cells with bulk and cortex (20 um, 0.04 ul/s, 6 mPa s at the wall) as a table of `neo-hookean-reference` cortices
/// has them and as `rheocyte solve` gives them in the square with a bending stiffness of 2e3 kBT; none is one to which
/// the law was fitted.
struct InBoth {
  double cortex_fraction, cortex_tension, thinning, error_factor;
  Features table, square;
};
constexpr std::array<InBoth, 9> in_both{{
    // As HL60 cells: 0.158 kPa, 1.9 mN/m, 0.544 mN/m, 242 Pa, 6.3 um; the same in a liquid of exponent 0.655.
    {0.6562,
     0.1879,
     0,
     1,
     {144.42, 0.062342, 0.40157, 0.2376, 0.074733, 0.008226, 0.052644, -0.013525, 0.021153},
     {144.54, 0.06625, 0.39999, 0.23683, 0.078467, 0.0061833, 0.054684, -0.013148, 0.021407}},
    {0.6562,
     0.1879,
     0.345,
     1,
     {144.42, 0.062342, 0.40157, 0.2376, 0.074733, 0.008226, 0.052644, -0.013525, 0.021153},
     {144.03, 0.064041, 0.41552, 0.22611, 0.076068, 0.0048175, 0.052953, -0.013418, 0.021354}},
    // Others under a tension, in liquids of exponents 0.655, 1 and 0.586.
    {0.3390,
     0.1130,
     0.345,
     1,
     {139.52, 0.012048, 0.72886, 0.079484, 0.059009, -0.004361, 0.010999, 0.003305, -0.0001},
     {139.18, 0.012097, 0.73967, 0.076149, 0.06011, -0.0052704, 0.011864, 0.0029571, 0.00010374}},
    {0.2927,
     0.0610,
     0,
     1,
     {113.86, 0.039292, 0.60696, 0.12789, 0.099916, -0.016224, 0.040088, 0.000239, 0.003353},
     {113.64, 0.043201, 0.60774, 0.12788, 0.10438, -0.01925, 0.041297, 0.00098079, 0.0014839}},
    {0.4400,
     0.1800,
     0.414,
     1,
     {163.32, 0.034642, 0.66064, 0.10661, 0.10215, -0.024656, 0.030994, 0.003168, -0.003107},
     {161.24, 0.03622, 0.70973, 0.088303, 0.10794, -0.028728, 0.031802, 0.0039046, -0.004149}},
    // A solid under a tension, a round cell with a cortex, and a small one in a liquid of exponent 0.655.
    {0,
     0,
     0,
     1,
     {142.52, 0.01507, 0.6432, 0.10986, 0.055552, 0.004317, 0.01064, 0.003888, 0.000967},
     {142.4, 0.015939, 0.64465, 0.11059, 0.058754, 0.0035465, 0.01032, 0.0044193, 0.00066701}},
    {0.5952,
     0.0992,
     0,
     1,
     {144.45, 0.018176, 0.99384, 0.001312, 0.08742, -0.02444, 0.004441, 0.009842, -0.007153},
     {144.21, 0.020279, 0.99016, 0.0024205, 0.09094, -0.026676, 0.0038046, 0.011752, -0.0084158}},
    {0.5217,
     0.1043,
     0.345,
     1,
     {99.624, 0.005918, 0.74747, 0.072163, 0.031953, 0.000651, 0.005374, 0.001105, 0.000353},
     {99.583, 0.0060233, 0.75147, 0.071627, 0.032305, 0.00052569, 0.0061921, 0.00082156, 0.00065473}},
    // A linear solid with a cortex (in the tube, not in the table).
    {0.5063,
     0.1266,
     0,
     error_factor_of_other_laws,
     {137.43, 0.014238, 0.79081, 0.059902, 0.072111, -0.013721, 0.011192, 0.0043367, -0.0024708},
     {137.45, 0.015543, 0.79156, 0.059923, 0.075657, -0.015568, 0.011006, 0.0053839, -0.003388}},
}};

TEST(SquareLaw, CellsSolvedInBothSectionsDifferAsItSaysWithinTheErrorThatItStates) {
  double chi_squared = 0;
  for (const InBoth& cell : in_both) {
    const Features& seen = cell.square;
    const ShapeErrors change = change_by_square({.radius = std::sqrt(seen[0] * std::numbers::inv_pi) / 10,
                                                 .mode_2 = seen[3],
                                                 .mode_3 = seen[4],
                                                 .cortex_fraction = cell.cortex_fraction,
                                                 .cortex_tension = cell.cortex_tension,
                                                 .thinning = cell.thinning});
    for (int k = 0; k < int(seen.size()); ++k) {
      const double wanted =
          k == 0 ? std::log(seen[0] / cell.table[0]) : seen[std::size_t(k)] - cell.table[std::size_t(k)];
      const double error = cell.error_factor * std::sqrt(change.covariance(k, k));
      EXPECT_NEAR(change.bias(k), wanted, 3 * error) << cell.cortex_fraction << " " << k;
      chi_squared += std::pow((change.bias(k) - wanted) / error, 2);
    }
  }
  EXPECT_LT(chi_squared / double(in_both.size() * Features().size()), 1.5) << "the stated errors are too small";
}

TEST(SquareLaw, BeyondItsCellsTheNearestCountsAndWithoutAsymmetryNothingChanges) {
  const CellInSquare corner{.radius = 0.82, .mode_2 = 0.42, .mode_3 = 0.12, .cortex_fraction = 1};
  const CellInSquare beyond{.radius = 0.95, .mode_2 = 0.6, .mode_3 = 0.3, .cortex_fraction = 1};
  EXPECT_EQ(change_by_square(corner).bias, change_by_square(beyond).bias);
  EXPECT_EQ(change_by_square({.mode_3 = -0.01}).bias, ShapeVector::Zero());
}

}  // namespace
}  // namespace rheocyte::square_channel_test
