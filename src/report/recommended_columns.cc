#include "report/recommended_columns.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "extract/recommendation.h"
#include "report/summary_columns.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view start = "recommended_";

}  // namespace

Json summary_json(const Column<ExtractSummary>& column, const ExtractSummary& summary) {
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
  const Recommendation r = recommendation(summary.shapes);
  if (std::isfinite(r.bound_kPa)) return fmt::format("recommended: {} than {:.3g} kPa", r.bound(), r.bound_kPa);
  if (!std::isfinite(r.kPa.value)) return "no modulus is recommended";
  std::string errors;
  for (const double error : {r.kPa.error, r.kPa.common_error})
    if (std::isfinite(error)) errors += fmt::format(" +- {:.2g}", error);
  return fmt::format("recommended: E = {:.3g}{} kPa", r.kPa.value, errors);
}

std::vector<std::string> recommended_lines(const ExtractSummary& summary) {
  std::vector<std::string> lines;
  for (const auto& column : summary_columns())
    if (const std::string text = summary_text(column, summary); column.name.starts_with(start) && !text.empty())
      lines.push_back(column.name + ": " + text);
  return lines;
}

}  // namespace rheocyte
