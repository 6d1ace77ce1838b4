// Columns of a part of the rows, such as one quantity of several.
#pragma once
#include <functional>

#include "numeric/no_value.h"
#include "report/column.h"

namespace rheocyte {

/// Rows for which `part_of` is null have no value in these columns.
template <class Row, class Part>
Columns<Row> columns_of_part(const Columns<Part>& columns, const std::function<const Part*(const Row&)>& part_of) {
  Columns<Row> all;
  for (const Column<Part>& column : columns) {
    const bool is_text = std::holds_alternative<std::string>(column.value(Part{}));
    const CellValue none = is_text ? CellValue(std::string()) : CellValue(no_value);
    all.push_back({column, [column, part_of, none](const Row& row) {
                     const Part* const part = part_of(row);
                     return part ? column.value(*part) : none;
                   }});
  }
  return all;
}

}  // namespace rheocyte
