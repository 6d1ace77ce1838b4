// The effective modulus from area, deformation and inertia ratio: of cells of the table, of direct states in the square
// channel, and of cells of other proportions.
#include "infer/proportioned_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "numeric/no_value.h"
#include "store/build_info.h"

namespace rheocyte::proportioned_cells_test {
namespace {

constexpr double pixel_um = 0.34;
const ChannelFlow newtonian{20, 0.04, 6, 1};
/// A power-law liquid at the wall of the square channel (docs/theory-extract.md, sec. "Viscosity").
ChannelFlow methyl_cellulose(double consistency, double exponent, double rate_ul_s) {
  const double shear_rate = 8 * rate_ul_s * 1e-9 / 8e-15 * (0.6671 + 0.2121 / exponent);
  return {20, rate_ul_s, 1e3 * consistency * std::pow(shear_rate, exponent - 1), exponent};
}
ChannelFlow cellcarrier(double rate_ul_s) { return methyl_cellulose(0.2079, 0.6548, rate_ul_s); }

CombinedTable shipped(const std::string& identifier) {
  return read_combined_table(std::filesystem::path(data_folder) / combined_file_name(identifier));
}

const ProportionedCells& cells_by_current_area() {
  static const ProportionedCells cells(shipped("HL-2D-NH-26"));
  return cells;
}
const ProportionedCells& cells_in_cellcarrier() {
  static const ProportionedCells cells(shipped("HL-2D-NH-MC049-26"));
  return cells;
}
const ProportionedCells& cells_by_reference_area() {
  static const ProportionedCells cells(shipped("HL-2D-NHR-26"));
  return cells;
}

SeenFigure figure_of(double area_um2, double deformation, double moment_ratio) {
  return {{std::log(area_um2), deformation, moment_ratio}, Eigen::Vector3d(1e-6, 1e-8, 1e-6).asDiagonal()};
}
SeenFigure figure_of(const CombinedState& state) {
  return figure_of(std::exp(state.value(log_area_row)), state.value(deformation_row), state.value(moment_ratio_row));
}

TEST(ProportionedCells, FindTheCellsOfTheirTable) {
  const CombinedInterpolation& table = cells_by_current_area().table();
  const CellsAtRest rest = cells_at_rest(table.spec());
  CellCoordinates cell = table.box().least;
  for (const double radius_um : {4.6, 6.1, 7.3})
    for (const double axial : {0.1, 0.7, 1.2})
      for (const double progress : {0.16, 0.25}) {
        cell(x_radius) = std::log(radius_um), cell(x_axial) = axial, cell(x_progress) = std::log(progress);
        const CombinedState state = table.at(cell);
        ASSERT_TRUE(state.inside);
        const auto found = cells_by_current_area().estimate(figure_of(state), {newtonian}, 0).by_scatter;
        const double expected = effective_modulus_kPa(rest, cell, state).value;
        EXPECT_NEAR(found.effective_modulus_kPa, expected, 1e-4 * expected) << radius_um << " " << axial;
        EXPECT_NEAR(found.axial_tension_Pa, 1e3 * axial * std::exp(state.value(log_stiffness_row)), 0.1);
      }
}

/// Solved in CellCarrier with a bending stiffness of 1e4 kBT (the table: 3e4 kBT).
struct DirectState {
  double rate, area_um2, deformation, moment_ratio, effective_kPa, tension_Pa;
};
void expect_modulus_of(const DirectState& s, const ProportionedCells& cells, const Sight& sight, double error) {
  const auto by_shape = cells.estimate(figure_of(s.area_um2, s.deformation, s.moment_ratio), sight, 0);
  EXPECT_NEAR(by_shape.by_scatter.effective_modulus_kPa / s.effective_kPa, 1, error) << s.deformation;
  EXPECT_NEAR(by_shape.by_scatter.axial_tension_Pa / s.tension_Pa, 1, 0.03) << s.deformation;
  EXPECT_LT(by_shape.in_common.effective_modulus_error_kPa, 0.05 * s.effective_kPa);
  const auto by_tension =
      cells.estimate(figure_of(s.area_um2, s.deformation, no_value), sight, 0, AxialTension{s.tension_Pa, 0});
  EXPECT_NEAR(by_tension.by_scatter.effective_modulus_kPa / s.effective_kPa, 1, error) << s.deformation;
}

const double tension_at_008 = 192 * std::pow(2, 0.6548);

/// No table has a part in them.
TEST(ProportionedCells, HaveTheModulusOfDirectStatesInTheSquareChannel) {
  for (const DirectState& s : {DirectState{0.04, 152.3517, 0.063421, 0.419852, 0.454507, 192},
                               {0.08, 161.1951, 0.091314, 0.349396, 0.472949, tension_at_008},
                               {0.08, 166.7231, 0.102707, 0.325415, 0.391918, tension_at_008}})
    expect_modulus_of(s, cells_in_cellcarrier(), {cellcarrier(s.rate), Section::square}, 0.025);
  expect_modulus_of({0.04, 152.8660, 0.063407, 0.410906, 0.587508, 192}, cells_by_reference_area(),
                    {cellcarrier(0.04), Section::square}, 0.03);
}

/// A table of a Newtonian liquid is 4, 9 and 11 % off there.
TEST(ProportionedCells, HaveTheModulusOfDirectStatesInTheTubeInAThinningLiquid) {
  for (const DirectState& s : {DirectState{0.04, 152.3687, 0.063308, 0.416969, 0.448919, 192},
                               {0.08, 161.7017, 0.092340, 0.345005, 0.453948, tension_at_008},
                               {0.08, 165.9242, 0.101735, 0.327061, 0.391918, tension_at_008}})
    expect_modulus_of(s, cells_in_cellcarrier(), {cellcarrier(s.rate)}, 0.02);
}

TEST(ProportionedCells, HaveTheModulusOfDirectStatesInStrongerMethylCellulose) {
  const ProportionedCells at_059(shipped("HL-2D-NH-MC059-26")), at_083(shipped("HL-2D-NH-MC083-26"));
  const ChannelFlow in_059 = methyl_cellulose(0.5153, 0.5860, 0.04), in_083 = methyl_cellulose(1.4936, 0.5149, 0.04);
  expect_modulus_of({0.04, 140.6607, 0.039431, 0.468349, 0.762226, 249}, at_059, {in_059}, 0.01);
  expect_modulus_of({0.04, 140.6722, 0.039929, 0.468829, 0.762226, 249}, at_059, {in_059, Section::square}, 0.02);
  expect_modulus_of({0.04, 139.8645, 0.040680, 0.481478, 0.977960, 319.55}, at_083, {in_083}, 0.01);
  expect_modulus_of({0.04, 139.8659, 0.041290, 0.482022, 0.977960, 319.55}, at_083, {in_083, Section::square}, 0.02);
}

/// Of a table with other fractions and tensions of the cortex, by the same law.
TEST(ProportionedCells, TheProportionsHardlyMatter) {
  const CombinedTable other = shipped("HC-2D-NH-26");
  const CombinedInterpolation table(other);
  const CellsAtRest rest = cells_at_rest(table.spec());
  CellCoordinates cell = table.box().least;
  cell(x_radius) = std::log(6.3), cell(x_progress) = std::log(0.15);
  const auto ratio_at = [&](double fraction, double tension_ratio) {
    constexpr int rounds = 60;
    constexpr double tension_kPa = 0.19;
    cell(x_fraction) = fraction, cell(x_ratio) = tension_ratio;
    for (int i = 0; i < rounds; ++i)
      cell(x_axial) = (cell(x_axial) + tension_kPa * std::exp(-table.at(cell).value(log_stiffness_row))) / 2;
    const CombinedState state = table.at(cell);
    EXPECT_TRUE(state.inside);
    return cells_by_current_area().estimate(figure_of(state), {newtonian}, 0).by_scatter.effective_modulus_kPa /
           effective_modulus_kPa(rest, cell, state).value;
  };
  EXPECT_NEAR(ratio_at(0.65, 0.615), 1, 0.02);
  for (const double fraction : {0.45, 0.6, 0.75})
    for (const double tension_ratio : {0.4, 0.85})
      EXPECT_NEAR(ratio_at(fraction, tension_ratio), 1, 0.1) << "the stated error of unseen proportions";
  EXPECT_NEAR(ratio_at(0, 0.5), 0.71, 0.03) << "of solids, as the documents have it";
}

/// Long cells of a small asymmetry: their deformation is that of their length.
TEST(ProportionedCells, LongCellsWithoutAsymmetryAreAmbiguous) {
  const CombinedInterpolation& table = cells_by_current_area().table();
  CellCoordinates cell = table.box().least;
  cell(x_radius) = std::log(5.2), cell(x_axial) = 1.6, cell(x_progress) = std::log(0.16);
  EXPECT_TRUE(cells_by_current_area().estimate(figure_of(table.at(cell)), {newtonian}, 0).is_ambiguous);
  cell(x_axial) = 0.7;
  EXPECT_FALSE(cells_by_current_area().estimate(figure_of(table.at(cell)), {newtonian}, 0).is_ambiguous);
}

/// Of equal area under one tension, softer cells are more deformed. Beyond its end the table is continued, where cells
/// of other stiffness have such a deformation again.
TEST(ProportionedCells, UnderAKnownTensionTheModulusFallsWithTheDeformationToTheEndOfTheTable) {
  const AxialTension tension{370, 0};
  for (const double area_um2 : {110.0, 148.0, 170.0}) {
    double last = HUGE_VAL, last_error = 0;
    bool has_ended = false;
    for (int i = 0; i <= 28; ++i) {
      const double deformation = 0.06 + 0.0025 * i;
      SeenFigure seen = figure_of(area_um2, deformation, no_value);
      const auto found =
          cells_by_current_area().estimate(seen, {cellcarrier(0.12), Section::square}, pixel_um, tension);
      const bool is_inside = found.by_scatter.status != ModuliStatus::outside_table;
      EXPECT_FALSE(found.is_ambiguous) << area_um2 << " " << deformation;
      EXPECT_TRUE(is_inside || deformation > 0.11) << area_um2 << " " << deformation;
      EXPECT_FALSE(is_inside && has_ended) << area_um2 << " " << deformation;
      has_ended = !is_inside;
      if (has_ended) continue;
      const double modulus = found.by_scatter.effective_modulus_kPa;
      const double error = found.in_common.effective_modulus_error_kPa / modulus;
      EXPECT_LT(modulus, 0.98 * last) << area_um2 << " " << deformation;
      if (last_error == 0) last_error = error;
      EXPECT_NEAR(std::log(error / last_error), 0, 0.5) << area_um2 << " " << deformation;
      last = modulus, last_error = error;
    }
    EXPECT_TRUE(has_ended);
  }
}

TEST(ProportionedCells, PixelsOfTheOutlineAreTakenAway) {
  const CombinedInterpolation& table = cells_by_current_area().table();
  CellCoordinates cell = table.box().least;
  cell(x_radius) = std::log(6.3), cell(x_progress) = std::log(0.2), cell(x_axial) = 0.7;
  const auto smooth = cells_by_current_area().estimate(figure_of(table.at(cell)), {newtonian}, 0);
  const auto seen = cells_by_current_area().estimate(figure_of(table.at(cell)), {newtonian}, pixel_um);
  // Pixels deform an outline: without them it is that of a stiffer cell.
  EXPECT_GT(seen.by_scatter.effective_modulus_kPa, 1.02 * smooth.by_scatter.effective_modulus_kPa);
  EXPECT_GT(seen.in_common.effective_modulus_error_kPa, smooth.in_common.effective_modulus_error_kPa);
}

TEST(ProportionedCells, SofterCellsHaveABound) {
  const auto found = cells_by_current_area().estimate(figure_of(150, 0.2, 0.3), {newtonian, Section::square}, pixel_um);
  EXPECT_EQ(found.by_scatter.status, ModuliStatus::outside_table);
  EXPECT_GT(found.softest_kPa, 0);
  EXPECT_LT(found.softest_kPa, 0.5);
}

TEST(ProportionedCells, NeedOneFractionAndOneTension) {
  EXPECT_THROW(ProportionedCells(shipped("HC-2D-NH-26")), UserError);
}

}  // namespace
}  // namespace rheocyte::proportioned_cells_test
