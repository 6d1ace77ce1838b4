#include "measurement/pixel_hull.h"

#include <algorithm>
#include <limits>

namespace rheocyte {

namespace {

std::int64_t cross(const PixelPoint& o, const PixelPoint& a, const PixelPoint& b) {
  return static_cast<std::int64_t>(a.x - o.x) * (b.y - o.y) - static_cast<std::int64_t>(a.y - o.y) * (b.x - o.x);
}

}  // namespace

std::span<const PixelPoint> PixelHull::of(std::span<const PixelPoint> contour) {
  // In each column only the highest and the lowest pixel can lie on the hull; this replaces sorting.
  std::int32_t left = contour.front().x, right = left;
  for (const PixelPoint& point : contour) {
    left = std::min(left, point.x);
    right = std::max(right, point.x);
  }
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  columns_.assign(static_cast<std::size_t>(right - left + 1), {none, -none});
  for (const PixelPoint& point : contour) {
    Column& column = columns_[static_cast<std::size_t>(point.x - left)];
    column.min_y = std::min(column.min_y, point.y);
    column.max_y = std::max(column.max_y, point.y);
  }
  points_.clear();
  std::size_t bottom = 0;
  const auto push = [&](const PixelPoint& point) {
    while (points_.size() >= bottom + 2 && cross(points_[points_.size() - 2], points_.back(), point) <= 0)
      points_.pop_back();
    points_.push_back(point);
  };
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].min_y != none) push({left + static_cast<std::int32_t>(i), columns_[i].min_y});
  const PixelPoint turn{right, columns_.back().max_y};
  if (!(turn == points_.back())) points_.push_back(turn);
  bottom = points_.size() - 1;
  for (std::size_t i = columns_.size() - 1; i-- > 0;)
    if (columns_[i].min_y != none) push({left + static_cast<std::int32_t>(i), columns_[i].max_y});
  if (points_.size() > 1 && points_.back() == points_.front()) points_.pop_back();
  return points_;
}

}  // namespace rheocyte
