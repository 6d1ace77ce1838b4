#include "infer/liquid_change.h"

#include <cassert>
#include <cmath>

namespace rheocyte {

LiquidChange::LiquidChange(const CombinedInterpolation& computed, const CombinedInterpolation& requested)
    : computed_(computed), requested_(requested), at_rest_(cells_at_rest(computed.spec())) {
  assert(computed.is_elongated() && requested.is_elongated());
}

LiquidChange::Difference LiquidChange::at(CellCoordinates cell) const {
  const double progress = cell(x_progress);
  for (const CombinedInterpolation* const table : {&computed_, &requested_}) cell = table->nearest_inside(cell);
  const CombinedState before = computed_.at(cell), after = requested_.at(cell);
  Difference difference{after.value - before.value, (after.gradient - before.gradient).col(x_progress)};
  if (cell(x_progress) != progress) difference.slope.setZero();
  return difference;
}

CombinedBranch LiquidChange::changed(const CombinedBranch& branch, double progress_of_unit, const CellsAtRest& at_rest,
                                     double log_modulus) const {
  constexpr int area = int(ShapeFeature::area_um2);
  const auto& [radius, fraction, ratio, axial] = branch.place;
  CombinedBranch changed = branch;
  CellCoordinates alike = computed_.box().least;
  alike(x_radius) = std::log(radius);
  const auto over_stiffness = [&](const CellsAtRest& cells, double of_cortex, double tension) {
    return effective_modulus_over_stiffness<double>(
        cells, {alike(x_radius), std::log(branch.stiffness_kPa[0]), of_cortex, tension});
  };
  alike(x_axial) =
      axial * over_stiffness(at_rest_, alike(x_fraction), alike(x_ratio)) / over_stiffness(at_rest, fraction, ratio);
  for (int i = 0; i < branch.samples(); ++i) {
    double& stiffness = changed.stiffness_kPa[std::size_t(i)];
    alike(x_progress) = std::log(progress_of_unit / stiffness);
    const Difference by = at(alike);
    stiffness *= std::exp(by.value(log_stiffness_row) + log_modulus);
    const double log_stiffness_slope = 1 - by.slope(log_stiffness_row);  // by ln of the stiffness before
    for (int feature = 0; feature < feature_count; ++feature) {
      double &value = changed.value(i, feature), &slope = changed.slope(i, feature);
      const double change = by.value(row_of(feature)), change_slope = -by.slope(row_of(feature));
      if (feature == area) {
        slope = std::exp(change) * (slope + value * change_slope);
        value *= std::exp(change);
      } else {
        slope += change_slope;
        value += change;
      }
      slope /= log_stiffness_slope;
    }
  }
  return changed;
}

CombinedTable LiquidChange::changed(const CombinedTable& table) const {
  CombinedTable changed{table.spec, {}};
  changed.spec.base.flow = requested_.spec().base.flow;
  const CellsAtRest at_rest = cells_at_rest(table.spec);
  const double log_modulus =
      -std::log(scale_factors(channel_flow_of(computed_.spec().base), channel_flow_of(table.spec.base)).modulus);
  for (const CombinedBranch& branch : table.branches)
    if (const double progress_of_unit = mode_3_of_unit(table, branch.place); progress_of_unit > 0)
      changed.branches.push_back(this->changed(branch, progress_of_unit, at_rest, log_modulus));
  return changed;
}

}  // namespace rheocyte
