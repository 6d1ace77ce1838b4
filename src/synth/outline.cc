#include "synth/outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shape/outline_shape.h"

namespace rheocyte {

namespace {

// Points at equal distances along the closed polygon.
Eigen::MatrixX2d resampled(const Eigen::MatrixX2d& outline, Eigen::Index count) {
  const Eigen::Index n = outline.rows();
  std::vector<double> length{0};
  for (Eigen::Index i = 0; i < n; ++i)
    length.push_back(length.back() + (outline.row((i + 1) % n) - outline.row(i)).norm());
  Eigen::MatrixX2d points(count, 2);
  Eigen::Index piece = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double place = length.back() * static_cast<double>(k) / static_cast<double>(count);
    while (length[static_cast<std::size_t>(piece) + 1] < place) ++piece;
    const double start = length[static_cast<std::size_t>(piece)], end = length[static_cast<std::size_t>(piece) + 1];
    const double fraction = end > start ? (place - start) / (end - start) : 0;
    points.row(k) = (1 - fraction) * outline.row(piece) + fraction * outline.row((piece + 1) % n);
  }
  return points;
}

// Numbers round the outline with unit variance, smoothed with a Gaussian of `width` points.
std::vector<double> smooth_noise(int count, double width, CellRandom& random) {
  std::vector<double> white(static_cast<std::size_t>(count)), smooth(white.size(), 0);
  for (double& value : white) value = random.normal();
  const int reach = std::min(static_cast<int>(std::ceil(4 * width)), count / 2);
  double squares = 0;
  std::vector<double> kernel;
  for (int j = -reach; j <= reach; ++j) kernel.push_back(std::exp(-0.5 * (j / width) * (j / width)));
  for (const double weight : kernel) squares += weight * weight;
  for (int i = 0; i < count; ++i)
    for (int j = -reach; j <= reach; ++j)
      smooth[static_cast<std::size_t>(i)] +=
          kernel[static_cast<std::size_t>(j + reach)] * white[static_cast<std::size_t>((i + j + count) % count)];
  for (double& value : smooth) value /= std::sqrt(squares);
  return smooth;
}

}  // namespace

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

Eigen::MatrixX2d displaced(const Eigen::MatrixX2d& outline, const OutlineNoise& noise, CellRandom& random) {
  if (!(noise.deviation > 0)) return outline;
  constexpr int count = 512;
  const Eigen::MatrixX2d even = resampled(outline, count);
  const double step = (even.row(1) - even.row(0)).norm();
  const auto offset = smooth_noise(count, std::max(noise.correlation / step, 0.5), random);
  Eigen::MatrixX2d moved(count, 2);
  for (int i = 0; i < count; ++i) {
    const Eigen::RowVector2d tangent = even.row((i + 1) % count) - even.row((i + count - 1) % count);
    const Eigen::RowVector2d normal = Eigen::RowVector2d(tangent.y(), -tangent.x()).normalized();
    moved.row(i) = even.row(i) + noise.deviation * offset[static_cast<std::size_t>(i)] * normal;
  }
  return moved;
}

}  // namespace rheocyte
