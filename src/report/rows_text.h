// Rows as tab-separated text: the names of the columns, then a line for each row.
#pragma once
#include <algorithm>
#include <cmath>
#include <ranges>
#include <string>

#include "case/user_error.h"
#include "report/column.h"

namespace rheocyte {

/// Without what would end a cell or a line.
inline std::string table_cell(std::string text) {
  std::ranges::replace(text, '\t', ' ');
  return one_line(text, 1000);
}

template <class Row>
std::string header_text(const Columns<Row>& columns) {
  std::string text;
  for (const auto& column : columns) text.append(text.empty() ? "" : "\t").append(column.name);
  return text + "\n";
}

/// A cell that is NaN is `missing`.
template <class Row, std::ranges::input_range Rows>
std::string rows_text(const Columns<Row>& columns, const Rows& rows, const std::string& missing = "nan") {
  std::string text = header_text(columns);
  for (const Row& row : rows)
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const CellValue value = columns[k].value(row);
      const auto* const number = std::get_if<double>(&value);
      text.append(number && std::isnan(*number) ? missing : table_cell(cell_text(columns[k], value)));
      text.append(k + 1 < columns.size() ? "\t" : "\n");
    }
  return text;
}

}  // namespace rheocyte
