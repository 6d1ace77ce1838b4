// The outline of a body of revolution as a camera sees it from the side.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// Of outlines that are known by their modes.
inline constexpr int outline_points = 720;

/// The closed polygon (x, y) of the silhouette of the meridian (x, r): a dent at a pole is hidden behind its rim. The
/// first point is not repeated.
Eigen::MatrixX2d silhouette(const Eigen::MatrixX2d& meridian);

/// The polygon with the cosine mode c_2 of this size added to its radius about its centroid, which leaves c_3 alone but
/// for products of modes: an elongation along the flow that the model of the cell does not have.
Eigen::MatrixX2d with_ellipse(const Eigen::MatrixX2d& outline, double mode_2);

}  // namespace rheocyte
