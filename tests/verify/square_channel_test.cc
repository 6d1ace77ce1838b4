// The square channel in three dimensions against the tube's program, and against values that were computed
// independently with the same method by another program.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "duct/duct_transfer.h"
#include "fem/observe.h"
#include "solve/branch_samples.h"
#include "solve/continuation.h"
#include "solve/duct.h"
#include "solve/session.h"

namespace rheocyte::square_channel_test {
namespace {

constexpr double half_width_m = 1e-5, mean_velocity = 0.04e-9 / (4 * half_width_m * half_width_m);

/// r0 in h; E in kPa; in the channel of 20 um at 0.04 ul/s, Stokes.
Problem newtonian_cell(double radius_ratio, double young_modulus_kPa) {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = radius_ratio;
  problem.bulk.shear_modulus = 1e3 * young_modulus_kPa / 3 / (15e-3 * mean_velocity / half_width_m);
  return problem;
}

/// In methyl cellulose, K = 0.4057 Pa s^n.
Problem power_law_cell(double radius_ratio, double young_modulus_kPa) {
  Problem problem = newtonian_cell(radius_ratio, 1);
  problem.liquid = {.law = LiquidLaw::power_law, .exponent = 0.6039};
  problem.bulk.shear_modulus =
      1e3 * young_modulus_kPa / 3 / (0.4057 * std::pow(mean_velocity / half_width_m, problem.liquid.exponent));
  return problem;
}

struct Deformations {
  double side, diagonal;
};

struct CoarseState {
  std::shared_ptr<DuctDiscrete> discrete;
  VectorXd unknowns;
};

/// Along the branch at degree 3.
CoarseState coarse_state(const Problem& problem) {
  const auto discrete = std::make_shared<DuctDiscrete>(problem, DuctSubdivision{}, 3);
  ContinuationOptions options;
  options.newton.tolerance = 1e-7;
  ContinuationReport report = start_branch(stiffness_path(discrete->system(), problem), options);
  if (report.last.parameter < 1)
    report = continue_branch(stiffness_path(discrete->system(), problem), options, report.last);
  EXPECT_EQ(report.last.parameter, 1);
  return {discrete, report.last.unknowns};
}

/// Carried to a degree, one after the other.
Deformations deformations(const Problem& problem, int degree) {
  auto [discrete, state] = coarse_state(problem);
  for (int next = discrete->space().reference().degree() + 1; next <= degree; ++next) {
    const auto fine = std::make_shared<DuctDiscrete>(problem, DuctSubdivision{}, next);
    state = transfer(discrete->space(), state, fine->space());
    discrete = fine;
    EXPECT_EQ(newton(discrete->system(), problem, {.tolerance = 1e-9}, state).status, Status::converged) << next;
  }
  return {duct_deformation(discrete->space(), state, Camera::side),
          duct_deformation(discrete->space(), state, Camera::diagonal)};
}

/// Velocity of a rigid sphere over that of the undisturbed liquid on the axis.
double velocity_ratio(double radius_ratio, int degree) {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = radius_ratio;
  problem.bulk.shear_modulus = 1e7;
  DuctDiscrete discrete(problem, {}, degree);
  VectorXd state = discrete.system().sphere();
  EXPECT_EQ(newton(discrete.system(), problem, {.tolerance = 1e-8}, state).status, Status::converged);
  const CrossSection& section = discrete.space().section();
  return state(discrete.space().cell_velocity()) / section.flow({}).velocity(section.node_at({0, 0}));
}

TEST(SquareChannel, ARigidSphereLagsBehindTheLiquidOnTheAxis) {
  // The coarse mesh at degree 4 is good to 5e-5.
  EXPECT_NEAR(velocity_ratio(0.5, 4), 0.86282, 1e-4);
}

TEST(SquareChannelSlow, SmallRigidSpheresLagAsFaxenSays) {
  EXPECT_NEAR(velocity_ratio(0.1, 5), 0.994294, 1e-4);
  EXPECT_NEAR(velocity_ratio(0.2, 5), 0.977360, 1e-4);
}

constexpr Bulk liquid_interior{BulkLaw::none, 0};
Bulk neo_hookean(double shear_modulus) { return {BulkLaw::neo_hookean, shear_modulus}; }

/// The tube by hexahedra of a degree has in both views the deformation that the meridional plane gives at an accuracy.
void expect_the_tube(const Bulk& bulk, double accuracy, int degree, double tolerance, const Cortex& cortex = {}) {
  Problem problem;
  problem.bulk = bulk;
  problem.cortex = cortex;
  problem.radius_ratio = 0.5484;
  problem.accuracy = accuracy;
  const double exact = solve_stationary(problem).shape.deformation;
  const auto [side, diagonal] = deformations(problem, degree);
  EXPECT_NEAR(side / exact, 1, tolerance);
  EXPECT_NEAR(diagonal / exact, 1, tolerance);
}

TEST(SquareChannel, ATubeInThreeDimensionsIsTheTubeInBothViews) {
  // 69 hexahedra at degree 4 are good to 1e-3 of the deformation, and the circle to its interpolation.
  expect_the_tube(neo_hookean(10), 1e-5, 4, 1e-3);
}

TEST(SquareChannel, ACortexInThreeDimensionsIsThatOfTheTubeInBothViews) {
  const Cortex tension{.tension = 0.5}, bending{.bending = 0.003}, linear{CortexLaw::linear, 2, 0.5, 0},
      bent_shell{CortexLaw::neo_hookean, 2, 0.5, 0.005};
  for (const Cortex& cortex : {tension, bending, linear, bent_shell})
    expect_the_tube(neo_hookean(6), 1e-5, 4, 1e-3, cortex);
}

TEST(SquareChannel, AShellInThreeDimensionsIsThatOfTheTubeInBothViews) {
  const Cortex linear{CortexLaw::linear, 26, 2.6, 0}, bent{CortexLaw::neo_hookean, 26, 0.6, 0.05};
  for (const Cortex& cortex : {linear, bent}) expect_the_tube(liquid_interior, 1e-5, 5, 1e-3, cortex);
}

TEST(SquareChannelSlow, ACortexInThreeDimensionsIsThatOfTheTubeToOneTenThousandth) {
  // A bulk of 4 within the second shell is at the end of its smooth branch (margin 0.002), where no mesh is fine
  // enough.
  const Cortex thin_shell{CortexLaw::thin_shell, 2, 0.5, 0}, membrane{CortexLaw::neo_hookean_reference, 2, 0.5, 0},
      bending{.bending = 5e-4};
  for (const auto& [cortex, shear_modulus] :
       {std::pair{thin_shell, 4.0}, std::pair{membrane, 6.0}, std::pair{bending, 6.0}})
    expect_the_tube(neo_hookean(shear_modulus), 1e-6, 6, 1e-4, cortex);
}

TEST(SquareChannelSlow, AShellInThreeDimensionsIsThatOfTheTubeToOneHundredThousandth) {
  const Cortex linear{CortexLaw::linear, 26, 2.6, 0}, thin_shell{CortexLaw::thin_shell, 20, 3, 0.05};
  for (const Cortex& cortex : {linear, thin_shell}) expect_the_tube(liquid_interior, 1e-6, 7, 1e-5, cortex);
}

TEST(SquareChannelSlow, ATubeInThreeDimensionsIsTheTubeInBothViewsToOneTenThousandth) {
  expect_the_tube(neo_hookean(5), 1e-6, 6, 1e-4);
}

TEST(SquareChannelSlow, DeformationsAreThoseOfAnIndependentProgram) {
  // Given to four digits and to 2e-4.
  const auto thinning = deformations(power_law_cell(0.6, 1.198), 5);
  EXPECT_NEAR(thinning.side / 0.02279, 1, 3e-4);
  EXPECT_NEAR(thinning.diagonal / 0.02040, 1, 3e-4);
  EXPECT_NEAR(deformations(newtonian_cell(0.6, 4.0), 5).side / 0.012644, 1, 3e-4);
  EXPECT_NEAR(deformations(newtonian_cell(0.6, 2.5), 5).side / 0.03502, 1, 3e-4);
}

TEST(SquareChannelSlow, ASmallCellDeformsInTheMeanOfBothViewsAsInTheTubeWhoseFlowIsTheSameNearTheAxis) {
  // A cell of a tenth of the half width sees the velocity on the axis and the curvature of the profile, which is that
  // of the pressure gradient: u_max = 2.0963 U and 7.113538 eta U / h^2 in the square, 2 U and 8 eta U / R^2 in a tube.
  // What the profile has besides is 0.18 (r/h)^2 cos 4phi of the parabola: both views leave the tube's deformation by
  // a^2 in opposite directions, and their mean does not. The walls change it by the fifth power of the ratio at first.
  const double axis = 2.0963, gradient = 7.113538;
  const double R = std::sqrt(4 * axis / gradient), U = axis / 2;
  Problem square;
  square.section = Section::square;
  square.radius_ratio = 0.1;
  square.bulk.shear_modulus = 2.7;
  Problem tube = square;
  tube.section = Section::tube;
  tube.radius_ratio = 0.1 / R;
  tube.bulk.shear_modulus = 2.7 * R / U;
  tube.accuracy = 1e-5;
  const StationaryState state = solve_stationary(tube);
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  const auto [side, diagonal] = deformations(square, 5);
  // Degree 5 is good to 1e-4; second order in the difference of the views is 1e-5.
  EXPECT_NEAR((side + diagonal) / 2 / state.shape.deformation, 1, 2e-4);
  EXPECT_GT(side, diagonal);
  EXPECT_NEAR(side / diagonal, 1, 6e-3);  // 2 x 0.18 a^2 by the profile, and somewhat more by the cell's answer
}

TEST(SquareChannelSlow, StatesOfABranchAreThoseOfTheCellsThemselves) {
  // The branch is followed for all states at once; both ways end at degree 4 with a Newton residual of 1e-9.
  Problem problem = newtonian_cell(0.4, 0.15);
  problem.accuracy = 0.05;
  const std::vector heights{0.6, 1.0};
  const BranchSamples branch =
      branch_samples(problem, softening(problem), {.max_deformation = 0.01, .heights = heights});
  EXPECT_EQ(branch.end, Status::converged);
  ASSERT_EQ(branch.states.size(), heights.size());
  EXPECT_NEAR(branch.states[1].shape.deformation / 0.01, 1, 0.1);
  EXPECT_NEAR(branch.states[0].shape.deformation / branch.states[1].shape.deformation, 0.36, 0.03);
  Problem one = problem;
  one.bulk.shear_modulus /= branch.states[0].outcome.reached;
  const StationaryState state = solve_stationary(one);
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  EXPECT_EQ(state.statistics.degree, branch.states[0].statistics.degree);
  EXPECT_NEAR(branch.states[0].shape.deformation / state.shape.deformation, 1, 1e-7);
}

TEST(SquareChannelSlow, AlongABranchWhatDoesNotSoftenStaysAsItIs) {
  // A bending stiffness that all cells of a branch share changes the softest one's deformation by several per cent.
  Problem problem = newtonian_cell(0.4, 0.15);
  problem.accuracy = 0.05;
  problem.cortex.bending = 0.02 * problem.bulk.shear_modulus * std::pow(problem.radius_ratio, 3);
  const auto media = [&](double compliance) {
    Media at = problem;
    at.bulk.shear_modulus /= compliance;
    return at;
  };
  const BranchSamples branch = branch_samples(problem, media, {.max_deformation = 0.01, .heights = {0.6, 1}});
  ASSERT_EQ(branch.states.size(), 2);
  Problem one = with_media(problem, media(branch.states[1].outcome.reached));
  const StationaryState state = solve_stationary(one);
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  ASSERT_EQ(state.statistics.degree, branch.states[1].statistics.degree);
  EXPECT_NEAR(branch.states[1].shape.deformation / state.shape.deformation, 1, 1e-7);
  one.cortex.bending = 0;
  EXPECT_GT(std::abs(solve_stationary(one).shape.deformation / state.shape.deformation - 1), 1e-3);
}

TEST(SquareChannel, ABranchMayEndBeforeTheFirstStepOfAWayWould) {
  Problem problem = newtonian_cell(0.6, 1);
  problem.accuracy = 0.05;
  const BranchSamples branch =
      branch_samples(problem, softening(problem), {.max_deformation = 1e-4, .heights = {0.5, 1}});
  ASSERT_EQ(branch.end, Status::converged);
  ASSERT_EQ(branch.states.size(), 2);
  EXPECT_NEAR(branch.states[1].shape.deformation, 1e-4, 1e-5);
}

TEST(SquareChannel, ABranchEndsWhereItsSurfaceIsAsNearToTheLimitAsItMayBe) {
  Problem problem = newtonian_cell(0.6, 1);
  problem.accuracy = 0.05;
  constexpr double least_margin = 0.6;
  const BranchSamples branch = branch_samples(problem, softening(problem), {0.05, least_margin, {1}});
  EXPECT_EQ(branch.end, Status::surface_unstable);
  ASSERT_EQ(branch.states.size(), 1);
  EXPECT_GT(branch.states[0].stability_margin, least_margin);
  EXPECT_LT(branch.states[0].stability_margin, least_margin + 0.04);
}

TEST(SquareChannelSlow, ABranchEndsWhereHigherDegreesHaveNoStableState) {
  // In 0.83 % methyl cellulose: at degree 3 the surface of this small cell is stable up to d = 0.067.
  Problem problem = newtonian_cell(0.34, 1);
  problem.liquid = {.law = LiquidLaw::power_law, .exponent = 0.5149};
  problem.bulk.shear_modulus = 1e3 / 3 / (1.4936 * std::pow(mean_velocity / half_width_m, problem.liquid.exponent));
  problem.accuracy = 2e-3;
  const BranchSamples bare = branch_samples(problem, softening(problem), {.max_deformation = 0.06, .heights = {1}});
  EXPECT_EQ(bare.end, Status::surface_unstable);
  ASSERT_EQ(bare.states.size(), 1);
  EXPECT_LT(bare.states[0].shape.deformation, 0.058);
  EXPECT_GT(bare.states[0].stability_margin, 0);
  EXPECT_LT(bare.states[0].estimated_error, problem.accuracy);
  problem.cortex.bending = 3e-5 * 3 * problem.bulk.shear_modulus * std::pow(problem.radius_ratio, 3);
  const BranchSamples held = branch_samples(problem, softening(problem), {.max_deformation = 0.06, .heights = {1}});
  EXPECT_EQ(held.end, Status::converged);
  ASSERT_EQ(held.states.size(), 1);
  EXPECT_GT(held.states[0].shape.deformation, 0.06);
}

TEST(SquareChannelSlow, OnTheCoarsestMeshTheSurfaceIsAsFarFromItsLimitAsOnFineOnes) {
  // lambda_min^2 lambda_max is 0.358 by degree 5 with twice as many elements along the cell, and 0.357 by degree 6 with
  // these; degree 3 has 0.344 at Gauss points, but 0.325 at the borders of its elements.
  Problem problem = newtonian_cell(0.29316, 0.85);
  problem.bulk.law = BulkLaw::linear;
  const auto [discrete, unknowns] = coarse_state(problem);
  EXPECT_NEAR(biot_limit + (1 - biot_limit) * discrete->stability_margin(problem, unknowns), 0.358, 0.02);
}

/// Side and diagonal, or for a rectangle along height and width, and the cell's velocity, on a coarse mesh.
std::array<double, 3> views_and_velocity(const Problem& problem, Symmetry symmetry, Camera second) {
  DuctDiscrete discrete(problem, {.along = 2, .layers = 1, .axial = 1}, 3, symmetry);
  VectorXd state = discrete.system().sphere();
  EXPECT_EQ(newton(discrete.system(), problem, {.tolerance = 1e-12}, state).status, Status::converged);
  return {duct_deformation(discrete.space(), state, Camera::side), duct_deformation(discrete.space(), state, second),
          state(discrete.space().cell_velocity())};
}

TEST(SquareChannel, AQuarterIsTwoEighths) {
  // The same elements and nodes, so that only rounding and the outline's pieces along the diagonal differ.
  const Problem problem = newtonian_cell(0.6, 12);
  const auto eighth = views_and_velocity(problem, Symmetry::eighth, Camera::side),
             quarter = views_and_velocity(problem, Symmetry::quarter, {90});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(quarter[i] / eighth[i], 1, 1e-8);
}

TEST(SquareChannel, ARectangleWithEqualSidesIsTheSquareAndTurnsWithItsSides) {
  Problem square = newtonian_cell(0.6, 12), rectangle = square;
  rectangle.section = Section::rectangle;
  const auto one = views_and_velocity(square, Symmetry::eighth, Camera::side),
             other = views_and_velocity(rectangle, Symmetry::quarter, {90});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(other[i] / one[i], 1, 1e-8);
  rectangle.extent = {1.5, 1};
  const auto wide = views_and_velocity(rectangle, Symmetry::quarter, {90});
  rectangle.extent = {1, 1.5};
  const auto high = views_and_velocity(rectangle, Symmetry::quarter, {90});
  EXPECT_NEAR(wide[0] / high[1], 1, 1e-8);
  EXPECT_NEAR(wide[1] / high[0], 1, 1e-8);
  EXPECT_NEAR(wide[2] / high[2], 1, 1e-8);
  EXPECT_GT(std::abs(wide[0] / wide[1] - 1), 0.05);
}

TEST(SquareChannel, APressureDropGivesTheFlowThatNeedsIt) {
  // The state of a given rate, again from the pressure drop that it has over the same length.
  Problem given = power_law_cell(0.6, 8);
  given.channel_length = 16;
  given.accuracy = 0.05;
  const StationaryState rate = solve_stationary(given);
  Problem again = given;
  again.drive = Drive::pressure_drop;
  again.pressure_gradient = rate.pressure_drop / rate.channel_length;
  const StationaryState drop = solve_stationary(again);
  ASSERT_EQ(drop.outcome.status, Status::converged) << drop.outcome.message;
  // Inlet pressures are means of a polynomial that meets the given one to the error of the mesh.
  EXPECT_NEAR(drop.flow_rate, 1, 1e-4);
  EXPECT_NEAR(drop.shape.deformation / rate.shape.deformation, 1, 1e-3);
  EXPECT_NEAR(drop.additional_pressure_drop / rate.additional_pressure_drop, 1, 2e-2);
}

TEST(SquareChannelSlow, FarTooSoftCellsAreRefusedOnTheCoarseMesh) {
  // The branch of this size ends at 1.02 kPa, where the surface wrinkles; twice as soft a cell is far from it.
  const StationaryState state = solve_stationary(newtonian_cell(0.33, 0.55));
  EXPECT_EQ(state.outcome.status, Status::surface_unstable) << state.outcome.message;
  EXPECT_NEAR(state.outcome.reached, 0.55 / 1.02, 0.05);
  EXPECT_EQ(state.statistics.degree, 3);
}

TEST(SquareChannel, TheCellKeepsItsVolumeAndItsImageDoesNotTell) {
  // The image's body of revolution is 0.2 % smaller at this size; each element keeps its volume.
  Problem problem = power_law_cell(0.6, 1.198);
  problem.accuracy = 2e-2;
  const StationaryState state = solve_stationary(problem);
  ASSERT_EQ(state.outcome.status, Status::converged) << state.outcome.message;
  EXPECT_NEAR(state.relative_volume_change, 0, 1e-5);
  EXPECT_NEAR(state.volume_of_revolution / state.shape.volume, 0.998, 5e-4);
  EXPECT_EQ(state.deformation_side, state.shape.deformation);
  EXPECT_LT(state.deformation_diagonal, 0.92 * state.deformation_side);
}

}  // namespace
}  // namespace rheocyte::square_channel_test
