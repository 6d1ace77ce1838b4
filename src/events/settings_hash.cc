#include "events/settings_hash.h"

#include <fmt/format.h>

#include <cmath>

#include "numeric/fingerprint.h"

namespace rheocyte {

namespace {

std::string viscosity_line(const ExtractSettings& settings) {
  if (!settings.buffer) return fmt::format("viscosity: {} mPa s", settings.conditions.flow.viscosity_mPas);
  std::string line = fmt::format("viscosity: {} by {}, temperature ", settings.medium_text(), settings.model_text());
  line += settings.temperature_from == TemperatureSource::metadata ? "of the metadata" : settings.temperature_text();
  if (std::isfinite(settings.temperature_of_others_C))
    line += fmt::format(", of others {} degC", settings.temperature_of_others_C);
  return line;
}

}  // namespace

std::string settings_hash(std::span<const std::string> lines) {
  std::string text = fmt::format("rules {}\n", version_of_rules);
  for (const std::string& line : lines) text.append(line).append("\n");
  return fingerprint(text);
}

std::string decisive_line(const TableOrigin& origin) {
  return fmt::format("table: {} {}", origin.identifier, fingerprint(origin.spec));
}

std::vector<std::string> decisive_lines(const ExtractSettings& settings, const Gates& gates) {
  const MeasuringConditions& conditions = settings.conditions;
  std::vector<std::string> lines{
      fmt::format("channel width: {} um", conditions.flow.width_um),
      fmt::format("flow rate: {} ul/s", conditions.flow.rate_ul_s),
      fmt::format("pixel size: {} um{}", conditions.pixel_size_um, conditions.correct_area ? ", of areas, too" : ""),
      viscosity_line(settings)};
  for (std::string& line : gates.lines_in_full()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace rheocyte
