// How the cells of a recording with bulk, cortex and tension are distributed (docs/theory-populations.md, sec.
// "Several moduli").
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "infer/cells_at_rest.h"

namespace rheocyte {

/// ln(r0 / um), ln of S = E + E2D / r0 (kPa), and the fraction of the cortex in S are normally distributed; so is the
/// tension of the cortex over E2D and that of the liquid along the flow, each by itself. Fraction and tensions are not
/// taken by their logarithms: what is small is then told with a symmetric error.
enum class CombinedParameter {
  log_radius,
  log_stiffness,
  cortex_fraction,
  tension_ratio,
  axial_tension,  ///< over the wall's shear stress
  log_radius_spread,
  stiffness_by_radius,
  log_stiffness_spread,
  fraction_by_radius,
  fraction_by_stiffness,
  log_fraction_spread,
  log_ratio_spread,
  log_axial_spread,
  count
};
inline constexpr int combined_parameters = int(CombinedParameter::count), combined_numbers = 3;
using CombinedVector = Eigen::Matrix<double, combined_parameters, 1>;

/// Columns of the root of the covariance of the three are parameters, so that it always is one.
struct CombinedLaw {
  Eigen::Vector3d mean;
  double tension_ratio = 0, ratio_spread = 0, axial_tension = 0, axial_spread = 0;
  Eigen::Matrix3d root = Eigen::Matrix3d::Zero();  ///< covariance = root * root^T

  static CombinedLaw of(const CombinedVector& q) {
    CombinedLaw law;
    law.mean = q.head<combined_numbers>();
    law.tension_ratio = q(3), law.axial_tension = q(4), law.ratio_spread = std::exp(q(11)),
    law.axial_spread = std::exp(q(12));
    law.root << std::exp(q(5)), 0, 0, q(6), std::exp(q(7)), 0, q(8), q(9), std::exp(q(10));
    return law;
  }
  CombinedVector parameters() const {
    CombinedVector q;
    q << mean, tension_ratio, axial_tension, std::log(root(0, 0)), root(1, 0), std::log(root(1, 1)), root(2, 0),
        root(2, 1), std::log(root(2, 2)), std::log(ratio_spread), std::log(axial_spread);
    return q;
  }
  double spread(int number) const { return root.row(number).norm(); }
};

/// ln of what users ask for: S (kPa), the effective modulus (kPa), E (kPa), E2D (mN/m), the tension of the cortex
/// (mN/m), and that of the liquid over the wall's shear stress. NaN where the mean cell has none.
struct CombinedLogs {
  double stiffness = 0, effective = 0, young = 0, cortex = 0, tension = 0, axial = 0;
};
/// Means over the cells, to the second order of the spreads.
CombinedLogs log_means(const CombinedLaw& law, const CellsAtRest& cells);
/// Slopes of one of these by the parameters.
CombinedVector slopes_of_mean(const CombinedVector& parameters, const CellsAtRest& cells, double CombinedLogs::*log);
/// Standard deviations between cells, to the first order.
CombinedLogs log_spreads(const CombinedLaw& law, const CellsAtRest& cells);

}  // namespace rheocyte
