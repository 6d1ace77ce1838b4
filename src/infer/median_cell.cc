#include "infer/median_cell.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

ShapeVector without_bias(const MeasuredShape& shape) { return shape.features - shape.errors.bias; }

ShapeVector median_of_all(std::span<const SeenCell> cells) {
  ShapeVector median;
  std::vector<double> values;
  for (int f = 0; f < feature_count; ++f) {
    values.clear();
    for (const SeenCell& cell : cells) values.push_back(without_bias(cell.shape)(f));
    median(f) = quantile(values, 0.5);
  }
  return median;
}

const SeenCell& nearest_to(const ShapeVector& shape, std::span<const SeenCell> cells) {
  const auto distance = [&](const SeenCell& cell) { return (without_bias(cell.shape) - shape).squaredNorm(); };
  return *std::ranges::min_element(cells, {}, distance);
}

MedianCell::Features array_of(const ShapeVector& shape) {
  MedianCell::Features features;
  std::ranges::copy(shape, features.begin());
  return features;
}

}  // namespace

MedianCell median_cell(const SeveralModuli& moduli, std::span<const SeenCell> cells, const AxialTension& tension) {
  MedianCell found;
  found.cells = cells.size();
  if (found.cells < MedianCell::min_cells) return found;
  const ShapeVector median = median_of_all(cells);
  SeenCell cell = nearest_to(median, cells);
  cell.shape.features = median + cell.shape.errors.bias;
  const ModuliEstimate e = moduli.fit(cell.shape, cell.flow, tension);
  found.measured = array_of(median);
  found.error = array_of(cell.shape.errors.covariance.diagonal().cwiseSqrt());
  found.status = e.status;
  if (e.status == ModuliStatus::no_data) return found;
  found.fitted = array_of(moduli.shape_of(e.cell, cell.flow));
  found.young_kPa = e.value(Modulus::young), found.young_error_kPa = e.error(Modulus::young);
  found.cortex_mN_per_m = e.value(Modulus::cortex), found.cortex_error_mN_per_m = e.error(Modulus::cortex);
  found.tension_mN_per_m = e.value(Modulus::tension), found.tension_error_mN_per_m = e.error(Modulus::tension);
  found.stiffness_kPa = e.stiffness_kPa, found.stiffness_error_kPa = e.stiffness_error_kPa;
  found.axial_tension_Pa = e.axial_tension_Pa, found.axial_tension_error_Pa = e.axial_tension_error_Pa;
  found.chi_squared = e.chi_squared;
  found.freedom = e.freedom - (moduli.table().is_elongated() && std::isinf(tension.error_Pa) ? 1 : 0);
  return found;
}

}  // namespace rheocyte
