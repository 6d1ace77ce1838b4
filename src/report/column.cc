#include "report/column.h"

#include <fmt/format.h>

#include <cmath>

#include "numeric/number_from_chars.h"

namespace rheocyte {

std::string cell_text(const ColumnDescription& column, const CellValue& value) {
  if (const auto* const text = std::get_if<std::string>(&value)) return *text;
  if (const auto* const flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  const double number = std::get<double>(value);
  if (!column.words.empty()) return std::string(column.words[static_cast<std::size_t>(number)]);
  return fmt::format("{:.{}g}", number, column.digits > 0 ? column.digits : digits_of_values);
}

CellValue printed_value(const ColumnDescription& column, const CellValue& value) {
  if (!std::holds_alternative<double>(value) || !has_value(value) || !column.words.empty()) return value;
  const std::string text = cell_text(column, value);
  double printed = std::get<double>(value);
  number_from_chars(text.data(), text.data() + text.size(), printed);
  return printed;
}

bool has_value(const CellValue& value) {
  if (const auto* const text = std::get_if<std::string>(&value)) return !text->empty();
  const auto* const number = std::get_if<double>(&value);
  return !number || std::isfinite(*number);
}

}  // namespace rheocyte
