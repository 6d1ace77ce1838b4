// The effective modulus from the fitted numbers of a cell, against that of the case with this cell.
#include "infer/cells_at_rest.h"

#include <gtest/gtest.h>

#include "../table/invented_elongated_combined.h"
#include "case/problem.h"
#include "case/scales.h"

namespace rheocyte::cells_at_rest_test {
namespace {

TableSpec spec_with(const std::vector<std::string>& settings) {
  std::string text = test::combined_spec;
  const std::string bending = "bending_kBT = 1e4\n";
  text.erase(text.find(bending), bending.size());
  return parse_table_spec(text, "spec.toml", settings);
}

double of_case_kPa(const Case& c) {
  const Problem problem = problem_of(c);
  return 1e-3 * scales_of(c).stress_Pa * effective_modulus(problem, problem.radius_ratio);
}

double of_numbers_kPa(const CellsAtRest& cells, const SweepPoint& place, double S) {
  return S * effective_modulus_over_stiffness<double>(
                 cells, {std::log(place.radius_um), std::log(S), place.cortex_fraction, place.tension_ratio});
}

const std::vector<std::vector<std::string>> kinds{{},
                                                  {"cell.cortex.bending_kBT=1e6"},
                                                  {"table.bending_ratio=1e-3"},
                                                  {"cell.cortex.law=skalak", "cell.cortex.area_constant=5"}};

TEST(CellsAtRest, HaveTheEffectiveModulusOfTheirCase) {
  for (const auto& settings : kinds) {
    const TableSpec spec = spec_with(settings);
    for (const double fraction : {0.0, 0.3, 1.0})
      for (const double radius_um : {5.0, 7.0})
        for (const double S : {0.3, 4.0}) {
          const SweepPoint place{radius_um, fraction, 0.2};
          const double expected = of_case_kPa(case_at(spec, place, S));
          EXPECT_NEAR(of_numbers_kPa(cells_at_rest(spec), place, S) / expected, 1, 1e-12);
        }
  }
}

/// A bending stiffness of kBT grows with the modulus and with the cube of the radius.
TEST(CellsAtRest, ScaleWithTheChannel) {
  const CellsAtRest cells = cells_at_rest(spec_with({"cell.cortex.bending_kBT=1e6"}));
  const ScaleFactors twice{.length = 2, .area = 4, .volume = 8, .modulus = 3, .cortex_modulus = 6};
  EXPECT_NEAR(of_numbers_kPa(cells.scaled(twice), {12, 0.3, 0.2}, 1.5), 3 * of_numbers_kPa(cells, {6, 0.3, 0.2}, 0.5),
              1e-12);
}

TEST(CellsAtRest, SlopesAreDifferences) {
  const CellsAtRest cells = cells_at_rest(test::whole_elongated_table().spec);
  const CombinedInterpolation between(test::whole_elongated_table());
  CellCoordinates cell = (between.box().least + between.box().greatest) / 2;
  const auto at = [&](const CellCoordinates& x) { return effective_modulus_kPa(cells, x, between.at(x)); };
  const CellFunction found = at(cell);
  for (int x = 0; x < coordinate_count; ++x) {
    const CellCoordinates step = 1e-5 * CellCoordinates::Unit(x);
    EXPECT_NEAR(found.gradient(x), (at(cell + step).value - at(cell - step).value) / 2e-5, 1e-5 * found.value) << x;
  }
}

}  // namespace
}  // namespace rheocyte::cells_at_rest_test
