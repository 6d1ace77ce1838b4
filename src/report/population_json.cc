#include "report/population_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "store/build_info.h"

namespace rheocyte {
namespace {

using nlohmann::ordered_json;

constexpr int population_schema = 1;
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
constexpr double normal_95 = 1.959964;  ///< half width of the interval of 95 %
constexpr std::array parameter_names{"mean_ln_radius", "mean_ln_modulus", "ln_radius_spread", "ln_modulus_spread",
                                     "artanh_correlation"};

/// NaN is no JSON: null.
ordered_json json_number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

ordered_json interval_json(double value, double lower, double upper) {
  return {{"value", json_number(value)}, {"lower", json_number(lower)}, {"upper", json_number(upper)}};
}

ordered_json parameters_json(const FittedCells& fitted) {
  const ParameterVector q = fitted.cells.parameters();
  ordered_json all = ordered_json::array();
  for (int k = 0; k < population_parameters; ++k) {
    const auto& interval = fitted.intervals[std::size_t(k)];
    all.push_back({{"name", parameter_names[std::size_t(k)]},
                   {"value", q(k)},
                   {"standard_error", json_number(fitted.standard_error(PopulationParameter(k)))},
                   {"lower", json_number(interval.lower)},
                   {"upper", json_number(interval.upper)},
                   {"interval", interval.is_profile ? "profile" : "normal"},
                   {"at_bound", fitted.at_bound[std::size_t(k)]}});
  }
  return all;
}

ordered_json covariance_json(const FittedCells& fitted) {
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < population_parameters; ++i) {
    ordered_json row = ordered_json::array();
    for (int j = 0; j < population_parameters; ++j) row.push_back(fitted.covariance(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// From the smallest to the largest third of the areas.
ordered_json thirds_json(const MeasureCheck& c) {
  ordered_json thirds = ordered_json::array();
  for (const ThirdCheck& third : c.thirds)
    thirds.push_back({{"events", third.events},
                      {"fits", third.fits},
                      {"distance", third.distance},
                      {"measured_median", json_number(third.measured.value)},
                      {"predicted_median", json_number(third.predicted.value)}});
  return thirds;
}

ordered_json check_json(const MeasureCheck& c) {
  return {{"measure", c.name},
          {"fitted", c.is_fitted},
          {"fits", c.fits},
          {"distance", c.distance},
          {"measured_median", json_number(c.measured.value)},
          {"measured_median_error", json_number(c.measured.error)},
          {"predicted_median", json_number(c.predicted.value)},
          {"predicted_median_error", json_number(c.predicted.error)},
          {"spread", json_number(c.spread)},
          {"measured_quantiles", c.measured_quantiles},
          {"predicted_quantiles", c.predicted_quantiles},
          {"thirds_by_area", thirds_json(c)}};
}

ordered_json images_json(const SingleImages& images) {
  return {
      {"ln_modulus_from", images.first}, {"step", images.step}, {"counts", images.counts}, {"without", images.without}};
}

ordered_json fitted_json(const FittedCells& f) {
  const auto& e = f.intervals[std::size_t(number_of(PopulationParameter::mean_log_modulus))];
  const double variance = f.cells.modulus_spread * f.cells.modulus_spread;
  return {{"median_young_modulus_kPa",
           interval_json(std::exp(f.cells.mean_log_modulus), std::exp(e.lower), std::exp(e.upper))},
          {"mean_young_modulus_kPa", std::exp(f.cells.mean_log_modulus + variance / 2)},
          {"spread_of_ln_modulus", f.cells.modulus_spread},
          {"median_radius_um", std::exp(f.cells.mean_log_radius)},
          {"spread_of_ln_radius", f.cells.radius_spread},
          {"correlation", f.cells.correlation},
          {"error_of_ln_modulus_by_one_image", f.event_error},
          {"kept_fraction", f.kept_fraction},
          {"log_likelihood", f.log_likelihood},
          {"parameters", parameters_json(f)},
          {"covariance", covariance_json(f)}};
}

ordered_json solid_json(const RecordingReport& r) {
  ordered_json json = fitted_json(r.fitted);
  json["moduli_of_single_images"] = images_json(r.images);
  return json;
}

ordered_json law_json(const CombinedReport& combined) {
  const MomentFit& fit = combined.found.fit;
  ordered_json all = ordered_json::array();
  for (int k = 0; k < combined_parameters; ++k)
    all.push_back({{"name", combined_names[std::size_t(k)]},
                   {"value", fit.parameters(k)},
                   {"standard_error", json_number(std::sqrt(fit.covariance(k, k)))},
                   {"at_bound", bool(fit.at_bound[std::size_t(k)])}});
  return all;
}

/// The intervals are those of the events; what recordings of one set-up share stands beside them.
ordered_json combined_json(const RecordingReport& r) {
  ordered_json json;
  for (const QuantityEstimate& e : r.quantities) {
    const double half = normal_95 * std::sqrt(e.mean.variance);
    const std::string key(words_of(e.quantity).key);
    json["median_" + key] =
        interval_json(std::exp(e.mean.value), std::exp(e.mean.value - half), std::exp(e.mean.value + half));
    json["spread_of_ln_" + key] = e.spread;
    json["common_relative_error_of_" + key] = e.common_error;
  }
  const CombinedReport& combined = *r.combined;
  json["bulk_and_cortex_not_told_because"] =
      combined.not_told.empty() ? ordered_json(nullptr) : ordered_json(combined.not_told);
  json["cortex_fraction"] = combined.found.law.mean(2);
  json["tension_ratio"] = combined.found.law.tension_ratio;
  json["axial_tension_over_wall_stress"] = combined.found.law.axial_tension;
  json["median_radius_um"] = std::exp(r.log_radius);
  json["spread_of_ln_radius"] = r.radius_spread;
  json["section"] = combined.section == Section::square ? "square" : "tube";
  json["kept_fraction"] = combined.found.kept_fraction;
  json["strangers"] = combined.strangers;
  json["parameters"] = law_json(combined);
  return json;
}

/// By the side on which they lie.
ordered_json beyond_json(const EventsBeyond& beyond) {
  ordered_json sides;
  for (int k = 0; k < int(TableSide::count); ++k) sides[std::string(name_of(TableSide(k)))] = beyond.on(TableSide(k));
  return sides;
}

ordered_json recording_json(const RecordingReport& r, const PopulationReport& report) {
  ordered_json checks = ordered_json::array();
  for (const auto& check : r.checks) checks.push_back(check_json(check));
  ordered_json json{{"recording", r.recording.string()},
                    {"condition", report.conditions[r.condition].name},
                    {"session", r.session + 1},
                    {"table", r.table},
                    {"channel_width_um", r.flow.width_um},
                    {"flow_rate_ul_per_s", r.flow.rate_ul_s},
                    {"flow_exponent", r.flow.exponent},
                    {"median_viscosity_mPas", r.median_viscosity_mPas},
                    {"medium", r.medium},
                    {"temperature_C", json_number(r.temperature_C)},
                    {"wall_stress_Pa", r.wall_stress_Pa()},
                    {"pixel_size_um", r.pixel_size_um},
                    {"direction", r.direction},
                    {"gates", r.gates},
                    {"events",
                     {{"recorded", r.recorded},
                      {"gated", r.gated},
                      {"without_numbers", r.without_numbers},
                      {"beside_the_table", r.beyond.all()},
                      {"beyond_the_table", beyond_json(r.beyond)},
                      {"fitted", r.fitted_events},
                      {"binned", r.is_binned}}},
                    {"median_elongation", json_number(r.median_elongation)}};
  if (r.failure.empty()) json["population"] = r.combined ? combined_json(r) : solid_json(r);
  if (r.greatest_log_modulus) json["young_modulus_below_kPa"] = std::exp(*r.greatest_log_modulus);
  if (r.fitted.least_log_modulus) json["young_modulus_above_kPa"] = std::exp(*r.fitted.least_log_modulus);
  json["failure"] = r.failure.empty() ? ordered_json(nullptr) : ordered_json(r.failure);
  json["checks"] = std::move(checks);
  json["settings"] = r.settings;
  json["warnings"] = r.warnings;
  return json;
}

ordered_json stiffening_json(const Stiffening& s, double wall_stress_Pa) {
  return {{"exponent_of_modulus_over_stress", interval_json(s.exponent, s.lower, s.upper)},
          {"degrees_of_freedom", json_number(s.freedom)},
          {"wall_stress_of_the_condition_Pa", wall_stress_Pa}};
}

const char* interval_by(bool recordings) { return recordings ? "scatter of the recordings" : "sampling of the events"; }

/// The first quantity has its scatter and spread beside it.
ordered_json condition_json(const ConditionReport& c) {
  ordered_json left_out = ordered_json::array();
  for (const auto& recording : c.left_out) left_out.push_back(recording.string());
  ordered_json json{{"name", c.name},
                    {"recordings", c.recordings},
                    {"events", c.events},
                    {"beyond_the_table", beyond_json(c.beyond)},
                    {"left_out", std::move(left_out)}};
  if (!c.without_numbers_by.empty()) json["without_numbers_by"] = c.without_numbers_by.string();
  if (!c.has_numbers()) return json;
  for (const ConditionQuantity& told : c.quantities) {
    const auto& e = told.log_mean;
    const std::string key(words_of(told.quantity).key);
    json["median_" + key] = interval_json(std::exp(e.value), std::exp(e.lower), std::exp(e.upper));
    json["spread_of_ln_" + key] = told.spread;
    if (told.quantity != PopulationQuantity::axial_tension)
      json["mean_" + key] = std::exp(e.value + told.spread * told.spread / 2);
  }
  const ConditionQuantity& first = c.quantities.front();
  json["interval_by"] = interval_by(first.is_by_recordings);
  json["spread_of_ln_modulus"] = first.spread;
  json["median_radius_um"] = std::exp(c.log_radius);
  json["spread_of_ln_radius"] = c.radius_spread;
  json["scatter_between_recordings"] = interval_json(first.between.deviation, first.between.lower, first.between.upper);
  if (first.stiffening) json["stiffening"] = stiffening_json(*first.stiffening, c.wall_stress_Pa);
  return json;
}

ordered_json comparison_json(const ConditionComparison& c, const PopulationReport& report) {
  const ConditionDifference& d = c.difference;
  const auto ratio = [](double lower, double value, double upper) {
    return interval_json(std::exp(value), std::exp(lower), std::exp(upper));
  };
  ordered_json json{{"control", report.conditions[c.control].name},
                    {"treated", report.conditions[c.treated].name},
                    {"quantity", words_of(c.quantity).key},
                    {"test", c.is_paired ? "paired t" : "Welch's t"},
                    {"ratio", ratio(d.lower, d.value, d.upper)},
                    {"p", json_number(d.p)},
                    {"interval_by", interval_by(std::isfinite(d.lower) && !d.is_by_sampling)},
                    {"degrees_of_freedom", json_number(d.freedom)},
                    {"ln_ratio", d.value},
                    {"ln_ratio_standard_error", json_number(d.standard_error)},
                    {"ratio_by_sampling_alone", ratio(d.sampling_lower, d.value, d.sampling_upper)}};
  if (report.between_recordings) {
    json["ratio_with_known_scatter"] = ratio(d.known_lower, d.value, d.known_upper);
    json["p_with_known_scatter"] = json_number(d.known_p);
  }
  return json;
}

}  // namespace

std::string population_json(const PopulationReport& report) {
  ordered_json recordings = ordered_json::array(), conditions = ordered_json::array(),
               comparisons = ordered_json::array();
  for (const auto& r : report.recordings) recordings.push_back(recording_json(r, report));
  for (const auto& c : report.conditions) conditions.push_back(condition_json(c));
  for (const auto& c : report.comparisons) comparisons.push_back(comparison_json(c, report));
  ordered_json quantities = ordered_json::array();
  for (const PopulationQuantity quantity : report.quantities()) {
    const auto [key, symbol, unit] = words_of(quantity);
    quantities.push_back({{"key", key}, {"symbol", symbol}, {"unit", unit}});
  }
  const ordered_json content{{"made_by", "rheocyte population"},
                             {"version", version},
                             {"schema", population_schema},
                             {"model", report.model},
                             {"quantities", quantities},
                             {"by", name_of(report.by)},
                             {"level", report.level},
                             {"between_recordings", report.between_recordings ? ordered_json(*report.between_recordings)
                                                                              : ordered_json(nullptr)},
                             {"outline_noise_um", report.outline_noise_um},
                             {"elongation", report.elongation},
                             {"conditions", conditions},
                             {"comparisons", comparisons},
                             {"recordings", recordings},
                             {"warnings", report.warnings}};
  return content.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace rheocyte
