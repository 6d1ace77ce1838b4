#include "report/population_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/joined.h"
#include "case/user_error.h"
#include "report/methods_text.h"

namespace rheocyte {
namespace {

std::string median_text(const ConditionQuantity& told) {
  const auto [name, suffix, symbol, unit] = words_of(told.quantity);
  const IntervalEstimate& e = told.log_mean;
  return fmt::format("{} {:.3g} {} ({:.3g} .. {:.3g})", symbol, std::exp(e.value), unit, std::exp(e.lower),
                     std::exp(e.upper));
}

std::string file_name(const std::filesystem::path& recording) { return one_line(recording.filename().string(), 100); }

/// What a condition lacks: ", and beyond the table 31 % softer; left out, ...: a3.rtdc"; empty if nothing.
std::string missing_text(const ConditionReport& c) {
  std::string text;
  if (const auto shares = c.beyond.shares(c.seen_events()); !shares.empty())
    text = fmt::format(", and beyond the table {}", shares);
  std::vector<std::string> names;
  for (const auto& recording : c.left_out) names.push_back(file_name(recording));
  return names.empty() ? text : text + "; left out, because no population was found: " + joined(names, ", ");
}

std::string no_number_text(const ConditionReport& c) {
  if (c.without_numbers_by.empty()) return "because none of its recordings has one";
  return fmt::format("because {} has none: most of its cells lie beyond the table, or are too stiff to be seen",
                     file_name(c.without_numbers_by));
}

std::string elongation_text(const ConditionReport& c, StiffnessMeasure by) {
  if (!std::isfinite(c.elongation)) return {};
  return fmt::format("; {} {:.3f}", by == StiffnessMeasure::asymmetry ? "c2" : "elongation", c.elongation);
}

std::string condition_line(const ConditionReport& c, StiffnessMeasure by) {
  if (!c.has_numbers()) return fmt::format("{}: no number, {}.", c.name, no_number_text(c));
  std::string medians;
  for (const ConditionQuantity& told : c.quantities) medians += (medians.empty() ? "" : ", ") + median_text(told);
  const ConditionQuantity& first = c.quantities.front();
  const std::string_view interval_by = first.is_by_recordings ? "by its recordings"
                                       : c.recordings > 1 ? "by sampling, which is wider than the recordings scatter"
                                                          : "by sampling alone";
  const std::string radius_spread =
      std::isfinite(c.radius_spread) ? fmt::format(", spread {:.1f} %", 100 * c.radius_spread) : "";
  return fmt::format("{}: median {} {}; spread of {} {:.0f} %; r0 {:.2f} um{}{}; recordings: {}, events: {}{}", c.name,
                     medians, interval_by, words_of(first.quantity).symbol, 100 * first.spread, std::exp(c.log_radius),
                     radius_spread, elongation_text(c, by), c.recordings, c.events, missing_text(c));
}

std::string stiffening_line(const ConditionReport& c) {
  const ConditionQuantity& first = c.quantities.front();
  const Stiffening& s = *first.stiffening;
  const auto symbol = words_of(first.quantity).symbol;
  return fmt::format(
      "{}: {} grows as the power {:.2f} of the stress, {:.2f} .. {:.2f}; its {} is that at {:.3g} Pa at the wall",
      c.name, symbol, s.exponent, s.lower, s.upper, symbol, c.wall_stress_Pa);
}

/// The events of both conditions of which the ratio knows the side alone; empty if there are hardly any.
std::string shares_text(const ConditionReport& treated, const ConditionReport& control) {
  std::vector<std::string> shares;
  for (const ConditionReport* c : {&treated, &control})
    if (const auto of_condition = c->beyond.shares(c->seen_events()); !of_condition.empty())
      shares.push_back(fmt::format("{} of {}", of_condition, c->name));
  return shares.empty() ? std::string() : "; beyond the table: " + joined(shares, ", ");
}

std::string test_text(const ConditionComparison& c) {
  const std::string test = fmt::format("{} with {:.3g} degrees of freedom",
                                       c.is_paired ? "the paired t test" : "Welch's test", c.difference.freedom);
  if (!c.difference.is_by_sampling) return "by " + test;
  return fmt::format("by the wider of {} and the sampling of the events, which is the latter", test);
}

std::string comparison_line(const ConditionComparison& c, const PopulationReport& report) {
  const ConditionDifference& d = c.difference;
  const bool is_one_of_several = report.model != "solid";
  std::string line = fmt::format(
      "{} / {}: {}ratio {:.3f}", report.conditions[c.treated].name, report.conditions[c.control].name,
      is_one_of_several ? fmt::format("{}, ", words_of(c.quantity).symbol) : std::string(), std::exp(d.value));
  if (std::isfinite(d.p))
    line += fmt::format(" ({:.3f} .. {:.3f}), p = {:.2g} {}", std::exp(d.lower), std::exp(d.upper), d.p, test_text(c));
  else
    line += fmt::format(
        " ({:.3f} .. {:.3f} by sampling alone); no p, because a single recording gives no scatter between recordings",
        std::exp(d.sampling_lower), std::exp(d.sampling_upper));
  if (report.between_recordings)
    line += fmt::format("; with a scatter of {:.3g} between recordings ({:.3f} .. {:.3f}), p = {:.2g}",
                        *report.between_recordings, std::exp(d.known_lower), std::exp(d.known_upper), d.known_p);
  return line + shares_text(report.conditions[c.treated], report.conditions[c.control]);
}

std::string dose_line(const DoseReport& d, const PopulationReport& report) {
  const DoseResponse& r = d.response;
  const auto symbol = words_of(d.quantity).symbol;
  const std::string unit = report.dose_unit.empty() ? "" : " " + report.dose_unit;
  std::string line =
      fmt::format("{} over the dose: ratio {:.3f} for ten times the dose", symbol, std::exp(r.slope_per_decade));
  if (std::isfinite(r.p))
    line += fmt::format(" ({:.3f} .. {:.3f}), p = {:.2g}", std::exp(r.slope_lower), std::exp(r.slope_upper), r.p);
  // Without an effect no dose has half of it.
  if (!(r.p < 1 - report.level) || !std::isfinite(r.ec50)) return line;
  if (r.ec50_lower > 0 && std::isfinite(r.ec50_upper))
    return line + fmt::format("; EC50 {:.3g}{} ({:.3g} .. {:.3g}), ratio {:.2f} at large doses", r.ec50, unit,
                              r.ec50_lower, r.ec50_upper, std::exp(r.log_effect));
  return line + (r.ec50_lower > 0              ? fmt::format("; EC50 above {:.3g}{}", r.ec50_lower, unit)
                 : std::isfinite(r.ec50_upper) ? fmt::format("; EC50 below {:.3g}{}", r.ec50_upper, unit)
                                               : std::string("; the doses do not determine an EC50"));
}

std::string no_ratio_text(const PopulationReport& report, std::size_t treated) {
  for (const std::size_t c : {std::size_t(0), treated})
    if (!report.conditions[c].has_numbers()) return fmt::format("{} has no number", report.conditions[c].name);
  return "no session has a number of both";
}

std::string checks_line(const PopulationReport& report) {
  std::size_t checked = 0, misfits = 0;
  const RecordingReport* first = nullptr;
  for (const auto& r : report.recordings) {
    if (!r.failure.empty() || r.checks.empty()) continue;
    ++checked;
    const bool fits = std::ranges::all_of(r.checks, &MeasureCheck::fits);
    misfits += fits ? 0 : 1;
    if (!fits && !first) first = &r;
  }
  if (checked == 0) return {};
  if (!first)
    return fmt::format("checks: {} of {} recordings fit in all measures, also in those not fitted", checked, checked);
  const bool is_no_solid = report.model == "solid" && std::ranges::any_of(first->checks, [](const MeasureCheck& check) {
                             return !check.fits && (check.name == "c4" || check.name == "c5");
                           });
  return fmt::format("checks: {} of {} recordings do not fit; {}: {}{}", misfits, checked,
                     first->recording.filename().string(), check_text(first->checks),
                     is_no_solid ? ". Cells with a cortex have other c4 and c5 than solids: --model cortex" : "");
}

}  // namespace

std::vector<std::string> population_lines(const PopulationReport& report) {
  std::vector<std::string> lines;
  if (!report.why_this_model.empty())
    lines.push_back(fmt::format("--model {}, because {}", report.model, report.why_this_model));
  for (const auto& c : report.conditions) lines.push_back(condition_line(c, report.by));
  const auto quantities = report.quantities();
  if (std::ranges::find(quantities, PopulationQuantity::effective_modulus) != quantities.end())
    lines.emplace_back("E_eff: effective Young's modulus, of bulk, cortex and tension together");
  for (const auto& c : report.conditions)
    if (c.has_numbers() && c.quantities.front().stiffening) lines.push_back(stiffening_line(c));
  for (const auto& c : report.comparisons) lines.push_back(comparison_line(c, report));
  for (const DoseReport& d : report.dose_responses) lines.push_back(dose_line(d, report));
  for (std::size_t c = 1; c < report.conditions.size(); ++c)
    if (std::ranges::find(report.comparisons, c, &ConditionComparison::treated) == report.comparisons.end())
      lines.push_back(fmt::format("{} / {}: no ratio, because {}", report.conditions[c].name,
                                  report.conditions.front().name, no_ratio_text(report, c)));
  lines.insert(lines.end(), report.tensions.begin(), report.tensions.end());
  if (const auto checks = checks_line(report); !checks.empty()) lines.push_back(checks);
  if (std::ranges::any_of(report.recordings, [](const auto& r) { return r.failure.empty(); }))
    lines.push_back("systematic errors, which do not enter ratios: " + report.systematic_errors);
  if (const auto methods = methods_text(report); !methods.empty()) lines.push_back("methods: " + methods);
  return lines;
}

}  // namespace rheocyte
