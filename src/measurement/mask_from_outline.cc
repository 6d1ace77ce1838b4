#include "measurement/mask_from_outline.h"

#include <utility>
#include <vector>

namespace rheocyte {

bool fill_mask(const Eigen::MatrixX2d& outline, ImageSize size, std::span<std::uint8_t> mask) {
  std::ranges::fill(mask, std::uint8_t{0});
  const Eigen::RowVector2d low = outline.colwise().minCoeff(), high = outline.colwise().maxCoeff();
  if (!(low.minCoeff() >= 0) || !(high.x() <= static_cast<double>(size.width - 1)) ||
      !(high.y() <= static_cast<double>(size.height - 1)))
    return false;
  std::vector<std::pair<std::size_t, double>> crossings;  // of edges with rows: the row, x
  for (Eigen::Index i = 0; i < outline.rows(); ++i)
    for_crossings(outline.row(i), outline.row((i + 1) % outline.rows()),
                  [&](std::size_t y, double x) { crossings.emplace_back(y, x); });
  std::ranges::sort(crossings);
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const auto [y, first] = crossings[k];
    for (auto x = static_cast<std::size_t>(std::ceil(first)); static_cast<double>(x) <= crossings[k + 1].second; ++x)
      mask[y * size.width + x] = 1;
  }
  return true;
}

}  // namespace rheocyte
