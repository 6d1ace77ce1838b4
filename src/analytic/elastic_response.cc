#include "analytic/elastic_response.h"

#include <Eigen/LU>
#include <cassert>

namespace rheocyte {
namespace {

SurfaceModes same_size(const SurfaceModes& modes) {
  assert(modes.size() > 0 && modes.normal.size() == modes.tangential.size());
  return {Eigen::ArrayXd::Zero(modes.size()), Eigen::ArrayXd::Zero(modes.size())};
}

}  // namespace

SurfaceModes solid_response(const SurfaceModes& traction) {
  SurfaceModes displacement = same_size(traction);
  displacement.tangential(0) = traction.tangential(0) / 3;  // eq:rigid-mode: w_1 = 0
  for (int j = 1; j < traction.size(); ++j) {
    const double n = 2 * (j + 1);
    Eigen::Matrix2d stress;                                // of the regular solutions r^n, r^(n+2)
    stress << 2 * (n - 2), 2 * n - (4 * n + 2) / (n - 1),  //
        (2 * n - 4) / (n - 1), (2 * n + 2) / n;
    const Eigen::Vector2d CD = stress.inverse() * Eigen::Vector2d(traction.normal(j), traction.tangential(j));
    displacement.normal(j) = CD.sum();
    displacement.tangential(j) = (n * CD(0) + (n + 2) * CD(1)) / (n * (n - 1));
  }
  return displacement;
}

SurfaceModes shell_response(const SurfaceModes& traction, double tension_ratio) {
  constexpr double nu = 0.5, K = 1 / (1 - nu * nu);
  SurfaceModes displacement = same_size(traction);
  displacement.tangential(0) = -traction.normal(0) / (2 * (1 + nu) * K);  // eq:rigid-mode: w_1 = 0
  for (int j = 1; j < traction.size(); ++j) {
    const double l = 2 * j + 1, L = l * (l + 1);
    Eigen::Matrix2d balance;
    balance << (1 + nu) * K, -(L - 1 + nu) * K,  //
        2 * (1 + nu) * K + tension_ratio * (L - 2), -(1 + nu) * K * L;
    const Eigen::Vector2d wv = balance.inverse() * Eigen::Vector2d(-traction.tangential(j), traction.normal(j));
    displacement.normal(j) = wv(0);
    displacement.tangential(j) = wv(1);
  }
  return displacement;
}

}  // namespace rheocyte
