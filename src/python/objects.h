// Rows of columns (report/column.h) and JSON as objects of Python: no text lies between.
#pragma once
#include <pybind11/pybind11.h>

#include <nlohmann/json_fwd.hpp>
#include <ranges>
#include <string_view>

#include "report/column.h"

namespace rheocyte {

/// Bytes that are not UTF-8 are replaced.
pybind11::str python_of(std::string_view text);
/// Dictionaries, lists, texts, numbers, True, False, and None also in place of numbers that are not finite.
pybind11::object python_of(const nlohmann::ordered_json& tree);
/// Counts are whole numbers; a number that is missing is NaN, a text "".
pybind11::object python_of(const ColumnDescription& column, const CellValue& value);

/// Lists by the names of the columns.
template <class Row, std::ranges::input_range Rows>
pybind11::dict table_of(const Columns<Row>& columns, const Rows& rows) {
  pybind11::dict table;
  for (const Column<Row>& column : columns) {
    pybind11::list values;
    for (const Row& row : rows) values.append(python_of(column, column.value(row)));
    table[column.name.c_str()] = values;
  }
  return table;
}

}  // namespace rheocyte
