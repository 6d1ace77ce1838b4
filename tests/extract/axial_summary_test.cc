// What `rheocyte moduli` says of all cells of a recording together.
#include "extract/axial_summary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::axial_summary_test {
namespace {

AxialSummary of_elongated_cells() {
  AxialSummary s;
  s.is_of_elongated_cells = true;
  s.wall_stress_Pa = 500;
  s.law.cells = 400;
  return s;
}

TEST(AxialSummary, TensionAndStiffnessHaveIntervalsAndTheShareBeyondTheTable) {
  AxialSummary s = of_elongated_cells();
  s.law.is_found = true;
  s.law.axial_tension = {250, 10};
  s.law.stiffness = {std::log(3.5), 0.03 * 0.03, 0.15, 0.04};
  s.beyond.add(TableSide::softer, 40);
  const auto lines = law_lines(s);
  ASSERT_EQ(lines.size(), 2);
  EXPECT_TRUE(lines[0].starts_with("axial tension: 250 Pa (90 % interval 233.6 to 266.4) from 400 cells")) << lines[0];
  EXPECT_EQ(lines[1],
            "E + E2D/r0: 3.5 kPa (90 % interval 3.224 to 3.8), the median of the population of 400 cells, beyond the "
            "table 10 % softer");
}

TEST(AxialSummary, CellsOfWhichMostAreBeyondTheTableHaveNeither) {
  AxialSummary s = of_elongated_cells();
  s.beyond.add(TableSide::softer, 216);
  const auto lines = law_lines(s);
  ASSERT_EQ(lines.size(), 1);
  EXPECT_NE(lines[0].find("54 % of 400 events are softer than the cells of the table"), std::string::npos) << lines[0];
}

TEST(AxialSummary, AGivenTensionIsToldWithTheStiffnessThatFollows) {
  AxialSummary s = of_elongated_cells();
  s.is_given = true;
  s.law.axial_tension = {250, 0};
  EXPECT_EQ(law_lines(s).size(), 1) << "without a law";
  s.law.is_found = true;
  s.law.stiffness = {std::log(3.5), 0, 0.15, 0.01};
  EXPECT_EQ(law_lines(s).size(), 2);
  EXPECT_TRUE(law_lines(AxialSummary()).empty()) << "of round cells";
}

}  // namespace
}  // namespace rheocyte::axial_summary_test
