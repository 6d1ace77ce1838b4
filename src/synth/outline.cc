#include "synth/outline.h"

#include <algorithm>

#include "shape/outline_shape.h"

namespace rheocyte {

Eigen::MatrixX2d silhouette(const Eigen::MatrixX2d& meridian) {
  const Eigen::Index n = meridian.rows();
  Eigen::MatrixX2d visible = meridian;
  Eigen::Index widest = 0;
  meridian.col(1).maxCoeff(&widest);
  for (Eigen::Index i = widest; i-- > 0;) visible(i, 0) = std::max(visible(i, 0), visible(i + 1, 0));
  for (Eigen::Index i = widest + 1; i < n; ++i) visible(i, 0) = std::min(visible(i, 0), visible(i - 1, 0));
  Eigen::MatrixX2d outline(2 * n - 2, 2);
  outline.topRows(n) = visible;
  for (Eigen::Index i = 1; i < n - 1; ++i) outline.row(n - 1 + i) << visible(n - 1 - i, 0), -visible(n - 1 - i, 1);
  return outline;
}

Eigen::MatrixX2d with_ellipse(const Eigen::MatrixX2d& outline, double mode_2) {
  if (mode_2 == 0) return outline;
  const OutlineShape shape = outline_shape(outline);
  const Eigen::RowVector2d centroid(shape.x, shape.y);
  Eigen::MatrixX2d moved = outline;
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const Eigen::RowVector2d from = outline.row(i) - centroid, along = from.normalized();
    const double cosine_of_twice = along.x() * along.x() - along.y() * along.y();
    moved.row(i) += shape.mean_radius * mode_2 * cosine_of_twice * along;
  }
  return moved;
}

}  // namespace rheocyte
