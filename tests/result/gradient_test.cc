// Gradients against identities that hold exactly, against solutions of neighbouring cases, and refusals.
#include "result/gradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "case/case_keys.h"
#include "case/case_line.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/user_error.h"

namespace rheocyte::gradient_test {
namespace {

constexpr std::string_view E = "cell.bulk.young_modulus_kPa", rate = "flow.rate_ul_per_s", radius = "cell.radius_um",
                           width = "channel.width_um", viscosity = "flow.viscosity_mPas";

Case case_of(const std::string& more) {
  return parse_case(R"(
channel.width_um = 20
flow.rate_ul_per_s = 0.04
flow.viscosity_mPas = 6
cell.radius_um = 6
cell.bulk.young_modulus_kPa = 1.5
)" + more,
                    "test");
}

Result solved(const Case& c, const std::vector<std::string_view>& keys = {}) {
  return solve_with_gradients(c, keys, [](const Problem& problem, std::span<ProblemLine> lines) {
    return solve_stationary(problem, {}, nullptr, lines);
  });
}

std::size_t index_of(std::string_view measure) {
  std::size_t i = 0;
  while (state_measures[i].name != measure) ++i;
  return i;
}

double value(const Result& result, std::string_view measure) {
  return state_measures[index_of(measure)].physical(result.state, result.scales);
}

/// Derivative times value of the key: by its logarithm.
double by_logarithm(const Result& result, std::size_t gradient, std::string_view measure) {
  const Gradient& g = result.gradients.at(gradient);
  return g.measures(Eigen::Index(index_of(measure))) * std::get<double>(*case_key(g.key).get(result.input));
}

/// Without inertia the shape depends on r0 / w and on E over the stress of the flow, Q eta / w^3, alone.
void expect_similarity(const Case& c) {
  const Result result = solved(c, {E, rate, radius, width, viscosity});
  ASSERT_EQ(result.state.outcome.status, Status::converged) << result.state.outcome.message;
  for (const std::string_view measure : {"deformation", "mode_2", "mode_3", "least_meridional_stretch"}) {
    const double by_E = by_logarithm(result, 0, measure);
    EXPECT_NEAR(by_logarithm(result, 1, measure), -by_E, 1e-5 * std::abs(by_E)) << measure;
    EXPECT_NEAR(by_logarithm(result, 4, measure), -by_E, 1e-5 * std::abs(by_E)) << measure;
    EXPECT_NEAR(by_logarithm(result, 2, measure) + by_logarithm(result, 3, measure), 3 * by_E, 3e-5 * std::abs(by_E))
        << measure;
  }
  const double velocity = value(result, "cell_velocity_m_per_s");
  EXPECT_NEAR(by_logarithm(result, 1, "cell_velocity_m_per_s") + by_logarithm(result, 0, "cell_velocity_m_per_s"),
              velocity, 1e-5 * velocity);
  const double pressure = value(result, "pressure_drop_Pa");
  EXPECT_NEAR(by_logarithm(result, 4, "pressure_drop_Pa") + by_logarithm(result, 0, "pressure_drop_Pa"), pressure,
              1e-5 * pressure);
}

TEST(Gradient, ShapesInATubeAreSimilar) {
  expect_similarity(case_of("flow.density_kg_per_m3 = 0\nnumerics.accuracy = 1e-3"));
}

TEST(Gradient, ShapesInASquareChannelAreSimilar) {
  expect_similarity(case_of("flow.density_kg_per_m3 = 0\nchannel.section = \"square\"\nnumerics.accuracy = 3e-2"));
}

/// Differences between solutions over two steps, extrapolated, by measures.
std::map<std::string_view, double> differences(const Case& c, std::string_view key,
                                               const std::vector<std::string_view>& measures) {
  const double at = std::get<double>(*case_key(key).get(c));
  const auto solved_at = [&](double factor) {
    Case moved = c;
    case_key(key).set(moved, at * factor);
    return solved(moved);
  };
  const Result far_below = solved_at(1 - 2e-3), below = solved_at(1 - 1e-3), above = solved_at(1 + 1e-3),
               far_above = solved_at(1 + 2e-3);
  std::map<std::string_view, double> slopes;
  for (const std::string_view m : measures) {
    const double wide = (value(far_above, m) - value(far_below, m)) / (4e-3 * at);
    slopes[m] = (4 * (value(above, m) - value(below, m)) / (2e-3 * at) - wide) / 3;
  }
  return slopes;
}

/// Slopes that nearly vanish are compared with the measure over the number of the case.
void expect_differences(const Case& c, const std::vector<std::string_view>& keys,
                        const std::vector<std::string_view>& measures) {
  const Result result = solved(c, keys);
  ASSERT_EQ(result.state.outcome.status, Status::converged) << result.state.outcome.message;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double at = std::get<double>(*case_key(keys[i]).get(c));
    for (const auto& [measure, expected] : differences(c, keys[i], measures)) {
      const double slope = result.gradients[i].measures(Eigen::Index(index_of(measure)));
      EXPECT_NEAR(slope, expected, 1e-5 * std::abs(slope) + 3e-7 * std::abs(value(result, measure) / at))
          << keys[i] << ' ' << measure;
    }
  }
}

TEST(Gradient, EqualsDifferencesOfSolutionsInATube) {
  const Case c = case_of(R"(
flow.density_kg_per_m3 = 1000
flow.axial_tension_Pa = 100
cell.rest_aspect = 1.05
cell.cortex.law = "linear"
cell.cortex.modulus_mN_per_m = 2
cell.cortex.tension_mN_per_m = 0.4
cell.cortex.bending_kBT = 1e5
numerics.accuracy = 1e-4
)");
  EXPECT_EQ(line_keys(c).size(), 11);
  expect_differences(c, line_keys(c), {"deformation", "area_um2", "mode_3", "cell_velocity_m_per_s"});
}

TEST(Gradient, EqualsDifferencesOfSolutionsOfACellBesideTheAxis) {
  expect_differences(case_of("channel.section = \"square\"\ncell.offset_um = [0, 1]\nnumerics.accuracy = 1e-1"),
                     {radius}, {"deformation", "drift_velocity_m_per_s", "sine_mode_2"});
}

/// The formula is one-sided where the range of a key ends.
TEST(Gradient, BeginsAtZeroTension) {
  constexpr std::string_view tension = "cell.cortex.tension_mN_per_m";
  const Case c = case_of("numerics.accuracy = 1e-4");
  Case above = c;
  const double step = 1e-3;
  above.cell.cortex.tension_mN_per_m = step;
  const double slope = solved(c, {tension}).gradients[0].measures(Eigen::Index(index_of("deformation")));
  EXPECT_NEAR(slope, (value(solved(above), "deformation") - value(solved(c), "deformation")) / step,
              2e-3 * std::abs(slope));
}

/// In power-law liquids the lowest shear rate counts at a few points alone; what it does keeps nothing else away.
TEST(Gradient, ByOneNumberIsKeptAwayByNoOther) {
  const Case c = parse_case(R"(
channel.width_um = 20
flow.rate_ul_per_s = 0.04
flow.law = "power-law"
flow.consistency_Pa_sn = 0.208
flow.exponent = 0.655
cell.radius_um = 6.13
cell.bulk.young_modulus_kPa = 1.457
)",
                            "test");
  const Result all = solved(c, line_keys(c));
  ASSERT_EQ(all.state.outcome.status, Status::converged) << all.state.outcome.message;
  EXPECT_EQ(all.gradients.size(), 11U);
  for (const Gradient& gradient : all.gradients)
    EXPECT_TRUE(std::isfinite(gradient.measures(Eigen::Index(index_of("area_um2"))))) << gradient.key;
  // Against solutions of neighbouring cases, whose meshes and errors are their own: at accuracy 1e-3 to 1e-4.
  const auto of_radius = std::ranges::find(all.gradients, radius, &Gradient::key);
  ASSERT_NE(of_radius, all.gradients.end());
  EXPECT_NEAR(of_radius->measures(Eigen::Index(index_of("area_um2"))), 38.84, 0.02);
}

/// A first tension makes a membrane of a bare surface, whose margin is another number.
TEST(Gradient, AcrossAJumpOfTheMarginThereIsNone) {
  constexpr std::string_view tension = "cell.cortex.tension_mN_per_m";
  const Result result = solved(case_of("numerics.accuracy = 1e-3"), {tension, E});
  const auto margin = Eigen::Index(index_of("stability_margin")), d = Eigen::Index(index_of("deformation"));
  EXPECT_TRUE(std::isnan(result.gradients[0].measures(margin)));
  EXPECT_NE(result.state.outcome.message.find("cell.cortex.tension_mN_per_m (of stability_margin)"), std::string::npos)
      << result.state.outcome.message;
  EXPECT_TRUE(std::isfinite(result.gradients[0].measures(d)));
  EXPECT_TRUE(std::isfinite(result.gradients[1].measures(margin)));
}

/// The contour moves as the numbers that are measured on it: its greatest height, against a solution nearby.
TEST(Gradient, MovesTheContour) {
  const Case c = case_of("numerics.accuracy = 1e-4");
  Case softer = c;
  const double step = -1e-3;
  softer.cell.bulk.young_modulus_kPa = *c.cell.bulk.young_modulus_kPa + step;
  const Result result = solved(c, {E}), other = solved(softer);
  const auto& slopes = result.gradients[0].surface;
  const double um = result.scales.length_um();
  ASSERT_EQ(slopes.rows(), other.state.surface.point.rows());
  const Eigen::MatrixX2d moved = um * (other.state.surface.point - result.state.surface.point) / step;
  const auto columns = contour_fields();
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const int axis = columns[j].name == "x_um" ? 0 : columns[j].name == "r_um" ? 1 : -1;
    if (axis < 0) continue;
    EXPECT_LT((slopes.col(Eigen::Index(j)) - moved.col(axis)).cwiseAbs().maxCoeff(), 2e-3) << columns[j].name;
  }
  EXPECT_GT(moved.cwiseAbs().maxCoeff(), 0.1);
}

/// What is asked for that there is not, and what the sentence has to name.
TEST(Gradient, RefusesWithTheWayOut) {
  const auto refusal = [](const Case& c, const std::string& key) -> std::string {
    try {
      asked_line_keys(c, std::vector<std::string>{key}, "test");
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(refusal(case_of(""), "cell.radius").find("did you mean cell.radius_um"), std::string::npos);
  EXPECT_NE(refusal(case_of(""), "flow.law").find("there is no gradient"), std::string::npos);
  EXPECT_NE(refusal(case_of(""), "cell.cortex.bending_kBT").find("effect begins"), std::string::npos);
  EXPECT_NE(refusal(case_of("time.end_us = 10\ncell.viscosity_mPas = 10"), "cell.radius_um").find("stationary"),
            std::string::npos);
  const std::string sought = "channel.section = \"square\"\ncell.offset_um = [0, 1]\ncell.place = \"equilibrium\"";
  EXPECT_NE(refusal(case_of(sought), "cell.radius_um").find("cell.offset_um"), std::string::npos);
  EXPECT_EQ(refusal(case_of(""), "all"), "none");
}

/// A cell that is too soft has no shape, and no gradient.
TEST(Gradient, IsNoNumberWithoutAState) {
  Case c = case_of("numerics.accuracy = 1e-2");
  c.cell.bulk.young_modulus_kPa = 0.05;
  const Result result = solved(c, {E});
  EXPECT_NE(result.state.outcome.status, Status::converged);
  EXPECT_TRUE(result.gradients.at(0).measures.array().isNaN().all());
  EXPECT_TRUE(to_json(result)["gradients"][std::string(E)]["deformation"].is_number_float());
}

}  // namespace
}  // namespace rheocyte::gradient_test
