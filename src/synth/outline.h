// The outline of a body of revolution as a camera sees it from the side.
#pragma once
#include <Eigen/Core>

#include "numeric/cell_random.h"

namespace rheocyte {

/// Of outlines that are known by their modes.
inline constexpr int outline_points = 720;

/// The closed polygon (x, y) of the silhouette of the meridian (x, r): a dent at a pole is hidden behind its rim. The
/// first point is not repeated.
Eigen::MatrixX2d silhouette(const Eigen::MatrixX2d& meridian);

/// The polygon with the cosine mode c_2 of this size added to its radius about its centroid, which leaves c_3 alone but
/// for products of modes: an elongation along the flow that the model of the cell does not have.
Eigen::MatrixX2d with_ellipse(const Eigen::MatrixX2d& outline, double mode_2);

/// Errors of a segmentation: how far the outline is off, and over which length it is off alike.
struct OutlineNoise {
  double deviation = 0;    ///< standard deviation of the displacement along the normal; 0: none
  double correlation = 1;  ///< standard deviation of the Gaussian that smooths it along the outline
};

/// The same polygon at equal distances along its length, displaced. Lengths in the unit of the outline.
Eigen::MatrixX2d displaced(const Eigen::MatrixX2d& outline, const OutlineNoise& noise, CellRandom& random);

}  // namespace rheocyte
