// Axisymmetric fields on a sphere as Legendre modes.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// The field f_r = sum_l normal_l P_l(cos theta), f_theta = sum_l tangential_l dP_l/dtheta on a sphere, theta from the
/// flow direction. Entry j belongs to l = 2 j + 1: Stokes flow in a straight tube excites odd modes only.
struct SurfaceModes {
  Eigen::ArrayXd normal, tangential;

  int size() const { return static_cast<int>(normal.size()); }
};

}  // namespace rheocyte
