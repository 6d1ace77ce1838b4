#include "solve/session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "cases.h"
#include "solve/duct.h"

namespace rheocyte::session_test {
namespace {

double deformation(const Problem& problem) { return solve_stationary(problem).shape.deformation; }

TEST(Session, ANearCaseIsAnsweredFromTheLastOne) {
  // Steps in modulus, radius, tension and flow, one after the other: as from the sphere, within the tolerance of
  // Newton's method (1e-10 of the driving forces, some hundred times that in a small deformation).
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  problem.cortex.tension = 0.5;
  Session session;
  session.solve(problem);
  for (int i = 0; i < 8; ++i) {
    if (i % 4 == 0) problem.bulk.shear_modulus *= 1.05;
    if (i % 4 == 1) problem.radius_ratio *= 0.98;
    if (i % 4 == 2) problem.cortex.tension *= 1.1;
    if (i % 4 == 3) problem.liquid.reynolds += 0.02;
    const StationaryState state = session.solve(problem);
    EXPECT_EQ(state.outcome.status, Status::converged);
    EXPECT_LE(state.estimated_error, 1e-3);
    EXPECT_NEAR(state.shape.deformation / deformation(problem), 1, 1e-6) << i;
  }
  EXPECT_EQ(session.warm_starts(), 8);
}

TEST(Session, ACaseFarAwayStartsFromTheSphere) {
  // Half the modulus, and another law.
  Session session;
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  session.solve(problem);
  problem.bulk.shear_modulus /= 2;
  EXPECT_EQ(session.solve(problem).shape.deformation, deformation(problem));
  problem = test::problem({6, 4.58, 1}, 1e-3);
  EXPECT_EQ(session.solve(problem).shape.deformation, deformation(problem));
  EXPECT_EQ(session.warm_starts(), 0);
}

TEST(Session, FromANewtonianExponentToAShearThinningOneItStartsAnew) {
  // The elements along the surface are others: unknowns of one mean nothing in the other.
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  problem.liquid = {.law = LiquidLaw::power_law, .exponent = 1};
  Session session;
  session.solve(problem);
  problem.liquid.exponent = 0.98;
  EXPECT_EQ(session.solve(problem).shape.deformation, deformation(problem));
  problem.liquid.exponent = 0.979;
  EXPECT_NEAR(session.solve(problem).shape.deformation / deformation(problem), 1, 1e-6);
  EXPECT_EQ(session.warm_starts(), 1);
}

TEST(Session, AHigherAccuracyGoesOnFromTheKeptStates) {
  // The ladder of degrees is climbed on from where it ended.
  Session session;
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  const int coarse = session.solve(problem).statistics.degree;
  problem.accuracy = 1e-5;
  const StationaryState fine = session.solve(problem);
  EXPECT_GT(fine.statistics.degree, coarse);
  EXPECT_LE(fine.estimated_error, 1e-5);
  EXPECT_NEAR(fine.shape.deformation / deformation(problem), 1, 1e-5);
}

TEST(Session, ItKeepsNoMoreThanItsLimit) {
  // Cases too far from each other for a warm start: those before the limit are forgotten, the answers stay right.
  constexpr std::size_t limit = 40 << 20;
  Session bounded(limit);
  for (const double radius : {4.0, 5.0, 6.0, 7.0}) {
    bounded.solve(test::problem({radius, 8, 0}, 1e-3));
    EXPECT_LE(bounded.memory_bytes(), limit);
    EXPECT_GT(bounded.memory_bytes(), 0u);
  }
  Session none(0);
  none.solve(test::problem({6, 8, 0}, 1e-3));
  EXPECT_EQ(none.memory_bytes(), 0u);
}

TEST(Session, ACancelledSolveLeavesTheSessionUsable) {
  // Stopped before the first iteration, with a state nearby and without; what was kept is still there.
  Session session;
  const std::atomic<bool> stop = true;
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  EXPECT_EQ(session.solve(problem, {}, &stop).outcome.status, Status::stopped);
  session.solve(problem);
  problem.bulk.shear_modulus *= 1.02;
  problem.radius_ratio *= 1.01;
  EXPECT_EQ(session.solve(problem, {}, &stop).outcome.status, Status::stopped);
  const StationaryState state = session.solve(problem);
  EXPECT_EQ(state.outcome.status, Status::converged);
  EXPECT_EQ(session.warm_starts(), 1);
  EXPECT_NEAR(state.shape.deformation / deformation(problem), 1, 1e-9);
}

TEST(Session, ASolveCancelledOnTheWayToAFinerMeshLosesNothing) {
  // A finer accuracy is wanted of a state that is kept, and is given up once its meshes are exhausted.
  Session session;
  std::atomic<bool> stop = false;
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  session.solve(problem);
  problem.accuracy = 1e-6;
  EXPECT_EQ(session
                .solve(
                    problem, [&](const BranchStep&) { stop = true; }, &stop)
                .outcome.status,
            Status::stopped);
  problem.accuracy = 1e-3;
  EXPECT_EQ(session.solve(problem).outcome.status, Status::converged);
  EXPECT_EQ(session.warm_starts(), 2);
}

TEST(Session, TwoThreadsWithASessionEachFindTheSame) {
  // Bit by bit.
  const auto deformations = [](std::vector<double>& found) {
    Session session;
    Problem problem = test::problem({6, 4.58, 0}, 1e-3);
    for (int i = 0; i < 4; ++i, problem.bulk.shear_modulus *= 0.97)
      found.push_back(session.solve(problem).shape.deformation);
  };
  std::vector<double> one, other;
  {
    const std::jthread first([&] { deformations(one); }), second([&] { deformations(other); });
  }
  EXPECT_EQ(one, other);
}

TEST(Session, TheFieldsOfAnAnswerOutliveTheSessionsWay) {
  // The writer of an earlier answer still writes that answer.
  Session session;
  Problem problem = test::problem({6, 4.58, 0}, 1e-3);
  const StationaryState first = session.solve(problem);
  const auto file = testing::TempDir() + "session-fields.vtu";
  const auto written = [&] {
    EXPECT_TRUE(first.write_fields(file, {}));
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  };
  const std::string before = written();
  problem.radius_ratio *= 0.97;
  session.solve(problem);
  EXPECT_EQ(session.warm_starts(), 1);
  EXPECT_EQ(written(), before);
  std::filesystem::remove(file);
}

TEST(Session, ACellFarTooSoftIsRefusedWithTheStateAtTheEndOfItsBranch) {
  // A hundredth of a modulus that exists: the outcome says so, and the state is one of the branch.
  Session session;
  const StationaryState state = session.solve(test::problem({7, 0.03, 1}));
  EXPECT_NE(state.outcome.status, Status::converged);
  EXPECT_GT(state.outcome.reached, 0);
  EXPECT_LT(state.outcome.reached, 0.1);
  EXPECT_GT(state.shape.deformation, 0.08);
}

/// In the square channel, at degrees 3 and 4.
Problem cell_in_square() {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = 0.6;
  problem.bulk.shear_modulus = 8;
  problem.cortex.tension = 0.2;
  problem.liquid = {.law = LiquidLaw::power_law, .exponent = 0.9};
  problem.accuracy = 5e-2;
  return problem;
}

TEST(DuctLadder, TwoDegreesThatAgreeByChanceDoNotPassForAccurate) {
  // Seen along the diagonal, a cell of d = 0.01 differs by 3e-5 between degrees 3 and 4, whose error is 1.3e-4.
  Ladder ladder{duct_geometry(cell_in_square()).errors};
  StateNumbers numbers;
  numbers.shape.deformation = 0.01;
  ladder.add({}, numbers);
  ladder.add({}, numbers);
  EXPECT_GT(ladder.estimated_error, 1e-4);
  ladder.add({}, numbers);
  EXPECT_LT(ladder.estimated_error, 1e-12);
}

TEST(DuctSession, ANearCaseIsAnsweredFromTheLastOne) {
  // Steps in modulus, radius, tension and exponent, one after the other; then as from the sphere, within the tolerance
  // of Newton's method.
  Problem problem = cell_in_square();
  Session session;
  session.solve(problem);
  StationaryState state;
  for (double* moved :
       {&problem.bulk.shear_modulus, &problem.radius_ratio, &problem.cortex.tension, &problem.liquid.exponent}) {
    *moved *= 0.97;
    state = session.solve(problem);
    EXPECT_EQ(state.outcome.status, Status::converged);
    EXPECT_LE(state.estimated_error, problem.accuracy);
  }
  EXPECT_EQ(session.warm_starts(), 4);
  const StationaryState anew = solve_stationary(problem);
  EXPECT_EQ(state.statistics.degree, anew.statistics.degree);
  EXPECT_NEAR(state.shape.deformation / anew.shape.deformation, 1, 1e-6);
  EXPECT_LT(state.statistics.factorisations, anew.statistics.factorisations);
}

TEST(DuctSession, ItKeepsNoMoreThanItsLimitAndStillAnswersFromWhatItKept) {
  // The factors of degree 3 take 12 MB, those of degree 4 four times as much.
  constexpr std::size_t limit = 20 << 20;
  Problem problem = cell_in_square();
  Session session(limit);
  session.solve(problem);
  EXPECT_GT(session.memory_bytes(), 0u);
  EXPECT_LE(session.memory_bytes(), limit);
  problem.bulk.shear_modulus *= 1.03;
  EXPECT_EQ(session.solve(problem).outcome.status, Status::converged);
  EXPECT_EQ(session.warm_starts(), 1);
  EXPECT_LE(session.memory_bytes(), limit);
}

TEST(DuctSession, ACancelledSolveLeavesWhatWasKept) {
  // On another mesh, to which the factors have been handed on, and are handed back.
  Problem problem = cell_in_square();
  Session session;
  const double before = session.solve(problem).shape.deformation;
  Problem other = problem;
  other.radius_ratio *= 1.02;
  const std::atomic<bool> stop = true;
  EXPECT_EQ(session.solve(other, {}, &stop).outcome.status, Status::stopped);
  const StationaryState state = session.solve(problem);
  EXPECT_EQ(session.warm_starts(), 1);
  EXPECT_EQ(state.statistics.factorisations, 0);
  EXPECT_NEAR(state.shape.deformation / before, 1, 1e-7);
}

TEST(DuctSession, SeveralStatesAreKept) {
  // Two cells far from each other, in turns: each is answered from its own, as is a cell in a tube in between.
  Problem one = cell_in_square(), other = cell_in_square(), in_tube = test::problem({6, 4.58, 0}, 1e-3);
  other.bulk.shear_modulus *= 2;
  Session session;
  for (const Problem& problem : {one, other, in_tube}) session.solve(problem);
  EXPECT_EQ(session.warm_starts(), 0);
  for (Problem* problem : {&one, &other, &in_tube}) {
    problem->bulk.shear_modulus *= 0.99;
    EXPECT_EQ(session.solve(*problem).outcome.status, Status::converged);
  }
  EXPECT_EQ(session.warm_starts(), 3);
}

TEST(DuctSession, ATubeByHexahedraIsNoStartForTheTubeByItsMeridian) {
  // Their unknowns mean different things, although the problem is the same.
  Problem tube = cell_in_square();
  tube.section = Section::tube;
  Session session;
  const StationaryState by_hexahedra = session.solve_in(duct_geometry(tube), tube);
  const StationaryState by_meridian = session.solve(tube);
  EXPECT_EQ(session.warm_starts(), 0);
  EXPECT_EQ(by_meridian.outcome.status, Status::converged);
  EXPECT_NEAR(by_hexahedra.shape.deformation / by_meridian.shape.deformation, 1, 2 * tube.accuracy);
}

}  // namespace
}  // namespace rheocyte::session_test
