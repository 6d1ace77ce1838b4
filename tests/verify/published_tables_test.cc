// The published look-up tables of RT-DC, made with other programs, are met row by row.
//
// Rows were chosen by a rule, not by agreement: of a grid in area and deformation, the row of the table that is nearest
// in the logarithms of both. Each row gives area and modulus; the cell of that area is sought, deformations are
// compared. `ctest -V` shows the differences; docs/verification.md lists and explains them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "cell_of_area.h"
#include "laboratory.h"

namespace rheocyte::published_tables_test {
namespace {

using test::Inertia;
using test::TableRow;

/// LE-2D-FEM-19 (doi 10.6084/m9.figshare.12155064.v4, in dclab), `linear`, Newtonian liquid: area (um2), d, E (kPa).
/// Grid: 45, 70, 110, 160, 230 um2 times 0.006, 0.01, 0.02, 0.035, 0.055. Rows with a modulus of two decimals are left
/// out: the table's header says that its upper edge was extrapolated, and those moduli belong to it.
constexpr TableRow linear_rows[] = {
    {44.910, 0.006002, 3.09316},  {45.032, 0.009932, 2.40579},  {45.343, 0.019842, 1.71842},
    {44.505, 0.034965, 1.29837},  {45.149, 0.054867, 1.06924},  {69.830, 0.005925, 3.97147},
    {70.071, 0.010084, 3.05498},  {68.996, 0.019819, 2.17667},  {69.867, 0.034864, 1.68024},
    {69.317, 0.054111, 1.37474},  {110.337, 0.005965, 5.34621}, {110.849, 0.010143, 4.12422},
    {109.969, 0.020064, 2.94042}, {109.635, 0.035030, 2.25305}, {109.914, 0.055811, 1.83299},
    {165.333, 0.005944, 7.63744}, {158.803, 0.009995, 5.65171}, {161.203, 0.020162, 4.04785},
    {159.371, 0.035043, 3.05498}, {158.345, 0.055247, 2.44398}, {229.106, 0.006016, 11.835},
    {231.086, 0.009867, 9.23367}, {229.636, 0.019986, 6.22299}, {229.362, 0.034598, 4.57559},
    {230.362, 0.054757, 3.55141}};

/// HE-2D-FEM-22 (doi 10.6084/m9.figshare.20630940, in dclab), `neo-hookean`, power-law liquid: the same columns.
/// Grid: 70, 110, 160, 230, 270 um2 times 0.006, 0.01, 0.02, 0.035. Moduli that occur only once are left out: they
/// complement the edge by extrapolation.
constexpr TableRow neo_hookean_rows[] = {
    {70.283, 0.005963, 1.653},  {70.134, 0.010149, 1.281},  {68.490, 0.019640, 0.935},  {69.212, 0.034912, 0.740},
    {109.542, 0.006027, 2.163}, {109.441, 0.010078, 1.685}, {109.185, 0.020035, 1.218}, {108.762, 0.035136, 0.949},
    {159.564, 0.006041, 2.878}, {158.393, 0.010128, 2.212}, {162.770, 0.019876, 1.621}, {160.596, 0.035034, 1.218},
    {228.783, 0.006038, 4.269}, {229.730, 0.009998, 3.284}, {230.559, 0.019837, 2.262}, {229.405, 0.035094, 1.621},
    {267.912, 0.005961, 5.570}, {272.478, 0.010016, 4.269}, {269.267, 0.020135, 2.736}, {268.327, 0.035118, 1.902}};

/// The same for smaller cells, 45 um2.
constexpr TableRow small_rows[] = {
    {45.502, 0.005938, 1.304}, {45.387, 0.009880, 1.023}, {43.791, 0.019985, 0.731}, {44.640, 0.034554, 0.592}};

/// The same for softer cells, d = 0.055 at all areas.
constexpr TableRow soft_rows[] = {{45.221, 0.055077, 0.511},  {69.696, 0.054422, 0.636},  {110.863, 0.053688, 0.812},
                                  {161.182, 0.054862, 0.992}, {228.663, 0.055121, 1.239}, {272.676, 0.055156, 1.423}};

/// Relative differences of the deformation from the table's, in the order of the rows.
template <class MakeCase>
std::vector<double> differences(std::span<const TableRow> rows, const MakeCase& make_case) {
  std::vector<double> all;
  for (const TableRow& row : rows) {
    const test::CellOfArea cell = test::cell_of_area(make_case(row.young_modulus_kPa), row.area_um2);
    all.push_back(cell.state.shape.deformation / row.deformation - 1);
    const bool converged = cell.state.outcome.status == Status::converged;
    std::printf("| %.2f | %.3f | %.5f | %.4f | %.6f | %+.2f %% |%s\n", row.area_um2, row.young_modulus_kPa,
                row.deformation, cell.radius_um, cell.state.shape.deformation, 100 * all.back(),
                converged ? "" : name(cell.state.outcome.status));
    EXPECT_TRUE(converged) << cell.state.outcome.message;
    EXPECT_LT(std::abs(cell.area_error), 1e-5);
  }
  return all;
}

double max_size(const std::vector<double>& values) {
  double greatest = 0;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

double median_size(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Relative differences of the modulus that belongs to the table's area and deformation, which is what a table is for:
/// those of the deformation, divided by d(ln d)/d(ln E) at constant area.
template <class MakeCase>
std::vector<double> modulus_differences(std::span<const TableRow> rows, const std::vector<double>& in_deformation,
                                        const MakeCase& make_case) {
  constexpr double stiffer = 1.02;
  std::vector<double> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TableRow& row = rows[i];
    const test::CellOfArea cell = test::cell_of_area(make_case(stiffer * row.young_modulus_kPa), row.area_um2);
    const double here = std::log(row.deformation * (1 + in_deformation[i]));
    const double power = (std::log(cell.state.shape.deformation) - here) / std::log(stiffer);
    all.push_back(-in_deformation[i] / power);
  }
  return all;
}

TEST(PublishedTables, LinearCellsOfTheTableOf2019AreMet) {
  // Each of 25 rows within 1 % in deformation and modulus, the median of the modulus within 0.5 %.
  const auto make_case = [](double modulus) {
    return test::in_newtonian_liquid({0, modulus, BulkLaw::linear}, Inertia::of_water, 1e-4);
  };
  const std::vector<double> all = differences(linear_rows, make_case);
  EXPECT_LT(max_size(all), 0.01);  // wanted of the program
  // In d these rows have 0.506 %, a hundred rows drawn at random 0.504 %. It is the table's own error: its first-order
  // grid is 1 % low in d while this program meets the analytical limit.
  EXPECT_LT(median_size(all), 0.0055);
  const std::vector<double> moduli = modulus_differences(linear_rows, all, make_case);
  std::printf("modulus: median %.2f %%, greatest %.2f %%\n", 100 * median_size(moduli), 100 * max_size(moduli));
  EXPECT_LT(max_size(moduli), 0.01);      // wanted of the program
  EXPECT_LT(median_size(moduli), 0.005);  // wanted of the program
}

TEST(PublishedTables, NeoHookeanCellsInAShearThinningLiquidOfTheTableOf2022AreMet) {
  // Each of 20 rows within 1.5 %.
  const std::vector<double> all = differences(neo_hookean_rows, [](double modulus) {
    return test::in_power_law_liquid({0, modulus, BulkLaw::neo_hookean}, 3e-4);
  });
  EXPECT_LT(max_size(all), 0.015);  // wanted of the program
}

TEST(PublishedTables, SmallNeoHookeanCellsOfTheTableOf2022AreMetWithAKnownOffset) {
  // Each of 4 rows within 2 %: the table's offset corresponds to a modulus lower by 0.025 um / r0, which is 0.65 %
  // here, and the deformation falls with the modulus to the power 2 to 3.
  const std::vector<double> all = differences(small_rows, [](double modulus) {
    return test::in_power_law_liquid({0, modulus, BulkLaw::neo_hookean}, 3e-4);
  });
  EXPECT_LT(max_size(all), 0.02);
}

TEST(PublishedTablesSlow, SoftNeoHookeanCellsOfTheTableOf2022AreMetWithAKnownOffset) {
  // Each of 6 rows within 2.5 %: the same offset of the modulus, and a power of 3 and more.
  const std::vector<double> all = differences(soft_rows, [](double modulus) {
    return test::in_power_law_liquid({0, modulus, BulkLaw::neo_hookean}, 3e-4);
  });
  EXPECT_LT(max_size(all), 0.025);
}

}  // namespace
}  // namespace rheocyte::published_tables_test
