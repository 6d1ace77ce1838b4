#include "experiment/dose_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/user_error.h"
#include "experiment/condition_reports.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {
namespace {

[[noreturn]] void refuse(const std::string& text, std::string_view why) {
  throw UserError(fmt::format("rheocyte: --dose {}: {}", one_line(text, 60), why));
}

/// UserError if it is no number, or negative.
double value_of(const std::string& text, std::string_view number) {
  double value = no_value;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = number_from_chars(number.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value) || value < 0)
    refuse(text, "give the name of a condition and a number that is not negative, for example --dose drug=0.05.");
  return value;
}

}  // namespace

std::vector<double> doses_of(const std::vector<std::string>& texts,
                             const std::vector<PopulationCondition>& conditions) {
  if (texts.empty()) return {};
  std::vector<double> doses(conditions.size(), no_value);
  for (const std::string& text : texts) {
    const auto sign = text.rfind('=');
    if (sign == std::string::npos) value_of(text, {});
    const std::string name = text.substr(0, sign);
    const auto found = std::ranges::find(conditions, name, &PopulationCondition::name);
    if (found == conditions.end()) refuse(text, "there is no such condition.");
    doses[std::size_t(found - conditions.begin())] = value_of(text, std::string_view(text).substr(sign + 1));
  }
  if (std::isnan(doses.front())) doses.front() = 0;
  return doses;
}

std::vector<DoseReport> dose_reports(const std::vector<RecordingReport>& recordings, const std::vector<double>& doses,
                                     bool is_paired, double level) {
  std::vector<DoseReport> reports;
  if (doses.empty()) return reports;
  for (const PopulationQuantity quantity : quantities_told(recordings)) {
    std::vector<MeanAtDose> means;
    for (const RecordingReport& r : recordings)
      if (const QuantityEstimate* const e = r.estimate(quantity); e && std::isfinite(doses[r.condition]))
        means.push_back({e->mean.value, doses[r.condition], is_paired ? r.session : 0});
    const DoseResponse response = dose_response(means, level);
    if (std::isfinite(response.slope_per_decade)) reports.push_back({quantity, response});
  }
  return reports;
}

}  // namespace rheocyte
