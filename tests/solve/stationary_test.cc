#include "solve/stationary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cases.h"
#include "fem/observe.h"
#include "solve/continuation.h"
#include "solve/tube.h"

namespace rheocyte::stationary_test {
namespace {

/// All numbers of a state whose bits have to repeat.
std::vector<double> numbers(const StationaryState& state) {
  std::vector<double> all = {state.shape.deformation,
                             state.shape.area,
                             state.shape.perimeter,
                             state.shape.volume,
                             state.cell_velocity,
                             state.pressure_drop,
                             state.biot_ratio,
                             state.residual,
                             state.estimated_error,
                             state.outcome.reached,
                             double(state.statistics.newton_iterations)};
  for (const CurvePiece& piece : state.contour.pieces) all.insert(all.end(), piece.data(), piece.data() + piece.size());
  for (const BranchStep& point : state.branch) all.push_back(point.deformation);
  return all;
}

TEST(Stationary, TheSameInputGivesTheSameBits) {
  // Three runs of two cases agree in every number.
  for (const Problem& problem : {test::problem({6, 2.29, 0}), test::in_power_law_liquid(test::problem({7.66, 5, 1}))}) {
    const std::vector<double> first = numbers(solve_stationary(problem));
    for (int run = 0; run < 2; ++run) EXPECT_EQ(numbers(solve_stationary(problem)), first);
  }
}

TEST(Stationary, AConvergedStateIsComplete) {
  // Status, sentence, residual, statistics and branch say that and how the wanted state was reached.
  const Problem problem = test::problem({6, 2.29, 0}, 1e-4);
  const StationaryState state = solve_stationary(problem);
  ASSERT_EQ(state.outcome.status, Status::converged);
  EXPECT_FALSE(state.outcome.message.empty());
  EXPECT_EQ(state.outcome.reached, 1);
  EXPECT_LT(state.residual, 1e-10);
  EXPECT_LE(state.estimated_error, problem.accuracy);
  EXPECT_GT(state.biot_ratio, 0.2956);
  EXPECT_GT(state.additional_pressure_drop, 0);
  EXPECT_NEAR(state.pressure_drop - state.additional_pressure_drop, 8 * state.channel_length, 1e-10);  // rounding
  EXPECT_GT(state.statistics.newton_iterations, 0);
  EXPECT_GT(state.statistics.unknowns, 0);
  ASSERT_FALSE(state.branch.empty());
  for (std::size_t i = 1; i < state.branch.size(); ++i) {
    EXPECT_GE(state.branch[i].compliance, state.branch[i - 1].compliance);
  }
  EXPECT_EQ(state.branch.back().deformation, state.shape.deformation);
}

TEST(Stationary, AGivenPressureDropIsThatOfTheFlowRateThatItDrives) {
  // At its own flow rate q the same cell needs the same pressure drop. In the units of q, moduli are smaller by q and
  // Re is larger by q. The inlets differ by the damped disturbance of the cell, 1e-7.
  Problem driven = test::problem({6, 4.58, 0}, 1e-5);
  driven.liquid.reynolds = 0.08;
  driven.drive = Drive::pressure_drop;
  driven.channel_length = 12;
  const StationaryState one = solve_stationary(driven);
  ASSERT_EQ(one.outcome.status, Status::converged);
  const double q = one.flow_rate, drop = 8 * driven.channel_length;
  EXPECT_LT(q, 0.995);
  EXPECT_GT(q, 0.9);
  EXPECT_NEAR(one.pressure_drop / drop, 1, 1e-8);
  EXPECT_NEAR(one.additional_pressure_drop / drop, 1 - q, 1e-8);
  Problem given = driven;
  given.drive = Drive::rate;
  given.bulk.shear_modulus /= q;
  given.liquid.reynolds *= q;
  const StationaryState other = solve_stationary(given);
  ASSERT_EQ(other.outcome.status, Status::converged);
  EXPECT_NEAR(q * other.pressure_drop / drop, 1, 1e-6);
  EXPECT_NEAR(q * other.cell_velocity / one.cell_velocity, 1, 1e-6);
  EXPECT_NEAR(other.shape.deformation / one.shape.deformation, 1, 1e-5);
}

TEST(Stationary, TheCellKeepsItsVolumeAndItsPlace) {
  // Relative change of volume below 1e-6 at accuracy 1e-4 (the promise), barycentre at the origin.
  for (const test::CellInChannel& cell : {test::CellInChannel{6, 2.29, 0}, {7.66, 3.437, 1}, {8.75, 6, 0.5}}) {
    const StationaryState state = solve_stationary(test::problem(cell, 1e-4));
    ASSERT_EQ(state.outcome.status, Status::converged);
    EXPECT_LT(std::abs(state.relative_volume_change), 1e-6);
    EXPECT_NEAR(state.shape.barycentre, 0, 1e-9);  // the residual of 1e-10 over the cell's volume
  }
}

TEST(Stationary, ANewtonianLiquidIsThePowerLawOfExponentOne) {
  // Two laws, one liquid.
  const Problem newtonian = test::problem({6, 4.58, 1});
  Problem power_law = newtonian;
  power_law.liquid.law = LiquidLaw::power_law;
  power_law.liquid.exponent = 1;
  const StationaryState one = solve_stationary(newtonian), other = solve_stationary(power_law);
  // Newton's tolerance of 1e-10.
  EXPECT_NEAR(other.shape.deformation / one.shape.deformation, 1, 1e-8);
  EXPECT_NEAR(other.cell_velocity, one.cell_velocity, 1e-9);
}

TEST(Stationary, ACarreauLiquidWithoutThinningIsNewtonian) {
  // n = 1, whatever the other numbers.
  const Problem newtonian = test::problem({6, 4.58, 1});
  const StationaryState one = solve_stationary(newtonian);
  const StationaryState other = solve_stationary(test::in_carreau_liquid(newtonian, 1));
  EXPECT_NEAR(other.shape.deformation / one.shape.deformation, 1, 1e-8);  // Newton's tolerance of 1e-10
  EXPECT_NEAR(other.cell_velocity, one.cell_velocity, 1e-9);
}

TEST(Stationary, InACarreauLiquidTheDeformationConvergesWithTheDegree) {
  // On one mesh; the law is smooth, so that every two degrees give more than a decimal.
  const Problem problem = test::in_carreau_liquid(test::problem({6, 4.58, 0}));
  const auto deformation = [&](int degree) {
    TubeDiscrete discrete(problem, {{2, 4, 1, 2}, degree});
    const ContinuationReport first = start_branch(stiffness_path(discrete.system(), problem), {});
    const auto report = continue_branch(stiffness_path(discrete.system(), problem), {}, first.last);
    EXPECT_EQ(report.status, Status::converged);
    return measure(contour(discrete.space(), report.last.unknowns)).deformation;
  };
  const double exact = deformation(10);
  double before = std::abs(deformation(4) / exact - 1);
  for (const int degree : {6, 8}) {
    const double error = std::abs(deformation(degree) / exact - 1);
    EXPECT_LT(error, std::max(0.1 * before, 1e-8)) << degree;
    before = error;
  }
}

TEST(Stationary, ProgressSeesEveryPointOfTheBranch) {
  // The callback is called in order with what the state keeps.
  std::vector<double> seen;
  const StationaryState state = solve_stationary(test::problem({6, 2.29, 0}),
                                                 [&](const BranchStep& point) { seen.push_back(point.deformation); });
  ASSERT_EQ(seen.size(), state.branch.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], state.branch[i].deformation);
}

TEST(Stationary, TheFieldsCanBeWrittenAfterTheSolve) {
  // The state keeps what it needs alive.
  const StationaryState state = solve_stationary(test::problem({6, 20, 1}));
  ASSERT_TRUE(state.write_fields);
  const auto path = std::filesystem::path(testing::TempDir()) / "rheocyte_stationary_test.vtu";
  EXPECT_TRUE(state.write_fields(path.string(), {}));
  EXPECT_GT(std::filesystem::file_size(path), 1000u);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace rheocyte::stationary_test
