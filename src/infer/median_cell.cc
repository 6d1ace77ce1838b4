#include "infer/median_cell.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

namespace {

MedianCell::Features array_of(const ShapeVector& shape) {
  MedianCell::Features features;
  std::ranges::copy(shape, features.begin());
  return features;
}

/// Along an axis of the table whose cells go on beyond it: a fraction of 1 or a tension of nothing is no such end.
bool is_at_end(const CombinedInterpolation& table, const CellCoordinates& cell) {
  constexpr double close = 1e-3;  // of the range
  const CellBox& box = table.box();
  const auto is_at = [&](int x, double end) {
    return std::abs(cell(x) - end) < close * (box.greatest(x) - box.least(x));
  };
  return (box.greatest(x_fraction) < 1 && is_at(x_fraction, box.greatest(x_fraction))) ||
         is_at(x_ratio, box.greatest(x_ratio)) || (box.least(x_ratio) > 0 && is_at(x_ratio, box.least(x_ratio))) ||
         (table.is_elongated() && (is_at(x_axial, box.least(x_axial)) || is_at(x_axial, box.greatest(x_axial))));
}

}  // namespace

MedianCell median_cell(const BulkCortexFit& moduli, const SeenCell& cell, const AxialTension& tension) {
  MedianCell found;
  found.cells = cell.cells;
  if (found.cells < MedianCell::min_cells) return found;
  const ModuliEstimate e = moduli.fit(cell.shape, cell.flow, tension);
  found.measured = array_of(cell.shape.features - cell.shape.errors.bias);
  found.error = array_of(cell.shape.errors.covariance.diagonal().cwiseSqrt());
  found.status = e.status;
  if (e.status == ModuliStatus::no_data) return found;
  found.fitted = array_of(moduli.shape_of(e.cell, cell.flow));
  found.chi_squared = e.chi_squared;
  found.freedom = e.freedom - (moduli.table().is_elongated() && !tension.is_known() ? 1 : 0);
  found.is_at_end = is_at_end(moduli.table(), e.cell);
  // What the model leaves is no noise of the pixels, but it is an error of the numbers.
  const double widening = found.freedom > 0 ? std::sqrt(std::max(found.chi_squared / found.freedom, 1.0)) : 1;
  const auto error_of = [&](Modulus m) { return widening * e.error(m); };
  found.young_kPa = e.value(Modulus::young), found.young_error_kPa = error_of(Modulus::young);
  found.cortex_mN_per_m = e.value(Modulus::cortex), found.cortex_error_mN_per_m = error_of(Modulus::cortex);
  found.tension_mN_per_m = e.value(Modulus::tension), found.tension_error_mN_per_m = error_of(Modulus::tension);
  found.stiffness_kPa = e.stiffness_kPa, found.stiffness_error_kPa = widening * e.stiffness_error_kPa;
  found.effective_modulus_kPa = e.effective_modulus_kPa;
  found.effective_modulus_error_kPa = widening * e.effective_modulus_error_kPa;
  found.axial_tension_Pa = e.axial_tension_Pa, found.axial_tension_error_Pa = widening * e.axial_tension_error_Pa;
  return found;
}

}  // namespace rheocyte
