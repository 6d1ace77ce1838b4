// Moduli of cells that are drawn out along the flow, solved, drawn into pixels and read back by the shipped table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "case/read_case.h"
#include "case/scales.h"
#include "infer/elongated_solids.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/quantile.h"
#include "solve/session.h"
#include "sweep/measured_state.h"

namespace rheocyte::elongated_cells_test {
namespace {

constexpr double pixel_um = 0.34, viscosity_mPas = 6;
constexpr int places = 80, mode_2 = int(ShapeFeature::first_mode);

ElongatedSolids shipped_table() {
  std::ifstream file(SHIPPED_TABLES "/elongated_HE-3D-el-26.cbor", std::ios::binary);
  return ElongatedSolids(elongated_from_bytes(std::string(std::istreambuf_iterator<char>(file), {}), "HE-3D-el-26"));
}

/// A solid in the square channel.
struct Solved {
  StationaryState state;
  Problem problem;
  Scales scales;
  double mode(int k) const { return state.shape.modes[std::size_t(k - first_radius_mode)]; }
};
Solved solved(double modulus_kPa, const std::string& elongated_by) {
  const Case c =
      parse_case(fmt::format("channel.section = \"square\"\nchannel.width_um = 20\nflow.rate_ul_per_s = 0.04\n"
                             "flow.viscosity_mPas = {}\ncell.radius_um = 6.25\nnumerics.accuracy = 1e-3\n"
                             "cell.bulk.young_modulus_kPa = {}\n{}",
                             viscosity_mPas, modulus_kPa, elongated_by),
                 "case");
  Solved found{Session().solve(problem_of(c)), problem_of(c), scales_of(c)};
  EXPECT_EQ(found.state.outcome.status, Status::converged);
  return found;
}

/// Of its silhouette (um).
Eigen::MatrixX2d outline_of(double modulus_kPa, const std::string& elongated_by) {
  const Solved cell = solved(modulus_kPa, elongated_by);
  return mirrored(measure_state(cell.state, cell.scales).contour);
}

/// Median over random places on the camera.
double modulus_of(const ElongatedSolids& solids, const Eigen::MatrixX2d& outline, ElongatedBy by) {
  CellRandom random(5, 0, Purpose::place);
  std::vector<double> area, deformation, first, second, fourth, fifth, viscosity(places, viscosity_mPas), told;
  for (int i = 0; i < places; ++i) {
    const ShapeVector seen = features_in_pixels(outline, pixel_um, {random.uniform() - 0.5, random.uniform() - 0.5});
    area.push_back(std::exp(seen(0)));
    deformation.push_back(seen(1));
    first.push_back(by == ElongatedBy::modes ? seen(mode_2) : 1 / std::sqrt(seen(2)));
    second.push_back(by == ElongatedBy::modes ? seen(mode_2 + 1) : seen(1));
    fourth.push_back(seen(mode_2 + 2));
    fifth.push_back(seen(mode_2 + 3));
  }
  std::vector<double> modulus(places), other(places);
  std::vector<ModulusState> states(places);
  std::vector<ElongatedCell> cells(places);
  solids.estimate({{20, 0.04}, pixel_um}, {area, deformation, viscosity}, {by, first, second, fourth, fifth},
                  {{modulus, other, states}, other, other, other, other, cells});
  for (const double value : modulus)
    if (std::isfinite(value)) told.push_back(value);
  EXPECT_GT(told.size(), std::size_t(places) * 9 / 10);
  return quantile(told, 0.5);
}

TEST(ElongatedCells, HaveTheirModulusWhetherATensionOrTheirRestShapeDrawsThemOut) {
  // The cells of docs/real-cells.md: by the correction for an added ellipse they had 30 to 59 % too much. None is a
  // state of the table, and those with another shape at rest are not even cells of its model.
  const ElongatedSolids solids = shipped_table();
  struct Drawn {
    double modulus_kPa;
    const char* by;
  };
  for (const auto& [modulus, by] :
       {Drawn{1.5, ""}, Drawn{1.5, "flow.axial_tension_Pa = 250"}, Drawn{1.5, "cell.rest_aspect = 1.25"},
        Drawn{1.5, "flow.axial_tension_Pa = 450"}, Drawn{1.5, "cell.rest_aspect = 1.5"},
        Drawn{2.5, "flow.axial_tension_Pa = 800"}, Drawn{2.5, "cell.rest_aspect = 1.5"}}) {
    const Eigen::MatrixX2d outline = outline_of(modulus, by);
    EXPECT_NEAR(modulus_of(solids, outline, ElongatedBy::modes) / modulus, 1, 0.03) << modulus << " " << by;
    EXPECT_NEAR(modulus_of(solids, outline, ElongatedBy::inertia) / modulus, 1, 0.05) << modulus << " " << by;
  }
}

TEST(ElongatedCells, OfOneElongationHaveOneAsymmetryWhetherATensionOrTheirRestShapeDrawsThemOut) {
  // Equal c_2, equal c_3 within 2 %: what the flow does to a long cell does not depend on what made it long.
  struct Pair {
    double modulus_kPa, below_Pa, above_Pa;  // tensions on both sides of that whose c_2 is the rest shape's
  };
  for (const auto& [modulus, below, above] : {Pair{1.5, 450, 510}, Pair{2.5, 780, 830}}) {
    const Solved rested = solved(modulus, "cell.rest_aspect = 1.5"),
                 less = solved(modulus, fmt::format("flow.axial_tension_Pa = {}", below)),
                 more = solved(modulus, fmt::format("flow.axial_tension_Pa = {}", above));
    const double fraction = (rested.mode(2) - less.mode(2)) / (more.mode(2) - less.mode(2));
    EXPECT_GT(fraction, 0);
    EXPECT_LT(fraction, 1);
    EXPECT_NEAR(std::lerp(less.mode(3), more.mode(3), fraction) / rested.mode(3), 1, 0.02) << modulus;
  }
}

TEST(ElongatedCells, WithACortexHaveTheShapeOfHL60CellsUnderOneTension) {
  // Medians of 1396 cells of Urbanska et al. (Nat Methods 2020; docs/real-cells.md), less what pixels add: area and six
  // modes are met by bulk, cortex and one axial tension in the square channel and CellCarrier, which no cell without a
  // tension comes near to (chi squared of at least 1280). The deformation is not fitted.
  constexpr double area_um2 = 145, deformation = 0.070, fraction_of_area = 0.004, of_mode_2 = 0.004, of_mode = 0.0028;
  constexpr std::array<double, 6> measured{0.2437, 0.0712, 0.0103, 0.0529, -0.0112, 0.0173};
  const Case c = parse_case(
      "channel.section = \"square\"\nchannel.width_um = 20\nflow.rate_ul_per_s = 0.04\nflow.law = \"power-law\"\n"
      "flow.consistency_Pa_sn = 0.20865\nflow.exponent = 0.6545\nflow.axial_tension_Pa = 200.8\ncell.radius_um = "
      "6.304\n"
      "cell.bulk.law = \"neo-hookean\"\ncell.bulk.young_modulus_kPa = 0.0959\n"
      "cell.cortex.law = \"neo-hookean-reference\"\ncell.cortex.modulus_mN_per_m = 1.139\n"
      "cell.cortex.tension_mN_per_m = 0.701\ncell.cortex.bending_kBT = 3e4\nnumerics.accuracy = 2e-3\n",
      "HL60");
  const StationaryState cell = Session().solve(problem_of(c));
  ASSERT_EQ(cell.outcome.status, Status::converged);
  const MeasuredState seen = measure_state(cell, scales_of(c));
  double chi_squared = std::pow(std::log(seen.value(int(Measure::area_um2)) / area_um2) / fraction_of_area, 2);
  for (std::size_t i = 0; i < measured.size(); ++i)
    chi_squared +=
        std::pow((cell.shape.modes[i + 2 - first_radius_mode] - measured[i]) / (i == 0 ? of_mode_2 : of_mode), 2);
  EXPECT_LT(chi_squared, 5);
  EXPECT_NEAR(cell.shape.deformation, deformation, 0.01);
}

}  // namespace
}  // namespace rheocyte::elongated_cells_test
