// A session answers as a solver that starts from nothing: in all its numbers, wherever the session comes from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "case/scales.h"
#include "cases.h"
#include "solve/session.h"

namespace rheocyte::session_walk_test {
namespace {

/// Of a number in the units of the problem: what rounding and the tolerance of Newton's method leave.
constexpr double rounding = 1e-9;
/// The same of fields, which are stored in single precision, relative to the greatest value.
constexpr double rounding_of_fields = 2e-6;

/// What was compared on a walk, and what was not the same.
struct Comparison {
  int states = 0, refused = 0, numbers = 0, beyond = 0;
  double greatest_over_stated = 0;

  void check(const std::string& name, double warm, double anew, double stated) {
    ++numbers;
    if (std::isnan(warm) && std::isnan(anew)) return;
    const double difference = std::abs(warm - anew), allowed = rounding * std::max(1.0, std::abs(anew));
    if (difference > allowed) greatest_over_stated = std::max(greatest_over_stated, difference / stated);
    if (difference <= std::max(allowed, stated)) return;
    ++beyond;
    ADD_FAILURE() << name << ": " << warm << " in a session, " << anew << " anew, stated error " << stated;
  }
};

void compare_numbers(const StationaryState& warm, const StationaryState& anew, Comparison& all) {
  for (const StateMeasure& measure : state_measures) {
    // On different resolutions both are right within their errors.
    const double stated = std::max(measure.value(warm.errors), measure.value(anew.errors));
    all.check(std::string(measure.name), measure.value(warm), measure.value(anew), stated);
    EXPECT_EQ(std::isnan(measure.value(warm.errors)), std::isnan(measure.value(anew.errors))) << measure.name;
  }
}

/// Of the same resolution: each value differs by no more than the fields' rounding, and by the deformation's error.
template <class Field>
void compare_field(const char* name, const Field& warm, const Field& anew, double error) {
  ASSERT_EQ(warm.size(), anew.size()) << name;
  const double size = std::max(1e-30, double(anew.cwiseAbs().maxCoeff()));
  EXPECT_LT((warm - anew).cwiseAbs().maxCoeff() / size, std::max(rounding_of_fields, error)) << name;
}

void compare_fields(const StationaryState& warm, const StationaryState& anew) {
  const Scales units;
  const SampledFields a = warm.sample_fields(units, 500), b = anew.sample_fields(units, 500);
  compare_field("pressure", a.pressure_Pa, b.pressure_Pa, warm.estimated_error);
  compare_field("velocity", a.velocity_m_per_s, b.velocity_m_per_s, warm.estimated_error);
  compare_field("place", a.point_um, b.point_um, warm.estimated_error);
  compare_field("stress", a.stress_Pa, b.stress_Pa, warm.estimated_error);
  compare_field("tension", warm.surface.tension, anew.surface.tension, warm.estimated_error);
}

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

/// A change of one or two parameters, mostly so small that a kept state is a start.
void change(std::mt19937& random, Problem& problem) {
  const auto scale = [&](double& number) { number *= std::exp(uniform(random, -0.15, 0.15)); };
  for (int i = uniform(random, 0, 1) < 0.3 ? 0 : 1; i < 2; ++i) {
    switch (int(uniform(random, 0, 10))) {
      case 0: scale(problem.bulk.shear_modulus); break;
      case 1: scale(problem.cortex.tension); break;
      case 2: scale(problem.cortex.modulus); break;
      case 3: problem.bulk.rest_stretch = problem.cortex.rest_stretch = uniform(random, 1, 1.08); break;
      case 4: problem.bulk.axial_tension = uniform(random, 0, 0.1) * problem.bulk.shear_modulus; break;
      case 5: problem.liquid.reynolds = uniform(random, 0, 0.3); break;
      case 6:
        if (problem.liquid.law == LiquidLaw::power_law) problem.liquid.exponent = uniform(random, 0.6, 0.9);
        break;
      case 7:
        if (problem.section == Section::rectangle) problem.extent.width = uniform(random, 1, 1.3);
        if (problem.drive == Drive::pressure_drop) problem.channel_length = uniform(random, 0, 12);
        break;
      default: scale(problem.radius_ratio);
    }
  }
  problem.radius_ratio = std::clamp(problem.radius_ratio, 0.25, 0.8);
}

/// Another liquid or another drive; the next state starts from the beginning.
void change_kind(std::mt19937& random, Problem& problem) {
  problem.liquid = {};
  const double liquid = uniform(random, 0, 1);
  if (liquid < 0.3) problem.liquid = {.law = LiquidLaw::power_law, .exponent = 0.7};
  if (liquid > 0.7) problem = test::in_carreau_liquid(problem, 0.6);
  problem.cortex = {};
  if (uniform(random, 0, 1) < 0.5) problem.cortex = {CortexLaw::neo_hookean_reference, 2, 0.5};
  const bool by_pressure = uniform(random, 0, 1) < 0.3;
  problem.drive = by_pressure && problem.section == Section::tube ? Drive::pressure_drop : Drive::rate;
  problem.channel_length = 0;
}

/// A walk of a session by so many changes, with a solution from the beginning of each.
Comparison walk(Problem problem, int steps, unsigned seed) {
  std::mt19937 random(seed);
  Session session;
  Comparison all;
  for (int i = 0; i < steps; ++i) {
    SCOPED_TRACE(i);
    Problem next = problem;
    i % 25 == 0 ? change_kind(random, next) : change(random, next);
    const StationaryState warm = session.solve(next), anew = solve_stationary(next);
    if (warm.outcome.status != Status::converged || anew.outcome.status != Status::converged) {
      EXPECT_EQ(warm.outcome.status, anew.outcome.status);
      ++all.refused;
      continue;  // from the state before
    }
    problem = next;
    ++all.states;
    compare_numbers(warm, anew, all);
    const bool is_alike = warm.statistics.unknowns == anew.statistics.unknowns;
    if (is_alike) compare_fields(warm, anew);
  }
  std::printf("%d states, %d of them warm, %d refused; %d numbers, %d beyond; at most %.2g of the stated error\n",
              all.states, session.warm_starts(), all.refused, all.numbers, all.beyond, all.greatest_over_stated);
  EXPECT_GT(session.warm_starts(), steps / 2);
  return all;
}

Problem cell_in(Section section, double accuracy) {
  Problem problem = test::problem({6, 4.58, 1}, accuracy);
  problem.section = section;
  if (section == Section::rectangle) problem.extent = {1.2, 1};
  return problem;
}

TEST(SessionWalk, InATubeAllNumbersAreThoseOfASolutionAnew) {
  // Radius, moduli, tensions, liquid, inertia, drive and length by turns; differences within the stated errors.
  const Comparison all = walk(cell_in(Section::tube, 1e-3), 30, 1);
  EXPECT_GT(all.states, 25);
  EXPECT_EQ(all.beyond, 0);
}

TEST(SessionWalk, InASquareAllNumbersAreThoseOfASolutionAnew) {
  // As in the tube, without a given pressure drop.
  const Comparison all = walk(cell_in(Section::square, 5e-2), 6, 20);
  EXPECT_EQ(all.states, 6);
  EXPECT_EQ(all.beyond, 0);
}

TEST(SessionWalk, ProblemsAreAlikeOnlyWhereTheirMeshesAre) {
  // Where a given length is more than the least one, which grows with the radius, the mesh has elements more.
  for (const Section section : {Section::tube, Section::square}) {
    Problem shorter = cell_in(section, 1e-3);
    shorter.channel_length = is_duct(section) ? 7.6 : 7.2;
    const Geometry geometry = solver_geometry(shorter);
    const Resolution& coarse = geometry.ways.front().resolution;
    const auto unknowns = [&](const Problem& problem) {
      return geometry.make(problem, coarse)->system().sphere().size();
    };
    int alike = 0, different = 0;
    for (const double radius : {0.5, 0.52, 0.54, 0.56, 0.58, 0.6}) {
      Problem other = shorter;
      other.radius_ratio = radius;
      const bool is_alike = geometry.is_alike(shorter, other, coarse);
      EXPECT_EQ(is_alike, unknowns(shorter) == unknowns(other)) << radius;
      ++(is_alike ? alike : different);
    }
    EXPECT_GT(alike, 0);
    EXPECT_GT(different, 0);
  }
}

TEST(SessionWalkSlow, ThreeHundredStepsInTubeSquareAndRectangle) {
  // As above.
  int beyond = 0;
  for (unsigned seed = 1; seed <= 4; ++seed)
    beyond += walk(cell_in(Section::tube, seed % 2 ? 1e-3 : 1e-4), 50, 10 + seed).beyond;
  beyond += walk(cell_in(Section::square, 5e-2), 50, 20).beyond;
  beyond += walk(cell_in(Section::rectangle, 5e-2), 50, 21).beyond;
  EXPECT_EQ(beyond, 0);
}

}  // namespace
}  // namespace rheocyte::session_walk_test
