#include "infer/seen_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

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

}  // namespace rheocyte
