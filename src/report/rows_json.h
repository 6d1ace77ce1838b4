// Rows as JSON: an object of their columns by name; null where a column has no value.
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <ranges>

#include "report/column.h"

namespace rheocyte {

/// Numbers in full; a number that stands for a word is that word.
inline nlohmann::ordered_json value_json(const ColumnDescription& column, const CellValue& value) {
  if (!has_value(value)) return nullptr;
  if (const auto* const flag = std::get_if<bool>(&value)) return *flag;
  if (const auto* const number = std::get_if<double>(&value); number && column.words.empty())
    return column.digits == digits_of_counts ? nlohmann::ordered_json(std::llround(*number))
                                             : nlohmann::ordered_json(*number);
  return cell_text(column, value);
}

template <class Row>
nlohmann::ordered_json row_json(const Columns<Row>& columns, const Row& row) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& column : columns) object[column.name] = value_json(column, column.value(row));
  return object;
}

/// The same with the numbers as texts give them.
template <class Row>
nlohmann::ordered_json printed_row_json(const Columns<Row>& columns, const Row& row) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& column : columns) object[column.name] = value_json(column, printed_value(column, column.value(row)));
  return object;
}

template <class Row, std::ranges::input_range Rows>
nlohmann::ordered_json rows_json(const Columns<Row>& columns, const Rows& rows) {
  auto all = nlohmann::ordered_json::array();
  for (const Row& row : rows) all.push_back(row_json(columns, row));
  return all;
}

}  // namespace rheocyte
