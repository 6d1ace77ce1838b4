#include "experiment/condition_reports.h"

#include <algorithm>
#include <cmath>

#include "experiment/unlike_recordings.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

/// The recordings of a condition, in the order of the sessions.
struct ConditionRecordings {
  RecordingReports with_numbers, left_out;
  const RecordingReport* beyond = nullptr;  ///< one for which the condition has no numbers

  ConditionRecordings(const std::vector<RecordingReport>& recordings, std::size_t condition) {
    for (const auto& r : recordings) {
      if (r.condition != condition) continue;
      if (r.failure.empty())
        with_numbers.push_back(&r);
      else if (!r.is_beyond)
        left_out.push_back(&r);
      else if (!beyond)
        beyond = &r;
    }
    if (beyond) with_numbers.clear();
  }
};

/// A quantity in recordings; empty if one of them does not have it.
std::vector<QuantityEstimate> estimates_of(const RecordingReports& recordings, PopulationQuantity quantity) {
  std::vector<QuantityEstimate> estimates;
  for (const RecordingReport* r : recordings) {
    const QuantityEstimate* const estimate = r->estimate(quantity);
    if (!estimate) return {};
    estimates.push_back(*estimate);
  }
  return estimates;
}

std::vector<RecordingMean> means_of(const std::vector<QuantityEstimate>& estimates) {
  std::vector<RecordingMean> means;
  for (const auto& e : estimates) means.push_back(e.mean);
  return means;
}

/// A comparison of the condition with zero has the interval of its mean.
void tell_mean(const std::vector<RecordingMean>& means, double level, ConditionQuantity& told) {
  const std::vector<RecordingMean> zero(means.size(), {0, 0});
  const ConditionDifference d = paired_difference(zero, means, {level, {}});
  const bool has_scatter = means.size() > 1;
  told.is_by_recordings = has_scatter && !d.is_by_sampling;
  told.log_mean = {d.value, has_scatter ? d.lower : d.sampling_lower, has_scatter ? d.upper : d.sampling_upper};
}

/// Recordings at several flow rates show how a modulus grows with the stress; they scatter about a line then.
void tell_stiffening(const std::vector<RecordingMean>& means, const std::vector<double>& log_stresses, double level,
                     ConditionQuantity& told) {
  std::vector<MeanAtStress> at_stress;
  for (std::size_t j = 0; j < means.size(); ++j) at_stress.push_back({means[j], log_stresses[j]});
  if (distinct_stresses(at_stress) < fewest_stresses_of_a_power) return;
  const Stiffening& found = told.stiffening.emplace(stiffening_of(at_stress, level));
  told.between = {};  // they scatter about the line, not about their mean
  told.is_by_recordings = true;
  told.log_mean = {found.value, found.value_lower, found.value_upper};
}

/// A power of the stress is that of the flow rate: other channels and media differ in more than the stress.
ConditionQuantity condition_quantity(PopulationQuantity quantity, const RecordingReports& recordings, double level) {
  const auto estimates = estimates_of(recordings, quantity);
  const auto means = means_of(estimates);
  std::vector<double> log_spreads, log_stresses;
  for (const auto& e : estimates) log_spreads.push_back(std::log(e.spread));
  for (const RecordingReport* r : recordings) log_stresses.push_back(std::log(r->wall_stress_Pa()));
  ConditionQuantity told;
  told.quantity = quantity;
  tell_mean(means, level, told);
  told.spread = std::exp(mean_of(log_spreads));
  told.between = scatter_between(means, level);
  if (share_channel_and_medium(recordings)) tell_stiffening(means, log_stresses, level, told);
  return told;
}

ConditionReport condition_report(const ConditionRecordings& of_condition, const std::string& name,
                                 const std::vector<PopulationQuantity>& quantities, double level) {
  ConditionReport report;
  report.name = name;
  const RecordingReports& recordings = of_condition.with_numbers;
  report.recordings = recordings.size();
  for (const RecordingReport* r : of_condition.left_out) report.left_out.push_back(r->recording);
  if (of_condition.beyond) report.without_numbers_by = of_condition.beyond->recording;
  if (recordings.empty()) return report;
  std::vector<double> elongations, radii, log_radius_spreads, log_stresses;
  for (const RecordingReport* r : recordings) {
    report.events += r->fitted_events;
    report.beyond.add(r->beyond);
    report.continued_events += r->continued_events;
    elongations.push_back(r->median_elongation);
    radii.push_back(r->log_radius);
    log_radius_spreads.push_back(std::log(r->radius_spread));
    log_stresses.push_back(std::log(r->wall_stress_Pa()));
  }
  report.elongation = mean_of(elongations);
  report.log_radius = mean_of(radii);
  report.radius_spread = std::exp(mean_of(log_radius_spreads));
  report.wall_stress_Pa = std::exp(mean_of(log_stresses));
  for (const PopulationQuantity quantity : quantities)
    if (!estimates_of(recordings, quantity).empty())
      report.quantities.push_back(condition_quantity(quantity, recordings, level));
  return report;
}

/// Of the sessions that have both.
void keep_pairs(RecordingReports& some, RecordingReports& others) {
  const auto keep = [](RecordingReports& kept, const RecordingReports& beside) {
    std::erase_if(kept, [&](const RecordingReport* r) {
      return std::ranges::find(beside, r->session, &RecordingReport::session) == beside.end();
    });
  };
  keep(some, others);
  keep(others, some);
}

}  // namespace

std::vector<PopulationQuantity> quantities_told(const std::vector<RecordingReport>& recordings) {
  std::vector<PopulationQuantity> told;
  for (const auto& r : recordings)
    for (const auto& e : r.quantities)
      if (std::ranges::find(told, e.quantity) == told.end()) told.push_back(e.quantity);
  return told;
}

std::vector<ConditionReport> condition_reports(const std::vector<RecordingReport>& recordings,
                                               const std::vector<PopulationCondition>& conditions, double level) {
  const auto quantities = quantities_told(recordings);
  std::vector<ConditionReport> reports;
  for (std::size_t c = 0; c < conditions.size(); ++c)
    reports.push_back(condition_report(ConditionRecordings(recordings, c), conditions[c].name, quantities, level));
  return reports;
}

std::vector<ConditionComparison> comparisons_of(const std::vector<RecordingReport>& recordings, std::size_t conditions,
                                                const ComparisonRules& rules) {
  std::vector<ConditionComparison> comparisons;
  for (std::size_t c = 1; c < conditions; ++c)
    for (const PopulationQuantity quantity : quantities_told(recordings)) {
      RecordingReports of_control = ConditionRecordings(recordings, 0).with_numbers,
                       of_treated = ConditionRecordings(recordings, c).with_numbers;
      if (rules.is_paired) keep_pairs(of_control, of_treated);
      const auto control = means_of(estimates_of(of_control, quantity)),
                 treated = means_of(estimates_of(of_treated, quantity));
      if (control.empty() || treated.empty()) continue;
      const auto difference = rules.is_paired ? paired_difference(control, treated, rules.settings)
                                              : unpaired_difference(control, treated, rules.settings);
      comparisons.push_back({0, c, quantity, rules.is_paired, difference});
    }
  return comparisons;
}

}  // namespace rheocyte
