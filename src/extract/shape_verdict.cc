#include "extract/shape_verdict.h"

#include <algorithm>
#include <cmath>

#include "extract/cortex_shapes.h"
#include "extract/growth_of_asymmetry.h"
#include "numeric/no_value.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double of_the_model = 0.02, still_doubtful = 0.05;  // medians of the excess
// Of a cell that approaches the axis, with its cortex as those of HL60 have it (docs/real-cells.md).
constexpr double mode_4_over_mode_3 = -0.007 / 0.0065;

}  // namespace

double max_excess_of_the_model(const Median& excess) {
  return std::min(of_the_model + 2 * excess.error, still_doubtful);
}

bool Trend::is_changing() const { return std::abs(change) > 3 * error && std::abs(change) > 0.05 * std::abs(median); }

double ShapeVerdict::elongated_percent() const {
  return judged == 0 ? no_value : 100 * static_cast<double>(elongated) / static_cast<double>(judged);
}

ShapeVerdict::Fit ShapeVerdict::fit() const {
  if (judged < fewest_for_a_verdict || !std::isfinite(excess.value)) return Fit::unknown;
  const double distance = std::abs(excess.value);
  if (distance < max_excess_of_the_model(excess)) return Fit::model;
  if (!other.identifier.empty()) return Fit::other_table;
  // Few events may lie off by chance.
  if (distance < std::max(still_doubtful, of_the_model + 2 * excess.error)) return Fit::doubtful;
  return excess.value < 0 ? Fit::rounder : Fit::elongated;
}

bool ShapeVerdict::has_cortex_shapes() const {
  return with_elongation >= fewest_for_a_verdict && are_of_cortex({asymmetry, radius_px, cortex_mode_4, cortex_mode_5});
}

bool ShapeVerdict::has_effective_modulus() const {
  if (is_tension_given || has_cortex_shapes()) return true;
  const bool are_outlines_of_solids = elongated_by == ElongatedBy::modes && with_elongation >= fewest_for_a_verdict;
  return fit() == Fit::elongated && !are_outlines_of_solids;
}

GrowthOfAsymmetry growth_of_asymmetry(const ShapeVerdict& v) {
  GrowthOfAsymmetry g{.growth = v.direction * v.asymmetry_trend.change};
  if (!v.asymmetry_trend.is_changing() || !(g.growth > 0) || !std::isfinite(v.mode_4_trend.error)) return g;
  constexpr double sure = 2;
  g.change_of_mode_4 = v.direction * v.mode_4_trend.change;
  g.expected = mode_4_over_mode_3 * g.growth;
  const double error = std::hypot(v.mode_4_trend.error, mode_4_over_mode_3 * v.asymmetry_trend.error);
  const bool approaches = g.change_of_mode_4 < -sure * v.mode_4_trend.error &&
                          std::abs(g.change_of_mode_4 - g.expected) < sure * error + std::abs(g.expected) / 2;
  g.kind = approaches ? Growth::of_centring_cells : Growth::of_creeping_cells;
  return g;
}

bool ShapeVerdict::is_creeping() const {
  constexpr double most = 0.2;  // of c_3
  const GrowthOfAsymmetry g = growth_of_asymmetry(*this);
  return g.kind == Growth::of_creeping_cells && g.growth > most * std::abs(asymmetry_trend.median);
}

}  // namespace rheocyte
