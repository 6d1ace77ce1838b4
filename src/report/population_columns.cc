#include "report/population_columns.h"

#include <algorithm>
#include <cmath>

#include "case/joined.h"
#include "report/effective_columns.h"
#include "report/quantity_columns.h"

namespace rheocyte {
namespace {

/// Events beyond the table are those of a recording or of a condition.
template <class Row>
void add_events_beyond(ColumnList<Row>& list) {
  list.add_count("beyond_table_events", [](const Row& r) { return r.beyond.all(); });
  for (int k = 0; k < int(TableSide::count); ++k)
    list.add_count("beyond_table_" + std::string(name_of(TableSide(k))),
                   [k](const Row& r) { return r.beyond.on(TableSide(k)); });
  list.add({.name = "beyond_table_fraction", .sentence = "of the events inside the gates"}, [](const Row& r) {
    return r.seen_events() > 0 ? double(r.beyond.all()) / double(r.seen_events()) : no_value;
  });
}

template <class Row>
void add_radius(ColumnList<Row>& list) {
  list.add({.name = "radius_median_um", .unit = "um", .sentence = "of the undeformed cells"},
           [](const Row& r) { return std::exp(r.log_radius); });
  list.add({.name = "radius_ln_spread", .sentence = "standard deviation of ln r0 between cells"}, &Row::radius_spread);
}

void add_identity(const PopulationReport& report, ColumnList<RecordingReport>& list) {
  using R = RecordingReport;
  list.add({.name = "condition"}, [&report](const R& r) { return report.conditions[r.condition].name; });
  list.add_count("session", [](const R& r) { return r.session + 1; });
  list.add({.name = "recording"}, [](const R& r) { return r.recording.string(); });
  list.add_count("events", &R::fitted_events);
}

void add_events(ColumnList<RecordingReport>& list) {
  using R = RecordingReport;
  list.add_count("events_recorded", &R::recorded);
  list.add_count("events_gated", &R::gated);
  list.add_count("events_without_numbers", &R::without_numbers);
  add_events_beyond(list);
  list.add({.name = "binned", .sentence = "whether events were counted in bins", .is_flag = true}, &R::is_binned);
}

/// What another model would need.
void add_observed(const PopulationReport& report, ColumnList<RecordingReport>& list) {
  using R = RecordingReport;
  struct Observed {
    SeenMeasure measure;
    const char *name, *unit;
  };
  for (const auto& [measure, name, unit] :
       {Observed{SeenMeasure::area_um2, "area", "um2"}, Observed{SeenMeasure::deformation, "deformation", ""},
        Observed{SeenMeasure::inertia_ratio, "inertia_ratio", ""}, Observed{SeenMeasure::mode_2, "mode_2", ""},
        Observed{SeenMeasure::mode_3, "mode_3", ""}, Observed{SeenMeasure::mode_4, "mode_4", ""},
        Observed{SeenMeasure::mode_5, "mode_5", ""}, Observed{SeenMeasure::mode_6, "mode_6", ""},
        Observed{SeenMeasure::mode_7, "mode_7", ""}}) {
    const auto m = std::size_t(measure);
    if (std::ranges::none_of(report.recordings, [m](const R& r) { return std::isfinite(r.observed[m].value); }))
      continue;
    const std::string suffix = *unit == 0 ? "" : std::string("_") + unit;
    list.add_with_error(
        {.name = std::string(name) + "_median" + suffix, .unit = unit, .sentence = "as measured, median of the events"},
        [m](const R& r) { return r.observed[m].value; }, [m](const R& r) { return r.observed[m].error; });
  }
  list.add_with_error(
      {.name = "young_modulus_deformation_median_kPa",
       .unit = "kPa",
       .sentence = "E as of a solid, from area and deformation, as `rheocyte extract` has it"},
      [](const R& r) { return r.by_deformation_kPa.value; }, [](const R& r) { return r.by_deformation_kPa.error; });
  list.add_with_error(
      {.name = "young_modulus_elongated_median_kPa",
       .unit = "kPa",
       .sentence = "E as of a solid under an axial tension, as `rheocyte extract` has it"},
      [](const R& r) { return r.elongated_kPa.value; }, [](const R& r) { return r.elongated_kPa.error; });
}

void add_measuring_conditions(ColumnList<RecordingReport>& list) {
  using R = RecordingReport;
  list.add({.name = "settings_hash", .sentence = "the same for results that are comparable"}, &R::settings_hash);
  list.add({.name = "table", .sentence = "look-up table"}, &R::table);
  list.add({.name = "channel_width_um", .unit = "um"}, [](const R& r) { return r.conditions.flow.width_um; });
  list.add({.name = "flow_rate_ul_per_s", .unit = "ul/s"}, [](const R& r) { return r.conditions.flow.rate_ul_s; });
  list.add({.name = "flow_exponent", .sentence = "of the liquid's power law"},
           [](const R& r) { return r.conditions.flow.exponent; });
  list.add({.name = "viscosity_median_mPas", .unit = "mPa s"}, &R::median_viscosity_mPas);
  list.add({.name = "medium", .sentence = "empty if the viscosity was given"}, &R::medium);
  list.add({.name = "temperature_C", .unit = "degC", .sentence = "median of the events"}, &R::temperature_C);
  list.add({.name = "wall_stress_Pa", .unit = "Pa", .sentence = "shear stress at the wall without a cell"},
           &R::wall_stress_Pa);
  list.add({.name = "pixel_size_um", .unit = "um"}, &R::pixel_size_um);
  list.add({.name = "direction", .sentence = "in which the cells move along x: 1, -1, or 0 if that is unknown"},
           &R::direction);
  list.add({.name = "gates"}, &R::gates);
  list.add({.name = "elongation_median", .sentence = "c2 of the outlines, else their inertia ratio"},
           &R::median_elongation);
}

const Columns<FittedCells>& solid_columns() {
  using F = FittedCells;
  static const Columns<F> columns = [] {
    ColumnList<F> list;
    list.add({.name = "correlation", .sentence = "of ln r0 and ln E between cells"},
             [](const F& f) { return f.cells.correlation; });
    list.add({.name = "young_modulus_ln_single_image_error",
              .sentence = "standard error of ln E of the median cell by a single image"},
             &F::event_error);
    list.add({.name = "log_likelihood"}, &F::log_likelihood);
    return std::move(list).columns();
  }();
  return columns;
}

const Columns<CombinedReport>& combined_columns() {
  using C = CombinedReport;
  static const Columns<C> columns = [] {
    ColumnList<C> list;
    list.add({.name = "cortex_fraction", .sentence = "of E + E2D/r0, mean of the cells"},
             [](const C& c) { return c.found.law.mean(2); });
    list.add({.name = "tension_ratio", .sentence = "tension of the cortex over E2D, mean of the cells"},
             [](const C& c) { return c.found.law.tension_ratio; });
    list.add({.name = "axial_tension_over_wall_stress"}, [](const C& c) { return c.found.law.axial_tension; });
    list.add({.name = "section"}, [](const C& c) { return c.section == Section::square ? "square" : "tube"; });
    list.add_count("strangers", &C::strangers);
    list.add({.name = "bulk_and_cortex_not_told_because"}, &C::not_told);
    return std::move(list).columns();
  }();
  return columns;
}

double kept_fraction(const RecordingReport& r) {
  if (!r.failure.empty() || r.effective) return no_value;
  return r.combined ? r.combined->found.kept_fraction : r.fitted.kept_fraction;
}

/// Below which the median of a quantity is known to lie.
auto upper_limit(PopulationQuantity quantity) {
  return [quantity](const RecordingReport& r) {
    return r.bound && r.bound->quantity == quantity ? std::exp(r.bound->log) : no_value;
  };
}

/// Whether there are numbers, and all checks hold.
bool fits(const RecordingReport& r) { return r.failure.empty() && std::ranges::all_of(r.checks, &MeasureCheck::fits); }

void add_outcome(ColumnList<RecordingReport>& list) {
  using R = RecordingReport;
  list.add({.name = "kept_fraction", .sentence = "of the cells, by the gates"}, &kept_fraction);
  list.add({.name = "young_modulus_below_kPa", .unit = "kPa", .sentence = "the median is below it"},
           upper_limit(PopulationQuantity::young_modulus));
  list.add({.name = "stiffness_below_kPa", .unit = "kPa", .sentence = "the median of E + E2D/r0 is below it"},
           upper_limit(PopulationQuantity::stiffness));
  list.add({.name = "young_modulus_above_kPa", .unit = "kPa", .sentence = "the median is above it"},
           [](const R& r) { return r.fitted.least_log_modulus ? std::exp(*r.fitted.least_log_modulus) : no_value; });
  list.add({.name = "fits", .sentence = "whether there are numbers and all checks hold", .is_flag = true}, &fits);
  list.add({.name = "failure", .sentence = "why there is no number"}, &R::failure);
}

std::string names_of(const std::vector<std::filesystem::path>& recordings) {
  std::vector<std::string> names;
  for (const auto& recording : recordings) names.push_back(recording.string());
  return joined(names, ", ");
}

/// Also where no recording has a number, so that the columns are there.
std::vector<PopulationQuantity> quantities_of(const PopulationReport& report) {
  auto quantities = report.quantities();
  if (quantities.empty())
    quantities = {report.model == "solid" ? PopulationQuantity::young_modulus : PopulationQuantity::stiffness};
  return quantities;
}

}  // namespace

const Columns<PopulationReport>& population_columns() {
  using P = PopulationReport;
  static const Columns<P> columns = [] {
    ColumnList<P> list;
    list.add({.name = "model"}, &P::model);
    list.add({.name = "model_chosen_because", .sentence = "where the shapes of the cells decide"}, &P::why_this_model);
    list.add({.name = "by", .sentence = "from what the stiffness follows, beside the area"},
             [](const P& p) { return name_of(p.by); });
    list.add({.name = "level", .sentence = "of the intervals"}, &P::level);
    list.add({.name = "between_recordings", .sentence = "known standard deviation of ln E between recordings"},
             [](const P& p) { return p.between_recordings.value_or(no_value); });
    list.add({.name = "outline_noise_um", .unit = "um"}, &P::outline_noise_um);
    list.add({.name = "elongation", .sentence = "how it is part of the model"}, &P::elongation);
    return std::move(list).columns();
  }();
  return columns;
}

Columns<RecordingReport> recording_columns(const PopulationReport& report) {
  using R = RecordingReport;
  ColumnList<R> list;
  add_identity(report, list);
  for (const PopulationQuantity quantity : quantities_of(report))
    list.add_of(columns_of_recordings(quantity, report.level), [quantity](const R& r) { return r.estimate(quantity); });
  add_radius(list);
  if (report.model == "solid")
    list.add_of(solid_columns(), [](const R& r) { return r.failure.empty() ? &r.fitted : nullptr; });
  else if (report.model == "effective")
    list.add_of(effective_columns(), [](const R& r) { return r.effective ? &*r.effective : nullptr; });
  else
    list.add_of(combined_columns(),
                [](const R& r) { return r.failure.empty() && r.combined ? &*r.combined : nullptr; });
  add_outcome(list);
  add_events(list);
  add_observed(report, list);
  add_measuring_conditions(list);
  return std::move(list).columns();
}

Columns<ConditionReport> condition_columns(const PopulationReport& report) {
  using C = ConditionReport;
  ColumnList<C> list;
  list.add({.name = "condition"}, &C::name);
  list.add_count("recordings", &C::recordings);
  list.add_count("events", &C::events);
  for (const PopulationQuantity quantity : quantities_of(report))
    list.add_of(columns_of_conditions(quantity), [quantity](const C& c) -> const ConditionQuantity* {
      const auto found = std::ranges::find(c.quantities, quantity, &ConditionQuantity::quantity);
      return found == c.quantities.end() ? nullptr : &*found;
    });
  add_radius(list);
  add_events_beyond(list);
  list.add({.name = "elongation_median", .sentence = "mean of the recordings' medians"}, &C::elongation);
  list.add({.name = "wall_stress_Pa", .unit = "Pa", .sentence = "geometric mean of the recordings"},
           &C::wall_stress_Pa);
  list.add({.name = "left_out", .sentence = "recordings in which no population was found"},
           [](const C& c) { return names_of(c.left_out); });
  list.add({.name = "without_numbers_by", .sentence = "the recording beyond the table for which there is no number"},
           [](const C& c) { return c.without_numbers_by.string(); });
  return std::move(list).columns();
}

Columns<DoseReport> dose_columns() {
  using D = DoseReport;
  const auto number = [](double DoseResponse::*of) { return [of](const D& d) { return d.response.*of; }; };
  ColumnList<D> list;
  list.add({.name = "quantity"}, [](const D& d) { return words_of(d.quantity).name; });
  list.add_with_interval({.name = "ec50", .sentence = "dose of half of the effect on ln of the quantity"},
                         number(&DoseResponse::ec50), number(&DoseResponse::ec50_lower),
                         number(&DoseResponse::ec50_upper));
  list.add({.name = "ratio_at_large_dose", .sentence = "of the quantity, over that without a dose"},
           [](const D& d) { return std::exp(d.response.log_effect); });
  list.add_with_interval(
      {.name = "ratio_per_decade", .sentence = "of the quantity, for ten times the dose"},
      [](const D& d) { return std::exp(d.response.slope_per_decade); },
      [](const D& d) { return std::exp(d.response.slope_lower); },
      [](const D& d) { return std::exp(d.response.slope_upper); });
  list.add({.name = "p_of_trend"}, number(&DoseResponse::p));
  return std::move(list).columns();
}

Columns<ConditionComparison> comparison_columns(const PopulationReport& report) {
  using C = ConditionComparison;
  using D = ConditionDifference;
  const auto number = [](double D::*of) { return [of](const C& c) { return c.difference.*of; }; };
  const auto ratio = [](double D::*of) { return [of](const C& c) { return std::exp(c.difference.*of); }; };
  ColumnList<C> list;
  list.add({.name = "control"}, [&report](const C& c) { return report.conditions[c.control].name; });
  list.add({.name = "treated"}, [&report](const C& c) { return report.conditions[c.treated].name; });
  list.add({.name = "quantity"}, [](const C& c) { return words_of(c.quantity).name; });
  list.add({.name = "test"}, [](const C& c) { return c.is_paired ? "paired t" : "Welch's t"; });
  list.add_with_interval({.name = "ratio", .sentence = "of the medians, treated over control"}, ratio(&D::value),
                         ratio(&D::lower), ratio(&D::upper));
  list.add({.name = "p"}, number(&D::p));
  list.add({.name = "interval_by"}, [](const C& c) {
    return interval_words(std::isfinite(c.difference.lower) && !c.difference.is_by_sampling);
  });
  list.add({.name = "degrees_of_freedom"}, number(&D::freedom));
  list.add_with_error({.name = "ln_ratio"}, number(&D::value), number(&D::standard_error));
  list.add({.name = "ratio_by_sampling_low", .sentence = "as if recordings did not scatter"},
           ratio(&D::sampling_lower));
  list.add({.name = "ratio_by_sampling_high"}, ratio(&D::sampling_upper));
  if (report.between_recordings) {
    list.add({.name = "ratio_by_known_scatter_low", .sentence = "with the known scatter between recordings"},
             ratio(&D::known_lower));
    list.add({.name = "ratio_by_known_scatter_high"}, ratio(&D::known_upper));
    list.add({.name = "p_by_known_scatter"}, number(&D::known_p));
  }
  return std::move(list).columns();
}

}  // namespace rheocyte
