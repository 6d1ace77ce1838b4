// Columns of what stands behind the numbers of a recording: parameters, checks, single events.
#include <algorithm>
#include <array>
#include <cmath>

#include "report/population_columns.h"

namespace rheocyte {
namespace {

constexpr std::array solid_names{"mean_ln_radius", "mean_ln_modulus", "ln_radius_spread", "ln_modulus_spread",
                                 "artanh_correlation"};
constexpr std::array combined_names{"mean_ln_radius",
                                    "mean_ln_stiffness",
                                    "mean_cortex_fraction",
                                    "mean_tension_ratio",
                                    "mean_axial_tension_over_wall_stress",
                                    "ln_root_radius_radius",
                                    "root_stiffness_radius",
                                    "ln_root_stiffness_stiffness",
                                    "root_fraction_radius",
                                    "root_fraction_stiffness",
                                    "ln_root_fraction_fraction",
                                    "ln_spread_of_tension_ratio",
                                    "ln_spread_of_axial_tension"};

std::vector<ParameterRow> solid_rows(const FittedCells& fitted) {
  const ParameterVector q = fitted.cells.parameters();
  std::vector<ParameterRow> rows;
  for (std::size_t k = 0; k < solid_names.size(); ++k) {
    const ParameterInterval& ends = fitted.intervals[k];
    rows.push_back({solid_names[k], q(Eigen::Index(k)), fitted.standard_error(PopulationParameter(k)), ends.lower,
                    ends.upper, ends.is_profile ? "profile" : "normal", fitted.at_bound[k]});
  }
  return rows;
}

std::vector<ParameterRow> combined_rows(const MomentFit& fit) {
  std::vector<ParameterRow> rows;
  for (int k = 0; k < combined_parameters; ++k)
    rows.push_back({combined_names[std::size_t(k)], fit.parameters(k), std::sqrt(fit.covariance(k, k)), no_value,
                    no_value, "", bool(fit.at_bound[std::size_t(k)])});
  return rows;
}

template <class Row>
void add_medians(ColumnList<Row>& list) {
  const auto part = [](Median Row::*of, double Median::*which) {
    return [of, which](const Row& row) { return row.*of.*which; };
  };
  list.add({.name = "distance", .sentence = "greatest difference of the distributions"}, &Row::distance);
  list.add_with_error({.name = "measured_median"}, part(&Row::measured, &Median::value),
                      part(&Row::measured, &Median::error));
  list.add_with_error({.name = "predicted_median"}, part(&Row::predicted, &Median::value),
                      part(&Row::predicted, &Median::error));
}

}  // namespace

std::vector<ParameterRow> parameter_rows(const RecordingReport& r) {
  if (!r.failure.empty() || r.effective) return {};
  return r.combined ? combined_rows(r.combined->found.fit) : solid_rows(r.fitted);
}

std::vector<CheckRow> check_rows(const PopulationReport& report) {
  std::vector<CheckRow> rows;
  for (const RecordingReport& r : report.recordings)
    for (const MeasureCheck& check : r.checks)
      rows.push_back({r.recording.string(), report.conditions[r.condition].name, check});
  return rows;
}

std::vector<ShrunkenEvent> shrunken_events(const RecordingReport& r) {
  std::vector<ShrunkenEvent> events;
  for (std::size_t k = 0; k < r.fitted.shrunken.size(); ++k)
    events.push_back({r.shrunken_events[k], r.fitted.shrunken[k]});
  std::ranges::sort(events, {}, &ShrunkenEvent::event);
  return events;
}

const Columns<ParameterRow>& parameter_columns() {
  using P = ParameterRow;
  static const Columns<P> columns = [] {
    ColumnList<P> list;
    list.add({.name = "name"}, &P::name);
    list.add_with_error({.name = "value"}, &P::value, &P::error);
    list.add({.name = "value_low"}, &P::low).add({.name = "value_high"}, &P::high);
    list.add({.name = "interval", .sentence = "how it was found: profile of the likelihood, or normal"}, &P::interval);
    list.add({.name = "at_bound", .is_flag = true}, &P::at_bound);
    return std::move(list).columns();
  }();
  return columns;
}

const Columns<MeasureCheck>& check_columns() {
  using C = MeasureCheck;
  static const Columns<C> columns = [] {
    ColumnList<C> list;
    list.add({.name = "measure"}, &C::name);
    list.add({.name = "fitted", .is_flag = true}, &C::is_fitted);
    list.add({.name = "fits", .is_flag = true}, &C::fits);
    add_medians(list);
    list.add({.name = "spread", .sentence = "robust standard deviation of the measured ones"}, &C::spread);
    list.add_count("thirds_that_fit", [](const C& c) { return std::ranges::count(c.thirds, true, &ThirdCheck::fits); });
    return std::move(list).columns();
  }();
  return columns;
}

const Columns<ThirdCheck>& third_columns() {
  static const Columns<ThirdCheck> columns = [] {
    ColumnList<ThirdCheck> list;
    list.add_count("events", &ThirdCheck::events);
    list.add({.name = "fits", .is_flag = true}, &ThirdCheck::fits);
    add_medians(list);
    return std::move(list).columns();
  }();
  return columns;
}

const Columns<CheckRow>& check_row_columns() {
  static const Columns<CheckRow> columns = [] {
    ColumnList<CheckRow> list;
    list.add({.name = "recording"}, &CheckRow::recording);
    list.add({.name = "condition"}, &CheckRow::condition);
    list.add_of(check_columns(), [](const CheckRow& row) { return &row.check; });
    return std::move(list).columns();
  }();
  return columns;
}

const Columns<ShrunkenEvent>& shrunken_columns() {
  using E = ShrunkenEvent;
  static const Columns<E> columns = [] {
    ColumnList<E> list;
    list.add_count("event", &E::event);
    list.add({.name = "young_modulus_kPa",
              .unit = "kPa",
              .sentence = "Young's modulus (kPa) of the event as one of the fitted population: drawn to its mean, for "
                          "pictures and never for tests",
              .role = "shrunken modulus",
              .rank = 1,
              .digits = 5},
             [](const E& e) { return std::exp(e.cell.log_modulus); });
    list.add({.name = "young_modulus_ln_error",
              .sentence = "standard deviation of the natural logarithm of the shrunken modulus",
              .role = "sd of ln modulus",
              .rank = 1,
              .digits = digits_of_errors},
             [](const E& e) { return e.cell.modulus_deviation; });
    list.add({.name = "radius_um",
              .unit = "um",
              .sentence = "radius (um) of the undeformed cell as one of the fitted population",
              .role = "shrunken radius",
              .rank = 1,
              .digits = 5},
             [](const E& e) { return std::exp(e.cell.log_radius); });
    list.add({.name = "radius_ln_error",
              .sentence = "standard deviation of the natural logarithm of the shrunken radius",
              .role = "sd of ln radius",
              .rank = 1,
              .digits = digits_of_errors},
             [](const E& e) { return e.cell.radius_deviation; });
    return std::move(list).columns();
  }();
  return columns;
}

}  // namespace rheocyte
