// Moduli of cells that are drawn out along the flow, solved, drawn into pixels and read back by the shipped table.
#include <fmt/format.h>
#include <gtest/gtest.h>

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
  Solved found{Session().solve(problem_of(c)), scales_of(c)};
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
    const double share = (rested.mode(2) - less.mode(2)) / (more.mode(2) - less.mode(2));
    EXPECT_GT(share, 0);
    EXPECT_LT(share, 1);
    EXPECT_NEAR(std::lerp(less.mode(3), more.mode(3), share) / rested.mode(3), 1, 0.02) << modulus;
  }
}

}  // namespace
}  // namespace rheocyte::elongated_cells_test
