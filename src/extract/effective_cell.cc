#include "extract/effective_cell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "events/plausibility.h"
#include "extract/common_errors.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

/// Of the scatter about the medians, what lies farther counts as so far: outliers hardly move the correlations.
constexpr double most_deviations = 3;
/// Of events that hardly differ, as in a table of rounded numbers.
constexpr double min_deviation = 1e-4;
/// Of the variance of a mean, that of a median of normally distributed numbers.
constexpr double variance_of_median = 1.25 * 1.25;

/// Where the other law has no such cell: as in the softest cells that both laws have.
constexpr double law_unknown = 0.64;

struct MeasuredFigure {
  double median, deviation;
  std::vector<double> values;
};

MeasuredFigure figure_of(std::span<const double> measured, double (*feature)(double)) {
  std::vector<double> values;
  for (const double value : measured) values.push_back(feature(value));
  const CountedSample<double> sample(values);
  return {sample.quantile(0.5), std::max(robust_deviation(sample), min_deviation), std::move(values)};
}

SeenFigure medians_of(const EventFigures& events) {
  std::vector columns{figure_of(events.area_um2, [](double area) { return std::log(area); }),
                      figure_of(events.deformation, [](double d) { return d; })};
  if (events.has_ratios)
    columns.push_back(figure_of(events.inertia_ratio, [](double ratio) { return 1 / (ratio * ratio); }));
  const auto count = double(events.area_um2.size());
  SeenFigure seen{{0, 0, no_value}, Eigen::Matrix3d::Zero()};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    seen.value(Eigen::Index(i)) = columns[i].median;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      double sum = 0;
      for (std::size_t event = 0; event < columns[i].values.size(); ++event) {
        const auto from_median = [event](const MeasuredFigure& c) {
          return std::clamp((c.values[event] - c.median) / c.deviation, -most_deviations, most_deviations);
        };
        sum += from_median(columns[i]) * from_median(columns[k]);
      }
      seen.covariance(Eigen::Index(i), Eigen::Index(k)) =
          variance_of_median * sum / count / count * columns[i].deviation * columns[k].deviation;
    }
    double& variance = seen.covariance(Eigen::Index(i), Eigen::Index(i));
    variance = std::max(variance, variance_of_median / count * min_deviation * min_deviation);
  }
  return seen;
}

/// By the coordinate that lies farthest beyond the table.
EffectivePlace place_of(const CombinedInterpolation& table, const ProportionedEstimate& found) {
  const ModuliEstimate& e = found.by_scatter;
  if (e.status == ModuliStatus::no_data) return EffectivePlace::unknown;
  if (found.is_ambiguous) return EffectivePlace::ambiguous;
  if (e.status != ModuliStatus::outside_table) return EffectivePlace::inside;
  const CellBox& box = table.box();
  const auto beyond = [&](int x) { return e.cell(x) > box.greatest(x); };
  const auto before = [&](int x) { return e.cell(x) < box.least(x); };
  if (beyond(x_radius) || before(x_radius)) return EffectivePlace::other_size;
  if (beyond(x_axial)) return EffectivePlace::longer;
  return before(x_progress) || before(x_axial) ? EffectivePlace::stiffer : EffectivePlace::softer;
}

void add_moduli(const ProportionedEstimate& found, EffectiveCell& cell) {
  const ModuliEstimate &by_scatter = found.by_scatter, &in_common = found.in_common;
  const auto modulus = [&](Modulus m) { return Median{by_scatter.value(m), by_scatter.error(m), in_common.error(m)}; };
  cell.effective_kPa = {by_scatter.effective_modulus_kPa, by_scatter.effective_modulus_error_kPa,
                        in_common.effective_modulus_error_kPa};
  cell.stiffness_kPa = {by_scatter.stiffness_kPa, by_scatter.stiffness_error_kPa, in_common.stiffness_error_kPa};
  cell.young_kPa = modulus(Modulus::young);
  cell.cortex_mN_per_m = modulus(Modulus::cortex);
  cell.tension_mN_per_m = modulus(Modulus::tension);
  cell.axial_tension_Pa = {by_scatter.axial_tension_Pa, by_scatter.axial_tension_error_Pa,
                           in_common.axial_tension_error_Pa};
  cell.radius_um = by_scatter.value(Modulus::cortex) / (by_scatter.stiffness_kPa - by_scatter.value(Modulus::young));
}

/// The third of the events with the smallest areas, or with the largest ones.
enum class Third { small, large };
EventFigures third_of(const EventFigures& events, Third which) {
  const CountedSample<double> areas(events.area_um2);
  const double lower = areas.quantile(1.0 / 3), upper = areas.quantile(2.0 / 3);
  EventFigures third;
  third.has_ratios = events.has_ratios;
  for (std::size_t i = 0; i < events.area_um2.size(); ++i)
    if (which == Third::small ? events.area_um2[i] < lower : events.area_um2[i] > upper)
      third.take(events.area_um2[i], events.deformation[i], events.inertia_ratio[i]);
  return third;
}

Median ratio_of(double large, double large_error, double small, double small_error) {
  const double ratio = large / small;
  return {ratio, ratio * std::hypot(large_error / large, small_error / small)};
}

SeenFigure without_ratio(SeenFigure seen) {
  seen.value(2) = no_value;
  return seen;
}

void add_by_ratios(const ProportionedEstimate& found, EffectiveCell& cell) {
  cell.by_ratios_kPa = found.by_scatter.effective_modulus_kPa;
  cell.by_ratios_tension_Pa = found.by_scatter.axial_tension_Pa;
}

void compare_sizes(const ProportionedCells& law, const EventFigures& events, const Sight& sight, double pixel_size_um,
                   const AxialTension& tension, EffectiveCell& cell) {
  const EventFigures small_cells = third_of(events, Third::small), large_cells = third_of(events, Third::large);
  if (std::min(small_cells.area_um2.size(), large_cells.area_um2.size()) < min_events_of_effective_cell) return;
  const auto estimate = [&](const EventFigures& third) {
    const SeenFigure seen = medians_of(third);
    return law.estimate(cell.is_by_ratios ? seen : without_ratio(seen), sight, pixel_size_um, tension);
  };
  const ProportionedEstimate small = estimate(small_cells), large = estimate(large_cells);
  for (const ProportionedEstimate* third : {&small, &large})
    if (place_of(law.table(), *third) != EffectivePlace::inside) return;
  const ModuliEstimate &s = small.by_scatter, &l = large.by_scatter;
  cell.large_over_small_modulus = ratio_of(l.effective_modulus_kPa, l.effective_modulus_error_kPa,
                                           s.effective_modulus_kPa, s.effective_modulus_error_kPa);
  cell.large_over_small_tension =
      ratio_of(l.axial_tension_Pa, l.axial_tension_error_Pa, s.axial_tension_Pa, s.axial_tension_error_Pa);
}

/// Of ln of the effective modulus.
double spread_between(const ProportionedEstimate& found, std::size_t events) {
  const auto variance = [](const ModuliEstimate& e) {
    return std::isfinite(e.effective_modulus_error_kPa) ? std::pow(e.effective_modulus_error_kPa, 2) : 0;
  };
  const double of_events = variance(found.by_scatter) * double(events) / variance_of_median;
  return std::sqrt(std::max(of_events - variance(found.of_picture), 0.0)) / found.by_scatter.effective_modulus_kPa;
}

}  // namespace

void EventFigures::take(double event_area_um2, double event_deformation, double event_inertia_ratio) {
  if (!std::isfinite(event_area_um2) || !std::isfinite(event_deformation) ||
      (has_ratios && !std::isfinite(event_inertia_ratio)) || is_red_cell(event_inertia_ratio, event_area_um2))
    return;
  area_um2.push_back(event_area_um2);
  deformation.push_back(event_deformation);
  inertia_ratio.push_back(event_inertia_ratio);
}

EffectiveCell effective_cell(const ProportionedTables& tables, const EventFigures& events, const Sight& sight,
                             double pixel_size_um, const AxialTension& tension) {
  EffectiveCell cell;
  cell.events = events.area_um2.size();
  cell.section = sight.section;
  if (!tables.in_liquid || cell.events < min_events_of_effective_cell) return cell;
  if (!events.has_ratios && !tension.is_known()) return cell;
  cell.is_by_ratios = !tension.is_known();
  const SeenFigure by_ratios = medians_of(events);
  const SeenFigure seen = cell.is_by_ratios ? by_ratios : without_ratio(by_ratios);
  const ProportionedCells& cells = *tables.in_liquid;
  const ProportionedEstimate found = cells.estimate(seen, sight, pixel_size_um, tension);
  cell.place = place_of(cells.table(), found);
  cell.softest_kPa = found.softest_kPa;
  cell.wall_stress_Pa = wall_shear_stress_Pa(sight.flow);
  cell.viscosity_mPas = sight.flow.viscosity_mPas;
  if (!cell.is_found()) return cell;
  add_moduli(found, cell);
  cell.spread = spread_between(found, cell.events);
  if (!cell.is_by_ratios && events.has_ratios) add_by_ratios(cells.estimate(by_ratios, sight, pixel_size_um), cell);
  compare_sizes(cells, events, sight, pixel_size_um, tension, cell);
  // Where their tables end first, they are continued; without such a cell NaN.
  const auto by_law = [&](const ProportionedCells* law) {
    if (law == &cells) return cell.effective_kPa.value;
    return law ? law->estimate(seen, sight, pixel_size_um, tension).by_scatter.effective_modulus_kPa : no_value;
  };
  cell.over_other_law = by_law(tables.by_current_area) / by_law(tables.by_reference_area);
  return cell;
}

void add_errors_of_model(double reynolds, bool is_cortex_seen, EffectiveCell& cell) {
  const double of_all = std::hypot(modulus_per_reynolds * reynolds, error_of_height);
  // Half of the difference.
  const double of_law = std::abs(std::log(std::isfinite(cell.over_other_law) ? cell.over_other_law : law_unknown)) / 2;
  const auto add = [&](Median& median, double of_proportions) {
    median.common_error = std::hypot(median.common_error, median.value * std::hypot(of_all, of_law, of_proportions));
  };
  add(cell.effective_kPa, is_cortex_seen ? error_of_proportions : error_of_unseen_proportions);
  for (Median* const of_parts : {&cell.stiffness_kPa, &cell.young_kPa, &cell.cortex_mN_per_m, &cell.tension_mN_per_m})
    add(*of_parts, stiffness_by_proportions);
  add(cell.axial_tension_Pa, tension_by_proportions);
}

}  // namespace rheocyte
