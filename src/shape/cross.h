#pragma once

#include <Eigen/Core>

namespace rheocyte {

/// Twice the signed area of the triangle with corners 0, a, b.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace rheocyte
