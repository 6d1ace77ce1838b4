#include "extract/soft_ends.h"

#include <cmath>

#include "numeric/no_value.h"

namespace rheocyte {
namespace {

/// From the flow of the table, whose viscosity is taken as 1 mPa s, to that of the measurement.
double modulus_factor(const ChannelFlow& table, const MeasuringConditions& conditions, double viscosity_mPas) {
  return viscosity_mPas * scale_factors(table, {conditions.flow.width_um, conditions.flow.rate_ul_s, 1}).modulus;
}

}  // namespace

double softest_modulus_kPa(const ModulusMap& map, const MeasuringConditions& conditions, double area_um2,
                           double viscosity_mPas) {
  if (!std::isfinite(area_um2)) return no_value;
  const ChannelFlow& flow = map.origin().flow;
  const double area = area_um2 * std::pow(flow.width_um / conditions.flow.width_um, 2);
  const double end = map.deformations(area).upper;
  if (!std::isfinite(end)) return no_value;
  return map.modulus_kPa(area, end) * modulus_factor(flow, conditions, viscosity_mPas);
}

double softest_modulus_kPa(const ElongatedLiquid& liquid, const MeasuringConditions& conditions,
                           const ElongatedCell& cell, double viscosity_mPas) {
  if (!cell.allFinite()) return no_value;
  const ElongatedTable& table = liquid.solids().table();
  ElongatedCell end = cell.cwiseMax(table.least()).cwiseMin(table.greatest());
  end(int(ElongatedCoordinate::height)) = table.greatest()(int(ElongatedCoordinate::height));
  return std::exp(table.at(end).log_modulus) * liquid.modulus_ratio(end) *
         modulus_factor(table.origin().flow, conditions, viscosity_mPas);
}

}  // namespace rheocyte
