#include "infer/seen_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

/// A group has so many cells, unless there would be too few or too many groups.
constexpr std::size_t wanted_in_group = 8, min_groups = 4, max_groups = 25;

/// Of the values that are no farther from their median than so many typical distances. The median itself would be off
/// by a fifth of the scatter: pixels add errors whose middle is not their mean.
double mean_without_strangers(const std::vector<double>& values) {
  constexpr double typical_distances = 5;
  const double median = quantile(values, 0.5);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - median));
  const double limit = typical_distances * quantile(distances, 0.5);
  double sum = 0, count = 0;
  for (const double value : values) {
    if (std::abs(value - median) > limit) continue;
    sum += value;
    ++count;
  }
  return sum / count;
}

/// Of each feature and the viscosity, by a function of all values.
template <class Middle>
MeasuredCell middle_of(std::span<const MeasuredCell> cells, const Middle& middle) {
  assert(!cells.empty());
  MeasuredCell found = cells.front();
  std::vector<double> values(cells.size());
  const auto middle_by = [&](const auto& number_of_cell) {
    std::ranges::transform(cells, values.begin(), number_of_cell);
    return middle(values);
  };
  for (int f = 0; f < feature_count; ++f)
    found.shape(f) = middle_by([f](const MeasuredCell& cell) { return cell.shape(f); });
  found.flow.viscosity_mPas = middle_by([](const MeasuredCell& cell) { return cell.flow.viscosity_mPas; });
  found.cells = cells.size();
  return found;
}

}  // namespace

MeasuredCell median_of(std::span<const MeasuredCell> cells) {
  return middle_of(cells, [](const std::vector<double>& values) { return quantile(values, 0.5); });
}

std::vector<MeasuredCell> means_by_size(std::span<const MeasuredCell> cells) {
  std::vector<MeasuredCell> sorted(cells.begin(), cells.end());
  std::ranges::sort(sorted, {}, [](const MeasuredCell& cell) { return cell.shape(int(ShapeFeature::area_um2)); });
  const std::size_t count = std::min(std::clamp(cells.size() / wanted_in_group, min_groups, max_groups), cells.size());
  std::vector<MeasuredCell> means;
  for (std::size_t group = 0; group < count; ++group) {
    const std::size_t first = group * cells.size() / count, last = (group + 1) * cells.size() / count;
    means.push_back(
        middle_of(std::span<const MeasuredCell>(sorted).subspan(first, last - first), mean_without_strangers));
  }
  return means;
}

}  // namespace rheocyte
