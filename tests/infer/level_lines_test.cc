// Lines of equal modulus lie where the table has that modulus, and scale as the moduli do.
#include "infer/level_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/lookup_table_file.h"
#include "case/user_error.h"
#include "measurement/pixelation.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"

namespace rheocyte {
namespace {

// E = 0.001 area / (deformation + 0.01) kPa, so a line is straight: deformation = 0.001 area / E - 0.01.
class Lines : public testing::Test {
 protected:
  Lines() { test::write_lookup_table(folder_ / "table.txt"); }
  LineFinder finder() const { return LineFinder(read_published_table(folder_ / "table.txt")); }
  test::ScratchFolder folder_;
};

TEST_F(Lines, LieWhereTheTableHasTheirModulus) {
  const auto lines = finder().lines(std::vector<double>{2, 1, 4});
  ASSERT_EQ(lines.lines.size(), 3U);
  EXPECT_EQ(lines.lines[0].modulus_kPa, 1) << "by growing modulus";
  for (const auto& line : lines.lines) {
    ASSERT_GT(line.points.size(), 100U);
    EXPECT_TRUE(std::ranges::is_sorted(line.points, {}, &PlanePoint::x));
    for (const auto& point : line.points)
      // 0.003: the hyperbola between the table's points, which is interpolated linearly over steps of 0.01.
      EXPECT_NEAR(point.y, 0.001 * point.x / line.modulus_kPa - 0.01, 3e-3);
  }
}

TEST_F(Lines, AModulusThatTheTableDoesNotHaveGivesNone) {
  EXPECT_TRUE(finder().lines(std::vector<double>{1e-4, 1e4}).lines.empty());
}

TEST_F(Lines, SpreadLevelsAreAllInTheTable) {
  const auto levels = finder().even_levels(11);
  EXPECT_EQ(levels.size(), 11U);
  EXPECT_TRUE(std::ranges::is_sorted(levels));
  EXPECT_GE(finder().lines(levels).lines.size(), 10U);
}

TEST_F(Lines, SupportIsTheTablesRectangle) {
  for (const auto& point : finder().support()) {
    EXPECT_GE(point.x, 20 - 1e-9);
    EXPECT_LE(point.x, 300 + 1e-9);
    EXPECT_TRUE(std::abs(point.y) < 1e-9 || std::abs(point.y - 0.2) < 1e-9) << point.y;
  }
}

TEST_F(Lines, ScaleAsModuliDo) {
  const auto table = read_published_table(folder_ / "table.txt");
  const LineFinder lines_of(table);
  const auto lines = lines_of.lines(std::vector<double>{2});
  const MeasuringConditions conditions{30, 0.16, 0.339};
  const auto points = as_measured(lines.lines[0].points, lines.channel_width_um, conditions);
  const double expected = 2 * modulus_factor(lines, conditions, 5);
  const ParityModulus modulus(table);
  for (const auto& point : points) {
    double found = 0;
    const double viscosity = 5;
    modulus.moduli(conditions, {{&point.x, 1}, {&point.y, 1}, {&viscosity, 1}}, {&found, 1});
    EXPECT_NEAR(found, expected, 1e-9 * expected) << "an event on the line has the line's modulus";
  }
}

TEST_F(Lines, WithoutPixelsNothingIsAdded) {
  const std::vector<PlanePoint> points{{80, 0.03}};
  EXPECT_EQ(as_measured(points, 20, {20, 0.04, 0})[0].y, 0.03);
  EXPECT_EQ(as_measured(points, 20, {20, 0.04, 0.34})[0].y, 0.03 + deformation_by_pixels_at_area(80, 0.34));
}

TEST_F(Lines, AFileOfLinesIsReadAndATableInItsPlaceIsRefused) {
  const std::string head =
      "# BEGIN METADATA\n# {\"channel_width\": 20.0, \"channel_width_unit\": \"um\", \"flow_rate\": 0.04,\n"
      "# \"flow_rate_unit\": \"uL/s\", \"fluid_viscosity\": 15.0, \"fluid_viscosity_unit\": \"mPa s\",\n"
      "# \"lut identifier\": \"TEST\"}\n# END METADATA\n# area_um [um^2]\tdeform\temodulus [kPa]\n";
  std::ofstream(folder_ / "lines.txt") << head << "50\t0.01\t1.5\n60\t0.02\t1.5\n40\t0.03\t0.9\n50\t0.04\t0.9\n";
  const auto lines = read_level_lines(folder_ / "lines.txt");
  ASSERT_EQ(lines.lines.size(), 2U);
  EXPECT_EQ(lines.identifier, "TEST");
  EXPECT_EQ(lines.lines[0].modulus_kPa, 0.9);
  EXPECT_EQ(lines.lines[1].points[1].x, 60);
  EXPECT_THROW(read_level_lines(folder_ / "table.txt"), UserError) << "its metadata name no table";
}

TEST(PublishedLines, AreMetByThoseOfTheirTable) {
  RHEOCYTE_NEED_REFERENCE("iso_LE-2D-FEM-19-area_um-deform.txt");
  const LineFinder finder(read_published_table(test::reference_folder() / "lut_LE-2D-FEM-19.txt"));
  const auto published = read_level_lines(test::reference_folder() / "iso_LE-2D-FEM-19-area_um-deform.txt");
  ASSERT_EQ(published.lines.size(), 11U);
  std::vector<double> levels;
  for (const auto& line : published.lines) levels.push_back(line.modulus_kPa);
  const auto ours = finder.lines(levels);
  ASSERT_EQ(ours.lines.size(), 11U);
  std::vector<double> differences;
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (const auto& point : published.lines[k].points) {
      const auto& line = ours.lines[k].points;
      const auto after = std::ranges::lower_bound(line, point.x, {}, &PlanePoint::x);
      if (after == line.begin() || after == line.end()) continue;
      const auto& before = *(after - 1);
      const double y = before.y + (after->y - before.y) * (point.x - before.x) / (after->x - before.x);
      differences.push_back(std::abs(y / point.y - 1));
    }
  ASSERT_GT(differences.size(), 500U);
  std::ranges::sort(differences);
  // The published lines agree with their own table to 0.05 % in the modulus (median), which is twice as much here.
  EXPECT_LT(differences[differences.size() / 2], 2e-3);
  EXPECT_LT(differences[differences.size() * 95 / 100], 2e-2);
}

}  // namespace
}  // namespace rheocyte
