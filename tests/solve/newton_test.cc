#include "solve/newton.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.h"
#include "fem/observe.h"
#include "shape/measures.h"
#include "solve/continuation.h"
#include "solve/tube.h"

namespace rheocyte::newton_test {
namespace {

const Resolution resolution = {{2, 4, 1, 2}, 5};

struct CoarseProblem {
  explicit CoarseProblem(const Problem& problem) : discrete(problem, resolution), media(media_at(problem, 1)) {}
  TubeDiscrete discrete;
  Media media;
};

NewtonOptions full_newton() {
  NewtonOptions options;
  options.chord_steps = false;
  options.tolerance = 1e-12;
  return options;
}

/// Residuals before and after one Newton step from the state of a cell that is stiffer by the factor 1 + h.
std::array<double, 2> one_step(CoarseProblem& coarse, const VectorXd& converged, double h) {
  Media stiffer = coarse.media;
  stiffer.bulk.shear_modulus *= 1 + h;
  NewtonOptions options = full_newton();
  options.iteration_limit = 1;
  VectorXd x = converged;
  const NewtonReport report = newton(coarse.discrete.system(), stiffer, options, x);
  return {report.residual_history[0], report.residual_history[1]};
}

TEST(Newton, AStepSquaresTheResidual) {
  // Halving the first residual quarters the one after a step: log(r1/r1') / log(r0/r0') = 2, for each law.
  std::vector<Problem> problems;
  for (const double fraction : {0.0, 1.0, 0.5}) problems.push_back(test::problem({6, 4.58, fraction}));
  problems.push_back(problems[1]);
  problems.back().liquid.reynolds = 0.3;
  for (const Problem& problem : problems) {
    CoarseProblem coarse(problem);
    VectorXd x = coarse.discrete.system().sphere();
    ASSERT_EQ(newton(coarse.discrete.system(), coarse.media, full_newton(), x).status, Status::converged);
    for (const double h : {0.02, 0.01}) {
      const auto whole = one_step(coarse, x, h), half = one_step(coarse, x, h / 2);
      // Cubic terms are of the order of h.
      EXPECT_NEAR(std::log(whole[1] / half[1]) / std::log(whole[0] / half[0]), 2, 0.1);
    }
  }
}

TEST(Newton, TheResidualsFallEverFaster) {
  // From the sphere every step gains more digits than the one before, once it converges at all.
  CoarseProblem coarse(test::problem({6, 4.58, 1}));
  VectorXd x = coarse.discrete.system().sphere();
  const NewtonReport report = newton(coarse.discrete.system(), coarse.media, full_newton(), x);
  ASSERT_EQ(report.status, Status::converged);
  std::vector<double> r = report.residual_history;
  while (r.back() < 1e-13) r.pop_back();  // rounding
  for (std::size_t k = 3; k < r.size(); ++k) EXPECT_LT(r[k] / r[k - 1], r[k - 1] / r[k - 2]);
  EXPECT_LE(report.iterations, 6);
}

TEST(Newton, ChordStepsReachTheSameStateWithFewerFactorisations) {
  // A kept factorisation changes the way, not the end.
  CoarseProblem coarse(test::problem({6, 4.58, 1}));
  StationarySystem& system = coarse.discrete.system();
  VectorXd full = system.sphere(), chord = full;
  NewtonOptions options = full_newton();
  ASSERT_EQ(newton(system, coarse.media, options, full).status, Status::converged);
  const int factorisations = system.work().factorisations;
  options.chord_steps = true;
  ASSERT_EQ(newton(system, coarse.media, options, chord).status, Status::converged);
  EXPECT_LT(system.work().factorisations - factorisations, factorisations);
  // Residuals of 1e-12 times the condition of the equations.
  EXPECT_LT((full - chord).norm() / full.norm(), 1e-9);
}

TEST(Newton, AConvergedStateSatisfiesItsEquations) {
  // Residual below tolerance, barycentre at the origin, volume kept, mesh not folded.
  const Problem problem = test::problem({6, 4.58, 1});
  CoarseProblem coarse(problem);
  const Discretisation& space = coarse.discrete.space();
  VectorXd x = coarse.discrete.system().sphere();
  const NewtonReport report = newton(coarse.discrete.system(), coarse.media, full_newton(), x);
  EXPECT_LT(report.residual, 1e-12);
  const auto [residual, min_det] = coarse.discrete.system().residual(coarse.media, x);
  EXPECT_NEAR(residual.norm() / residual_scale(coarse.discrete.system(), coarse.media), report.residual, 1e-15);
  EXPECT_GT(min_det, 0);
  const ShapeMeasures shape = measure(contour(space, x));
  EXPECT_NEAR(shape.barycentre, 0, 1e-10);  // rounding of the residual over the cell's volume
  const double sphere = measure(contour(space, coarse.discrete.system().sphere())).volume;
  EXPECT_NEAR(shape.volume / sphere, 1, 1e-10);  // incompressible in each element
}

TEST(Newton, TheIterationLimitIsReported) {
  // One factorisation is not enough from the sphere.
  CoarseProblem coarse(test::problem({6, 2.29, 0}));
  NewtonOptions options = full_newton();
  options.iteration_limit = 1;
  VectorXd x = coarse.discrete.system().sphere();
  EXPECT_EQ(newton(coarse.discrete.system(), coarse.media, options, x).status, Status::iteration_limit);
}

TEST(Newton, AStopIsReportedBeforeAnyWork) {
  // A raised flag ends the iteration at once.
  CoarseProblem coarse(test::problem({}));
  const std::atomic<bool> stop = true;
  NewtonOptions options;
  options.stop = &stop;
  VectorXd x = coarse.discrete.system().sphere();
  const NewtonReport report = newton(coarse.discrete.system(), coarse.media, options, x);
  EXPECT_EQ(report.status, Status::stopped);
  EXPECT_EQ(report.iterations, 0);
}

TEST(Newton, NumbersThatAreNotFiniteAreReported) {
  // NaN in the modulus, in the Reynolds number, or in the state.
  const double nan = std::nan("");
  CoarseProblem coarse(test::problem({}));
  StationarySystem& system = coarse.discrete.system();
  Media bad_modulus = coarse.media, bad_reynolds = coarse.media;
  bad_modulus.bulk.shear_modulus = nan;
  bad_reynolds.liquid.reynolds = nan;
  for (const Media& media : {bad_modulus, bad_reynolds}) {
    VectorXd x = system.sphere();
    EXPECT_EQ(newton(system, media, {}, x).status, Status::not_finite);
  }
  VectorXd x = system.sphere();
  x(3) = nan;
  EXPECT_EQ(newton(system, coarse.media, {}, x).status, Status::not_finite);
}

TEST(Newton, ACellWithoutStiffnessIsSingular) {
  // mu = 0: displacements inside the cell that keep the volume are not determined.
  CoarseProblem coarse(test::problem({}));
  coarse.media.bulk.shear_modulus = 0;
  VectorXd x = coarse.discrete.system().sphere();
  const Status status = newton(coarse.discrete.system(), coarse.media, {}, x).status;
  EXPECT_EQ(status, Status::singular_matrix) << name(status);
}

TEST(Newton, AFoldedMeshIsReported) {
  // A start whose surface is pushed through the wall.
  CoarseProblem coarse(test::problem({}));
  const Discretisation& space = coarse.discrete.space();
  VectorXd x = coarse.discrete.system().sphere();
  for (const BoundaryEdge& edge : space.surface()) {
    for (const int node : edge.nodes) {
      if (const int r = space.displacement(node, 1); r >= 0) x(r) = 1;
    }
  }
  const Status status = newton(coarse.discrete.system(), coarse.media, {}, x).status;
  EXPECT_EQ(status, Status::mesh_folded) << name(status);
}

}  // namespace
}  // namespace rheocyte::newton_test
