// What an elongation that the model does not have does to area and asymmetry of an outline (docs/theory-extract.md,
// sec. "Shapes").
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// A smooth outline: what its c_2 has beyond that of the model's cell of the same area and c_3, |c_3|, and ln(area) in
/// units of half the channel's width, squared.
struct LongOutline {
  double excess = 0, mode_3 = 0, log_area = 0;
};

/// Coefficients of excess^i |c_3|^j r^k, i from 1 on, r the radius of a circle of this area.
using EllipseLaw = Eigen::Matrix<double, 18, 1>;
using EllipseTerms = Eigen::Matrix<double, 1, 18>;
EllipseTerms ellipse_terms(const LongOutline&);

/// To be added to ln|c_3| and to ln(area) of an outline, so that they become those of the cell of the model to which
/// an ellipse was added. Beyond what the law was fitted to the nearest counts.
struct WithoutEllipse {
  double log_mode_3 = 0, log_area = 0;
  double deviation = 0;  ///< standard deviation of what the law leaves of ln|c_3|
};
WithoutEllipse without_ellipse(const LongOutline&);

}  // namespace rheocyte
