// The shipped tables of the square channel against cells that are solved directly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "case/read_case.h"
#include "case/scales.h"
#include "case/unit.h"
#include "solve/stationary.h"
#include "table/stiffness_grid.h"

namespace rheocyte::square_table_test {
namespace {

struct Cell {
  double radius_um, young_modulus_kPa;
  double bending_ratio = 0;  ///< over E r0^3
};

/// The shipped grid of an identifier; nothing if it does not come with the program.
std::optional<StiffnessGrid> shipped(const std::string& identifier) {
  const std::filesystem::path path = std::filesystem::path(SHIPPED_TABLES) / grid_file_name(identifier);
  if (!std::filesystem::exists(path)) return {};
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return StiffnessGrid(grid_from_bytes(bytes, path.string()));
}

/// Solves the cell in the square channel, reads its modulus from the table by area and deformation, and compares.
void expect_modulus(const StiffnessGrid& table, const Cell& cell) {
  Case c = parse_case(fmt::format("[channel]\nsection = \"square\"\nwidth_um = 20.0\n[flow]\nrate_ul_per_s = 0.04\n"
                                  "density_kg_per_m3 = 1000.0\nviscosity_mPas = 15.0\n[cell]\nradius_um = "
                                  "{}\n[cell.bulk]\nlaw = \"neo-hookean\"\n"
                                  "young_modulus_kPa = {}\n[numerics]\naccuracy = 1e-3\n",
                                  cell.radius_um, cell.young_modulus_kPa),
                      "test");
  const double radius = 1e-6 * cell.radius_um;
  c.cell.cortex.bending_kBT =
      cell.bending_ratio * 1e3 * cell.young_modulus_kPa * radius * radius * radius / thermal_energy_J;
  const StationaryState state = solve_stationary(problem_of(c));
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  const double um = 1e6 * scales_of(c).length_m;
  const GridAnswer answer = table.answer(um * um * state.shape.area, state.shape.deformation);
  ASSERT_EQ(answer.reason, OutOfTable::none) << cell.radius_um;
  EXPECT_EQ(answer.regularised, cell.bending_ratio > 0);
  // The stated error, and that of the state itself, which the modulus sees by half.
  EXPECT_NEAR(std::exp(answer.log_stiffness) / cell.young_modulus_kPa, 1, answer.error + state.estimated_error / 2)
      << cell.radius_um << " um, deformation " << state.shape.deformation;
}

TEST(SquareTable, TheShippedOnesCoverAllAreasOfTheirSpec) {
  // Small cells have smaller areas the softer they are: columns at the left border lie between branches that end.
  for (const char* solid : {"HE", "LE"})
    for (const char* liquid : {"26", "MC049-26", "MC059-26", "MC083-26"}) {
      const auto table = shipped(fmt::format("{}-3D-{}", solid, liquid));
      ASSERT_TRUE(table) << solid << liquid;
      const GridContent& grid = table->content();
      EXPECT_NEAR(std::exp(grid.min_log_area), 30, 1e-9) << solid << liquid;
      EXPECT_NEAR(std::exp(grid.min_log_area + grid.column_step * (grid.columns - 1)), 290, 1e-6) << solid << liquid;
    }
}

TEST(SquareTableSlow, CellsBetweenTheComputedOnesHaveTheirModuli) {
  const auto table = shipped("HE-3D-26");
  ASSERT_TRUE(table);
  for (const Cell& cell : {Cell{3.6, 1.9}, {4.6, 1.6}, {5.6, 6.0}, {6.5, 3.2}, {7.5, 9.0}})
    expect_modulus(*table, cell);
}

TEST(SquareTableSlow, BeyondTheEndOfTheBareSurfaceModuliAreThoseOfCellsThatBendingHolds) {
  const auto table = shipped("HE-3D-26");
  ASSERT_TRUE(table);
  for (const Cell& cell : {Cell{4.5, 1.38, 3e-5}, {6.7, 2.2, 3e-5}}) expect_modulus(*table, cell);
}

}  // namespace
}  // namespace rheocyte::square_table_test
