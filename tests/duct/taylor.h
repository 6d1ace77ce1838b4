// The tangent of a duct's system against its residual, and its factors against the tangent.
#pragma once
#include <cmath>
#include <random>
#include <utility>

#include "duct/duct_system.h"

namespace rheocyte {

inline VectorXd random_direction(Eigen::Index size) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return VectorXd::Zero(size).unaryExpr([&](double) { return uniform(engine); });
}

/// Exponent of h in residual(x + h d) - residual(x) - h K d between steps of 1e-2 and 1e-3 of the direction. Random
/// directions have a large K d, of which rounding of entries in single precision leaves 1e-7: the second order is well
/// above that at these steps, so that the slope shows the derivative itself.
inline double taylor_slope(DuctSystem& system, const Media& media, const VectorXd& unknowns) {
  const VectorXd d = 0.1 * random_direction(unknowns.size());
  const VectorXd g = system.apply_tangent(media, unknowns, d);
  const VectorXd r = system.residual(media, unknowns).value;
  const auto remainder = [&](double h) { return (system.residual(media, unknowns + h * d).value - r - h * g).norm(); };
  return std::log10(remainder(1e-2) / remainder(1e-3));
}

/// What solutions with the factors of the state leave of a right-hand side, relative: of the first one, and after two
/// corrections.
inline std::pair<double, double> left_by_factors(DuctSystem& system, const Media& media, const VectorXd& unknowns) {
  const VectorXd g = random_direction(unknowns.size());
  const auto rest = [&](const VectorXd& d) -> VectorXd { return g - system.apply_tangent(media, unknowns, d); };
  VectorXd d = system.solve(g);
  const double first = rest(d).norm() / g.norm();
  for (int i = 0; i < 2; ++i) d += system.solve(rest(d));
  return {first, rest(d).norm() / g.norm()};
}

}  // namespace rheocyte
