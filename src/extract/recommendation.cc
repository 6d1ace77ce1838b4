#include "extract/recommendation.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "extract/summary_columns.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view start = "recommended_";

}  // namespace

Json summary_json(const RowColumn<ExtractSummary>& column, const ExtractSummary& summary) {
  const std::string text = summary_text(column, summary);
  if (text.empty()) return nullptr;
  return std::holds_alternative<double>(column.value(summary)) ? Json(std::stod(text)) : Json(text);
}

Json recommended_json(const ExtractSummary& summary) {
  Json all = Json::object();
  for (const auto& column : summary_columns())
    if (column.name.starts_with(start)) all[column.name.substr(start.size())] = summary_json(column, summary);
  return all;
}

std::string recommended_in_short(const ExtractSummary& summary) {
  const Json said = recommended_json(summary);
  const auto number = [&](const char* name) { return said.contains(name) && said[name].is_number(); };
  if (number("bound_kPa") && !number("young_modulus_median_kPa"))
    return fmt::format("recommended: {} than {:.3g} kPa", said.value("bound", Json("")).get<std::string>(),
                       said["bound_kPa"].get<double>());
  if (!number("young_modulus_median_kPa")) return "no modulus is recommended";
  std::string errors;
  for (const char* error : {"young_modulus_median_error_kPa", "young_modulus_common_error_kPa"})
    if (number(error)) errors += fmt::format(" +- {:.2g}", said[error].get<double>());
  return fmt::format("recommended: E = {:.3g}{} kPa", said["young_modulus_median_kPa"].get<double>(), errors);
}

std::vector<std::string> recommended_lines(const ExtractSummary& summary) {
  std::vector<std::string> lines;
  for (const auto& column : summary_columns())
    if (const std::string text = summary_text(column, summary); column.name.starts_with(start) && !text.empty())
      lines.push_back(column.name + ": " + text);
  return lines;
}

}  // namespace rheocyte
