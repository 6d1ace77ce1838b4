#include "extract/fitting_table.h"

#include <algorithm>
#include <cmath>

#include "infer/shape_map.h"
#include "numeric/no_value.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

FittingTable compared(const ModulusMap& table, const MeasuringConditions& conditions, const JudgedShapes& events) {
  std::vector<ShapeExcess> excess(events.area_um2.size());
  table.shapes()->compare(conditions, {events.area_um2, events.deformation, {}}, events.inertia_ratio, excess);
  std::vector<double> beyond, expected;
  for (const ShapeExcess& e : excess) {
    beyond.push_back(e.excess);
    expected.push_back(e.expected);
  }
  return {table.origin().identifier, table.origin().cells(), median_with_error(beyond),
          median_with_error(expected).value, no_value};
}

/// For a liquid of 1 mPa s: moduli of both tables go with its viscosity.
std::vector<double> moduli(const ModulusMap& table, const MeasuringConditions& conditions, const JudgedShapes& events) {
  const std::size_t count = events.area_um2.size();
  const std::vector<double> viscosity(count, 1);
  std::vector<double> modulus(count), error(count);
  std::vector<ModulusState> states(count);
  table.estimate(conditions, {events.area_um2, events.deformation, viscosity}, {modulus, error, states});
  return modulus;
}

}  // namespace

FittingTable fitting_table(const ModulusTables& tables, const MeasuringConditions& conditions,
                           const JudgedShapes& events) {
  FittingTable best;
  const ModulusMap* its_map = nullptr;
  for (const ModulusMap* const table : tables.others(conditions.flow.exponent)) {
    if (!table->shapes()) continue;
    FittingTable one = compared(*table, conditions, events);
    // Cells that are rounder than those of a table are no more its own than longer ones.
    const double distance = std::abs(one.excess.value);
    if (!(distance < max_excess_of_the_model(one.excess))) continue;
    if (its_map && distance >= std::abs(best.excess.value)) continue;
    best = std::move(one);
    its_map = table;
  }
  if (!its_map) return best;
  const auto used = moduli(tables.used(conditions.flow.exponent), conditions, events),
             other = moduli(*its_map, conditions, events);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (std::isfinite(used[i] / other[i])) ratios.push_back(used[i] / other[i]);
  best.modulus_over_its = median_of(ratios);
  return best;
}

}  // namespace rheocyte
