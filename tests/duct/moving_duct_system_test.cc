#include "duct/moving_duct_system.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "duct/cell_moments.h"
#include "taylor.h"

namespace rheocyte::moving_duct_system_test {
namespace {

/// A coarse duct whose wall is somewhere on the way, with a cell that moves.
struct SmallDuct {
  explicit SmallDuct(Section section = Section::square, Symmetry symmetry = Symmetry::quarter)
      : space(DuctMesh(DuctGeometry(section, 0.6), {.along = 2, .layers = 1, .axial = 1}, symmetry), 2, Liquid{}),
        system(space) {}

  /// A wall of half widths 1 + slope x.
  VectorXd move_wall(double slope, const VectorXd& unknowns) {
    VectorXd outward = space.wall_motion([&](double x) { return 1 + 0.2 + slope * x; }, unknowns);
    space.move_nodes(outward);
    return outward;
  }

  DuctSpace space;
  MovingDuctSystem system;
};

Media media() {
  return {.liquid = {},
          .bulk = {.law = BulkLaw::mooney_rivlin, .c1_fraction = 0.3, .viscosity = 2},
          .cortex = {CortexLaw::neo_hookean, 2, 0.3, 0}};
}

/// Some flow round a cell that is deformed by a tenth of its radius.
VectorXd deformed_state(MovingDuctSystem& system, const Media& law) {
  VectorXd state = system.sphere();
  state += (system.linearise(law, state), system.solve(-system.residual(law, state).value));
  system.scale_displacement(0.06 / system.largest_displacement(state), state);
  return state;
}

TEST(MovingDuctSystem, TheTaylorRemainderOfTheTangentHasSlopeTwo) {
  // With a viscosity beside the solid and in series with a spring, in a slanted wall.
  for (const double branch_modulus : {0.0, 3.0}) {
    SmallDuct duct;
    Media law = media();
    law.bulk.branch_modulus = branch_modulus;
    const VectorXd state = deformed_state(duct.system, law);
    Motion motion{3, -2.7 * state, {}, duct.move_wall(-0.05, state), {}};
    if (branch_modulus > 0) motion.branch = -2.5 * duct.system.unstressed_branch();
    duct.system.set_motion(motion);
    EXPECT_NEAR(taylor_slope(duct.system, law, state), 2, 0.05) << branch_modulus;
  }
}

TEST(MovingDuctSystem, OffTheAxisItsTangentIsThatOfItsResidualToo) {
  // Of a cell that turns while its shape changes and it drifts, in a slanted wall.
  DuctSpace space(DuctMesh(DuctGeometry(DuctShape{.radius = 0.4, .offset = 0.2}),
                           {.along = 2, .layers = 1, .axial = 1, .across = 2}, Symmetry::half),
                  2, Liquid{});
  for (const double branch_modulus : {0.0, 3.0}) {
    MovingDuctSystem system(space);
    Media law = media();
    VectorXd state = deformed_state(system, law);
    state(space.spin()) += 1;
    const VectorXd outward = space.wall_motion([](double x) { return 1.2 - 0.05 * x; }, state);
    space.move_nodes(outward, 0.1);
    Motion motion{3, -2.7 * state, {}, outward, {}, 0.9 * state};
    law.bulk.branch_modulus = branch_modulus;
    if (branch_modulus > 0) {
      motion.branch = -2.5 * system.unstressed_branch();
      motion.turning_branch = system.unstressed_branch() + 0.1 * random_direction(system.unstressed_branch().size());
    }
    system.set_motion(motion);
    EXPECT_NEAR(taylor_slope(system, law, state), 2, 0.05) << branch_modulus;
  }
}

/// A small sphere far from walls in simple shear, started at rest, in steps of second order.
struct ShearedSphere {
  static constexpr double rate = 1, modulus = 100, viscosity = 100, a = 0.1, step = 0.05;

  explicit ShearedSphere(double branch_modulus)
      : space(DuctMesh(DuctGeometry(DuctShape{.radius = a}), {.along = 2, .axial = 1, .across = 2}, Symmetry::half), 3,
              GivenFlow([](const Eigen::Vector2d& at) { return rate * at(0); })),
        system(space),
        law{.bulk = {.shear_modulus = modulus, .viscosity = viscosity, .branch_modulus = branch_modulus}},
        last(system.sphere()),
        before(last) {
    if (branch_modulus > 0) branch_last = branch_before = system.unstressed_branch();
  }

  void advance() {
    const bool is_first = steps++ == 0;
    const auto history = [&](const VectorXd& now, const VectorXd& earlier) -> VectorXd {
      if (is_first) return -now / step;
      return (-2 * now + 0.5 * earlier) / step;
    };
    Motion motion{(is_first ? 1 : 1.5) / step, history(last, before), {}};
    motion.turning = 2 * last - before;
    if (branch_last.size() > 0) {
      motion.branch = history(branch_last, branch_before);
      motion.turning_branch = 2 * branch_last - branch_before;
    }
    system.set_motion(motion);
    VectorXd state = motion.turning;
    for (int k = 0; k < 2; ++k)
      state += (system.linearise(law, state), system.solve(-system.residual(law, state).value));
    before = std::exchange(last, state);
    if (branch_last.size() > 0) branch_before = std::exchange(branch_last, system.branch_metric(law.bulk, state));
  }

  /// Of the shear plane: half of the difference of its diagonal components, and the one beside it.
  std::complex<double> strain() const {
    const Eigen::Matrix3d second = 5 / (a * a) * cell_moments(space, system.element(), last).second;
    return {(second(0, 0) - second(1, 1)) / 4, second(0, 1) / 2};
  }

  DuctSpace space;
  MovingDuctSystem system;
  Media law;
  VectorXd last, before, branch_last, branch_before;
  int steps = 0;
};

TEST(MovingDuctSystem, InSimpleShearAViscoelasticSphereDeformsAndTurnsAsInTheExactSolution) {
  // Of small strains A, seen in a frame that turns at half the shear rate, dA/dt = s (A_equal - A) with the rate s of
  // eq:sphere-rate and A_equal of the elastic sphere (OffAxis.InSimpleShear...). With a relaxation as slow as the shear
  // the long axis is carried on by half a radian. Walls at ten radii, second order and steps leave a per cent.
  ShearedSphere sphere(0);
  constexpr double modulus = ShearedSphere::modulus, rate = ShearedSphere::rate;
  const std::complex<double> relaxation(modulus / (ShearedSphere::viscosity + 1.5), rate);
  for (int i = 1; i <= 40; ++i) {
    sphere.advance();
    if (i % 10 != 0) continue;
    const std::complex<double> exact = std::complex<double>(0, 1.25 * rate / modulus * relaxation.real()) / relaxation *
                                       (1.0 - std::exp(-relaxation * (i * ShearedSphere::step)));
    EXPECT_NEAR(std::abs(sphere.strain() - exact) / std::abs(exact), 0, 0.02) << i * ShearedSphere::step;
    EXPECT_NEAR(sphere.last(sphere.space.spin()), -rate / 2, 0.02 * rate);
  }
}

TEST(MovingDuctSystem, InSimpleShearASphereWithABranchInSeriesRemembersWhatTurnsWithIt) {
  // The same with mu A + q + 3/2 eta0 dA/dt = mu A_equal, q + tau dq/dt = eta1 dA/dt in the frame that turns: what the
  // branch holds was made a relaxation ago, when the material lay another way.
  constexpr double modulus = ShearedSphere::modulus, rate = ShearedSphere::rate, branch_modulus = 200, pieces = 2000;
  ShearedSphere sphere(branch_modulus);
  const double time = ShearedSphere::viscosity / branch_modulus, dt = ShearedSphere::step / pieces;
  std::complex<double> A = 0, q = 0;
  const std::complex<double> turns(0, rate), driven(0, 1.25 * rate);
  for (int i = 1; i <= 40; ++i) {
    sphere.advance();
    for (int k = 0; k < int(pieces); ++k) {
      // By trapezia, of linear equations.
      const auto slope = [&](std::complex<double> strain, std::complex<double> stress) {
        const std::complex<double> rate_of_strain = (driven - modulus * strain - stress) / 1.5;
        return std::pair{rate_of_strain - turns * strain,
                         (ShearedSphere::viscosity * rate_of_strain - stress) / time - turns * stress};
      };
      const auto [A_1, q_1] = slope(A, q);
      const auto [A_2, q_2] = slope(A + dt * A_1, q + dt * q_1);
      A += dt / 2 * (A_1 + A_2);
      q += dt / 2 * (q_1 + q_2);
    }
    if (i % 10 != 0) continue;
    EXPECT_NEAR(std::abs(sphere.strain() - A) / std::abs(A), 0, 0.02) << i * ShearedSphere::step;
  }
}

TEST(MovingDuctSystem, ABranchThatForgetsNothingIsCarriedByTheMaterialThatTurns) {
  // A metric that grows evenly along each direction: in a short step it goes where eq:branch-turning takes it.
  const DuctSpace space(DuctMesh(DuctGeometry(DuctShape{.radius = 0.4, .offset = 0.2}),
                                 {.along = 2, .layers = 1, .axial = 1, .across = 2}, Symmetry::half),
                        2, Liquid{});
  MovingDuctSystem system(space);
  const Bulk forgets_nothing{.viscosity = 1e12, .branch_modulus = 1};
  using Components = Eigen::Matrix<double, 6, 1>;  // xx, xy, xz, yy, yz, zz
  Eigen::Matrix<double, 6, 4> even;                // of 1, x, y, z
  for (int i = 0; i < even.size(); ++i) even(i) = std::sin(i + 1);
  std::vector<DuctPoint> places;  // of the quadrature, from the cell's centre
  for (std::size_t e = 0; e < space.elements().size(); ++e) {
    if (space.elements()[e].liquid) continue;
    const auto& nodes = space.nodes().of_element[e];
    MatrixXd nodal(nodes.size(), 3);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      nodal.row(Eigen::Index(k)) = (space.node_points()[std::size_t(nodes[k])] - DuctPoint(0, 0.2, 0)).transpose();
    const MatrixXd at_points = system.element().at_points(0, nodal);
    for (Eigen::Index q = 0; q < at_points.rows(); ++q) places.emplace_back(at_points.row(q).transpose());
  }
  const auto at = [&](const DuctPoint& X) -> Components { return even * Eigen::Vector4d(1, X(0), X(1), X(2)); };
  const auto tensor = [](const Components& a) {
    return Eigen::Matrix3d{{a(0), a(1), a(2)}, {a(1), a(3), a(4)}, {a(2), a(4), a(5)}};
  };
  VectorXd metric(6 * std::ssize(places));
  for (std::size_t q = 0; q < places.size(); ++q) metric.segment<6>(6 * Eigen::Index(q)) = at(places[q]);
  constexpr double step = 1e-4, spin = 0.7;
  VectorXd state = system.sphere();
  state(space.spin()) = spin;
  Motion motion{1 / step, -state / step, {}};
  motion.branch = -metric / step;
  motion.turning = state;
  motion.turning_branch = metric;
  system.set_motion(motion);
  const VectorXd found = system.branch_metric(forgets_nothing, state);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(spin * step, DuctPoint::UnitZ()).toRotationMatrix();
  for (std::size_t q = 0; q < places.size(); ++q) {
    const Eigen::Matrix3d expected = turn * tensor(at(turn.transpose() * places[q])) * turn.transpose();
    EXPECT_LT((tensor(found.segment<6>(6 * Eigen::Index(q))) - expected).norm(), 1e-7);
  }
}

TEST(MovingDuctSystem, AnEvenPressureDoesNotMoveTheMeshOfAFlowingInterior) {
  // As in the tube: wherever the nodes inside are, the forces on them vanish to rounding against those on the surface.
  const DuctMesh mesh(DuctGeometry(Section::square, 0.6), {}, Symmetry::quarter);
  for (const int degree : {2, 5}) {
    const DuctSpace space(mesh, degree, Liquid{}, Drive::rate, Interior::flowing);
    MovingDuctSystem moving(space);
    std::vector<bool> in_cell(space.unknowns(), false), in_liquid(space.unknowns(), false);
    VectorXd x = moving.sphere();
    for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
      const bool is_cell = mesh.elements()[e].in_cell();
      for (const int node : space.nodes().of_element[e])
        for (const int c : {0, 1, 2})
          if (const int u = space.displacement(node, c); u >= 0) (is_cell ? in_cell : in_liquid)[u] = true;
      if (is_cell) x(space.pressure(int(e), 0)) = 1;
    }
    const VectorXd random = 1e-4 * random_direction(space.unknowns());
    for (int u = 0; u < space.unknowns(); ++u)
      if (in_cell[u] && !in_liquid[u]) x(u) = random(u);
    const auto [forces, min_det] = moving.residual({.liquid = {}, .bulk = {.shear_modulus = 0}, .cortex = {}}, x);
    EXPECT_GT(min_det, 0);
    double inside = 0, on_surface = 0;
    for (int u = 0; u < space.unknowns(); ++u)
      if (in_cell[u]) {
        double& greatest = in_liquid[u] ? on_surface : inside;
        greatest = std::max(greatest, std::abs(forces(u)));
      }
    EXPECT_LT(inside, 1e-12 * on_surface) << degree;
  }
}

TEST(MovingDuctSystem, AtRestItsResidualIsThatOfTheStationarySystem) {
  // To rounding, with whatever viscosity, on the mesh of a wall that is not straight.
  SmallDuct duct;
  const Media law = media();
  const VectorXd state = deformed_state(duct.system, law);
  const VectorXd outward = duct.move_wall(-0.05, state);
  duct.system.set_motion({0, 0 * state, {}, outward, {}});
  DuctSystem stationary(duct.space);
  const VectorXd expected = stationary.residual(law, state).value;
  EXPECT_LT((duct.system.residual(law, state).value - expected).norm(), 1e-12 * expected.norm());
}

TEST(MovingDuctSystem, AnUnstressedBranchOfACellAtRestStaysSo) {
  SmallDuct duct;
  const Media law{.bulk = {.viscosity = 2, .branch_modulus = 3}};
  const VectorXd sphere = 0 * duct.system.sphere(), unstressed = duct.system.unstressed_branch();
  Motion motion{5, sphere, {}, {}, -5 * unstressed};  // d/dt = 0
  duct.system.set_motion(motion);
  EXPECT_LT((duct.system.branch_metric(law.bulk, sphere) - unstressed).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(MovingDuctSystem, NodesOnTheWallStayOnItAndThoseOfTheCellAndTheAxisStayWhereTheyAre) {
  // In a planar funnel along y alone, in a round one in both directions.
  for (const Section section : {Section::square, Section::tube}) {
    SmallDuct duct(section);
    const std::vector<DuctPoint> before = duct.space.node_points();
    const auto wall = [](double x) { return 1.2 - 0.05 * x; };
    duct.move_wall(-0.05, VectorXd::Zero(duct.space.unknowns()));
    for (int i = 0; i < duct.space.nodes().count; ++i) {
      const DuctPoint &x = before[i], &now = duct.space.node_points()[i];
      EXPECT_EQ(now(0), x(0));
      if (section == Section::square) {
        EXPECT_EQ(now(2), x(2));
        if (std::abs(x(1) - 1) < 1e-9) {
          EXPECT_NEAR(now(1), wall(x(0)), 1e-12);
        }
      } else if (duct.space.mesh().geometry().is_wall(x)) {
        EXPECT_NEAR(now.tail<2>().norm(), wall(x(0)), 1e-9);
      }
      if (x(1) == 0) {
        EXPECT_EQ(now(1), 0);
      }
      if (duct.space.displacement(i, 2) >= 0) {
        EXPECT_EQ(now, x);
      }
    }
  }
}

}  // namespace
}  // namespace rheocyte::moving_duct_system_test
