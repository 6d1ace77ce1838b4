// Cells that rest in another shape than the sphere, or are drawn out by an axial tension of their surroundings
// (docs/theory.md, eq:rest-shape, eq:axial-tension).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case/read_case.h"
#include "case/scales.h"
#include "solve/session.h"
#include "solve/transient.h"

namespace rheocyte::elongation_test {
namespace {

/// In a channel of 20 um, where nothing flows but for this rate (ul/s).
constexpr double nearly_at_rest = 1e-7;

Problem problem(const std::string& cell, const std::string& more, double rate = nearly_at_rest,
                const std::string& section = "tube") {
  return problem_of(
      parse_case(fmt::format("channel.section = \"{}\"\nchannel.width_um = 20\nflow.rate_ul_per_s = {}\n"
                             "flow.viscosity_mPas = 6\nflow.density_kg_per_m3 = 0\n"
                             "cell.radius_um = 6.25\n{}\n{}\n{}",
                             section, rate, cell, more,
                             more.find("accuracy") == std::string::npos ? "numerics.accuracy = 1e-3\n" : ""),
                 "case"));
}

const std::string solid = "cell.bulk.young_modulus_kPa = 2", soft_solid = "cell.bulk.young_modulus_kPa = 1.1",
                  shell =
                      "cell.bulk.law = \"none\"\ncell.cortex.law = \"neo-hookean-reference\"\n"
                      "cell.cortex.modulus_mN_per_m = 5";

std::string held_by(const std::string& tension_ratio) { return "\ncell.cortex.tension_ratio = " + tension_ratio; }

StationaryState solved(const Problem& problem) {
  StationaryState state = Session().solve(problem);
  EXPECT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  return state;
}

double mode(const StationaryState& state, int k) { return state.shape.modes[std::size_t(k - first_radius_mode)]; }

TEST(Elongation, WithoutFlowACellHasItsRestAspect) {
  // A spheroid's root of the ratio of moments is its aspect; it has the sphere's volume, so its section is
  // pi r0^2 alpha^(1/3). No odd modes. Solids and a shell, whose membrane needs a tension (1e-4 of its modulus) to be
  // stable, which pulls it towards the sphere by about as much.
  for (const std::string& cell : {solid, solid + "\ncell.bulk.law = \"linear\"", shell + held_by("1e-4")}) {
    const double tolerance = cell.find("none") == std::string::npos ? 1e-4 : 1e-3;
    for (const double aspect : {0.8, 1.25, 2.0}) {
      const Problem at_rest = problem(cell, fmt::format("cell.rest_aspect = {}", aspect));
      const StationaryState state = solved(at_rest);
      EXPECT_NEAR(state.shape.inertia_ratio, aspect, tolerance * aspect) << cell;
      EXPECT_NEAR(state.shape.area, std::numbers::pi * std::pow(at_rest.radius_ratio, 2) * std::cbrt(aspect),
                  tolerance);
      EXPECT_LT(std::abs(mode(state, 3)), 2e-5) << cell;
      EXPECT_NEAR(state.biot_ratio, 1, 1e-3) << cell;  // no stretch from the shape without stress
    }
  }
}

TEST(Elongation, WithoutFlowATensionStretchesASolidAsAnEvenStressDoes) {
  // mu (lambda^2 - 1 / lambda) = T, aspect lambda^1.5, in the tube and in the square.
  struct Stretched {
    double tension_Pa, aspect;
  };
  for (const Stretched& expected : {Stretched{500, 1.39087}, {1000, 1.79263}}) {
    for (const char* section : {"tube", "square"}) {
      const StationaryState state = solved(
          problem(solid, fmt::format("flow.axial_tension_Pa = {}", expected.tension_Pa), nearly_at_rest, section));
      EXPECT_NEAR(state.shape.inertia_ratio, expected.aspect, 2e-4 * expected.aspect) << section;
    }
  }
}

TEST(Elongation, ASmallTensionStretchesAShellAsTheMembraneTheorySays) {
  // To first order the radial displacement is 5/3 T r0 / E2D P_2 (balance of forces along and normal to the meridian,
  // Poisson's ratio 1/2), so c_2 = 5/4 T r0 / E2D. The second order, and the surface tension that keeps the membrane
  // from wrinkling, are 1e-3 of it.
  for (const char* section : {"tube", "square"}) {
    const double small = 2e-4, tension_Pa = small * 5e-3 / 6.25e-6;
    const StationaryState state = solved(problem(
        shell + held_by("1e-3"), fmt::format("flow.axial_tension_Pa = {}", tension_Pa), nearly_at_rest, section));
    EXPECT_NEAR(mode(state, 2) / small, 1.25, 0.0125) << section;
    EXPECT_LT(std::abs(mode(state, 3)), 1e-5) << section;
  }
}

TEST(Elongation, TheTensionActsInASolidAsOnItsSurface) {
  // The divergence theorem holds for polynomials as well: both ways give one state.
  Problem inside = problem(soft_solid, "flow.axial_tension_Pa = 300", 0.04), outside = inside;
  std::swap(outside.bulk.axial_tension, outside.cortex.axial_tension);
  const StationaryState a = solved(inside), b = solved(outside);
  for (int k = 2; k <= 7; ++k) EXPECT_NEAR(mode(a, k), mode(b, k), 1e-5) << k;
  EXPECT_NEAR(a.cell_velocity, b.cell_velocity, 1e-6);
}

TEST(Elongation, ShapesInTheFlowAreThoseOfAnIndependentProgram) {
  // r0 = 6.25 um, tube of 20 um, 0.04 ul/s, 6 mPa s, 1.1 kPa.
  const StationaryState rested = solved(problem(soft_solid, "cell.rest_aspect = 1.5", 0.04));
  EXPECT_NEAR(mode(rested, 2), 0.2228, 1e-3);
  EXPECT_NEAR(mode(rested, 3), 0.0749, 1e-3);
  EXPECT_NEAR(rested.shape.deformation, 0.0480, 1e-3);
  const StationaryState pulled = solved(problem(soft_solid, "flow.axial_tension_Pa = 300", 0.04));
  EXPECT_NEAR(mode(pulled, 2), 0.1900, 1e-3);
  EXPECT_NEAR(mode(pulled, 3), 0.0795, 1e-3);
  EXPECT_NEAR(pulled.shape.deformation, 0.0398, 1e-3);
}

TEST(Elongation, ACellWithBulkAndCortexHasTheModesOfHL60Cells) {
  // The fit of docs/real-cells.md: six modes, 2e-3.
  const std::string cell =
      "cell.bulk.young_modulus_kPa = 0.158\ncell.cortex.law = \"neo-hookean-reference\"\n"
      "cell.cortex.modulus_mN_per_m = 1.9\ncell.cortex.tension_mN_per_m = 0.544\ncell.cortex.bending_kBT = 3e4";
  const StationaryState state = solved(problem(cell, "flow.axial_tension_Pa = 242", 0.04));
  const double expected[] = {0.236, 0.073, 0.010, 0.051, -0.012, 0.021};
  for (int k = 2; k <= 7; ++k) EXPECT_NEAR(mode(state, k), expected[k - 2], 2e-3) << k;
}

TEST(Elongation, ASmallTensionAddsItsOwnStretchToThatOfTheFlow) {
  // c_2 grows by 0.75 T / E, c_3 at the second order only.
  const StationaryState without = solved(problem(solid, "numerics.accuracy = 1e-5", 0.004)),
                        with = solved(problem(solid, "flow.axial_tension_Pa = 20\nnumerics.accuracy = 1e-5", 0.004));
  EXPECT_NEAR((mode(with, 2) - mode(without, 2)) / 0.01, 0.75, 0.0075);
  EXPECT_NEAR(mode(with, 3) / mode(without, 3), 1, 0.02);
}

}  // namespace
}  // namespace rheocyte::elongation_test
