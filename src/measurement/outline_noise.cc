#include "measurement/outline_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

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
Eigen::ArrayXd smooth_noise(int count, double width, CellRandom& random) {
  const int reach = std::min(static_cast<int>(std::ceil(4 * width)), count / 2);
  Eigen::ArrayXd white(count + 2 * reach), smooth = Eigen::ArrayXd::Zero(count);  // its ends once more beyond them
  for (double& value : white.segment(reach, count)) value = random.normal();
  white.head(reach) = white.segment(count, reach).eval();
  white.tail(reach) = white.segment(reach, reach).eval();
  double squares = 0;
  for (int j = -reach; j <= reach; ++j) {
    const double weight = std::exp(-0.5 * (j / width) * (j / width));
    squares += weight * weight;
    smooth += weight * white.segment(j + reach, count);
  }
  return smooth / std::sqrt(squares);
}

}  // namespace

Eigen::MatrixX2d displaced(const Eigen::MatrixX2d& outline, const OutlineNoise& noise, CellRandom& random) {
  if (noise.deviation == 0) return outline;
  constexpr int count = 512;
  const Eigen::MatrixX2d even = resampled(outline, count);
  const double step = (even.row(1) - even.row(0)).norm();
  const Eigen::ArrayXd offset = smooth_noise(count, std::max(noise.correlation / step, 0.5), random);
  Eigen::MatrixX2d moved(count, 2);
  for (int i = 0; i < count; ++i) {
    const Eigen::RowVector2d tangent = even.row((i + 1) % count) - even.row((i + count - 1) % count);
    const Eigen::RowVector2d normal = Eigen::RowVector2d(tangent.y(), -tangent.x()).normalized();
    moved.row(i) = even.row(i) + noise.deviation * offset(i) * normal;
  }
  return moved;
}

}  // namespace rheocyte
