#include "extract/extract_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "case/user_error.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string number_text(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

std::string cell(std::string text) {
  std::ranges::replace(text, '\t', ' ');
  return one_line(text, 1000);
}

void append_cell(std::string& text, const std::string& content) {
  text += '\t';
  text += cell(content);
}

constexpr std::array<std::string_view, 20> columns_after_counts{"valid_percent",
                                                                "young_modulus_median_kPa",
                                                                "young_modulus_first_quartile_kPa",
                                                                "young_modulus_third_quartile_kPa",
                                                                "young_modulus_mean_kPa",
                                                                "young_modulus_standard_deviation_kPa",
                                                                "young_modulus_standard_error_median_kPa",
                                                                "table",
                                                                "medium",
                                                                "viscosity_model",
                                                                "mean_viscosity_mPas",
                                                                "temperature",
                                                                "channel_width_um",
                                                                "flow_rate_ul_s",
                                                                "pixelation_pixel_size_um",
                                                                "corrected_for_pixels",
                                                                "gates",
                                                                "area_from",
                                                                "deformation_from",
                                                                "remarks"};

// Everything of one recording but its name.
void append_numbers(std::string& text, const ExtractSummary& s) {
  append_cell(text, std::to_string(s.events));
  for (const std::size_t count : s.counts) append_cell(text, std::to_string(count));
  const double share = static_cast<double>(s.valid()) / static_cast<double>(std::max<std::size_t>(s.events, 1));
  const auto& d = s.modulus_kPa;
  for (const double value : {100 * share, d.median, d.first_quartile, d.third_quartile, d.mean, d.standard_deviation,
                             s.median_standard_error_kPa})
    append_cell(text, number_text(value));
  for (const auto& word : {s.table, s.medium, s.viscosity_model}) append_cell(text, word);
  append_cell(text, number_text(s.mean_viscosity_mPas));
  append_cell(text, s.temperature);
  const auto& c = s.conditions;
  for (const double value : {c.flow.width_um, c.flow.rate_ul_s, c.pixel_size_um}) append_cell(text, number_text(value));
  append_cell(text, s.corrected);
  append_cell(text, s.gates);
  append_cell(text, s.area_from);
  append_cell(text, s.deformation_from);
  std::string remarks;
  for (const auto& warning : s.warnings) remarks.append(remarks.empty() ? "" : " ").append(warning);
  append_cell(text, remarks);
}

}  // namespace

Distribution distribution_of(std::span<double> values) {
  if (values.empty()) return {nan, nan, nan, nan, nan};
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75), mean,
          values.size() > 1 ? std::sqrt(squares / (count - 1)) : nan};
}

std::string summary_table(std::span<const SummaryLine> lines) {
  std::string text = "recording\tevents";
  for (const auto name : names_of_modulus_states) {
    std::string column(name);
    std::ranges::replace(column, ' ', '_');
    append_cell(text, column);
  }
  for (const auto name : columns_after_counts) append_cell(text, std::string(name));
  text += '\n';
  for (const auto& line : lines) {
    text += cell(line.recording.string());
    if (line.error.empty())
      append_numbers(text, line.summary);
    else
      text.append(names_of_modulus_states.size() + columns_after_counts.size() + 1, '\t').append(cell(line.error));
    text += '\n';
  }
  return text;
}

std::string in_one_line(const ExtractSummary& s) {
  std::string text = fmt::format("{} of {} events", s.valid(), s.events);
  if (s.valid() > 0)
    text += fmt::format(", E median {:.4g} kPa (quartiles {:.4g} to {:.4g})", s.modulus_kPa.median,
                        s.modulus_kPa.first_quartile, s.modulus_kPa.third_quartile);
  if (std::isfinite(s.median_standard_error_kPa))
    text += fmt::format(", standard error {:.2g} kPa", s.median_standard_error_kPa);
  std::string others;
  for (std::size_t k = 1; k < s.counts.size(); ++k)
    if (s.counts[k] > 0)
      others += fmt::format("{}{} {}", others.empty() ? "" : ", ", s.counts[k], names_of_modulus_states[k]);
  return others.empty() ? text : text + "; " + others;
}

}  // namespace rheocyte
