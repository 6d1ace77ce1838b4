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
