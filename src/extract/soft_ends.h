// The softest cells of tables, in the flow of a measurement: a bound for cells that are softer.
#pragma once
#include "infer/elongated_liquid.h"
#include "infer/modulus_map.h"

namespace rheocyte {

/// Young's modulus (kPa) of the softest cell with this area (um2, as measured); NaN if the table has no such area.
double softest_modulus_kPa(const ModulusMap& map, const MeasuringConditions& conditions, double area_um2,
                           double viscosity_mPas);

/// Likewise of an elongated cell, which may lie beyond the end of its table; NaN if a coordinate is.
double softest_modulus_kPa(const ElongatedLiquid& liquid, const MeasuringConditions& conditions,
                           const ElongatedCell& cell, double viscosity_mPas);

}  // namespace rheocyte
