#include "analytic/sphere_in_tube.h"

#include <cassert>
#include <cmath>

#include "analytic/wall_reflection.h"
#include "numeric/dense_solve.h"

namespace rheocyte {
namespace {

using Eigen::ArrayXd;

// All spheres share the wall; its largest reflection costs two milliseconds.
const WallReflection& shared_reflection() {
  static const WallReflection reflection = wall_reflection(functions_for(max_sphere_in_tube));
  return reflection;
}

// n = 2, 4, 6, ...
ArrayXd degrees(int functions) { return 2 * ArrayXd::LinSpaced(functions, 1, functions); }

// Scaled coefficients of the flow (see SphereInTube).
struct Coefficients {
  ArrayXd A, B, C, D;
};

// eq:no-slip: the singular part that cancels a given regular part on the sphere.
Coefficients with_no_slip(const ArrayXd& C, const ArrayXd& D) {
  const ArrayXd n = degrees(static_cast<int>(C.size()));
  return {((2 * n - 3) * C + (2 * n - 1) * D) / 2, -((2 * n - 1) * C + (2 * n + 1) * D) / 2, C, D};
}

// T of eq:reflection with eq:no-slip inserted: what the wall reflects of the regular part (C, D).
Eigen::MatrixXd echo(double lambda, int functions) {
  const auto& wall = shared_reflection();
  const auto n = degrees(functions);
  const Eigen::MatrixXd rows = pow(lambda, n).matrix().asDiagonal();
  const auto block = [&](const Eigen::ArrayXXd& from_A, const Eigen::ArrayXXd& from_B, double row_power, int column) {
    // factors of A_n and B_n in C_n (column 0) and D_n (column 1)
    const ArrayXd A = (2 * n - 3 + 2 * column) / 2 * pow(lambda, n - 1);
    const ArrayXd B = -(2 * n - 1 + 2 * column) / 2 * pow(lambda, n - 3);
    const Eigen::MatrixXd a = from_A.topLeftCorner(functions, functions),
                          b = from_B.topLeftCorner(functions, functions);
    return (std::pow(lambda, row_power) * (rows * (a * A.matrix().asDiagonal() + b * B.matrix().asDiagonal()))).eval();
  };
  Eigen::MatrixXd T(2 * functions, 2 * functions);
  T << block(wall.CA, wall.CB, 0, 0), block(wall.CA, wall.CB, 0, 1),  //
      block(wall.DA, wall.DB, 2, 0), block(wall.DA, wall.DB, 2, 1);
  return T;
}

// Column 0: the undisturbed flow seen from a sphere at rest. Column 1: what a unit velocity of the sphere adds.
Eigen::MatrixX2d incident(double lambda, int functions) {
  Eigen::MatrixX2d flow = Eigen::MatrixX2d::Zero(2 * functions, 2);
  flow(0, 0) = std::pow(lambda, 2);
  flow(1, 0) = 0.4 * std::pow(lambda, 4);
  flow(functions, 0) = -0.4 * std::pow(lambda, 4);
  flow(0, 1) = -std::pow(lambda, 2);
  return flow;
}

// eq:traction
SurfaceModes traction(const Coefficients& flow, double lambda) {
  const ArrayXd n = degrees(static_cast<int>(flow.B.size()));
  const double cube = std::pow(lambda, 3);
  return {-((4 * n - 6) / n * flow.B + (4 * n + 2) / (n - 1) * flow.D) / cube,
          ((6 - 4 * n) * flow.B + (4 * n + 2) * flow.D) / (n * (n - 1)) / cube};
}

// eq:pressure-drop
double pressure_drop(const SurfaceModes& t, double lambda) {
  const auto &N = t.normal, &T = t.tangential;
  return -4 * std::pow(lambda, 4) * ((4 * N(0) + 16 * T(0)) / 15 - (4 * N(1) + 16 * T(1)) / 35);
}

}  // namespace

// The modes fall like q^n, q = tan(asin(lambda) / 2), with a power of n that the ten more cover (measured).
int functions_for(double lambda) {
  const double q = (1 - std::sqrt(1 - lambda * lambda)) / lambda;
  const int max_n = static_cast<int>(std::ceil(std::log(1e-10) / std::log(q))) + 10;
  return (max_n + 1) / 2;
}

SphereInTube sphere_in_tube(double lambda) { return sphere_in_tube(lambda, functions_for(lambda)); }

SphereInTube sphere_in_tube(double lambda, int functions) {
  assert(lambda > 0 && lambda <= max_sphere_in_tube);
  assert(functions >= 2 && functions <= functions_for(max_sphere_in_tube));
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(2 * functions, 2 * functions);
  const Eigen::MatrixX2d x = solve_dense(identity - echo(lambda, functions), incident(lambda, functions));
  const auto flow_of = [&](const Eigen::VectorXd& regular) {
    return with_no_slip(regular.head(functions), regular.tail(functions));
  };
  // The force on the sphere is -4 pi B_2 / lambda (eq:force-free).
  const double held = flow_of(x.col(0)).B(0), towed = flow_of(x.col(1)).B(0);
  SphereInTube sphere;
  sphere.lambda = lambda;
  sphere.velocity = -held / towed;
  sphere.drag_towed = towed / (1.5 * lambda * lambda);
  sphere.drag_held = -held / (1.5 * lambda * lambda);
  const Coefficients flow = flow_of(x.col(0) + sphere.velocity * x.col(1));
  sphere.traction = traction(flow, lambda);
  sphere.pressure_drop = pressure_drop(sphere.traction, lambda);
  sphere.A = flow.A;
  sphere.B = flow.B;
  sphere.C = flow.C;
  sphere.D = flow.D;
  return sphere;
}

}  // namespace rheocyte
