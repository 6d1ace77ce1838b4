#include "infer/elongated_liquid.h"

#include <algorithm>
#include <cmath>

#include "numeric/no_value.h"

namespace rheocyte {

void ElongatedLiquid::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                               const ElongatedShapes& shapes, const ElongatedEstimates& estimates) const {
  solids_.estimate(conditions, events, shapes, estimates);
  if (!computed_ || !measured_) return;
  for (std::size_t i = 0; i < estimates.cell.size(); ++i) {
    if (!has_modulus(estimates.moduli.state[i])) continue;
    const double ratio = modulus_ratio(estimates.cell[i]);
    for (double* const number : {&estimates.moduli.modulus_kPa[i], &estimates.moduli.standard_error_kPa[i],
                                 &estimates.axial_tension_Pa[i], &estimates.axial_tension_error_Pa[i]})
      *number *= ratio;
  }
}

double ElongatedLiquid::modulus_ratio(const ElongatedCell& cell) const {
  if (!computed_ || !measured_) return 1;
  const ElongatedTable& table = solids_.table();
  // The cell without the elongation; where it would lose its stability the last one counts.
  const ElongatedState round = table.at(table.without_elongation(cell));
  const auto modulus_per_mPas = [&](const ModulusMap& map, double width_um) {
    const ChannelFlow& flow = map.origin().flow;
    const double area = std::exp(round.log_area()) * std::pow(flow.width_um / width_um, 2);
    const ModulusMap::Interval areas = map.areas();
    const double held = std::clamp(area, areas.lower, areas.upper);
    const ModulusMap::Interval range = map.deformations(held);
    const double deformation =
        std::clamp(round.value(number_of(ElongatedMeasure::deformation)), range.lower, range.upper);
    return map.modulus_kPa(held, deformation) * scale_factors(flow, {width_um, 1, 1, flow.exponent}).modulus;
  };
  const double width_um = solids_.origin().flow.width_um;
  return modulus_per_mPas(*measured_, width_um) / modulus_per_mPas(*computed_, width_um);
}

}  // namespace rheocyte
