// Rows of columns as dictionaries of Python.
#pragma once
#include <pybind11/stl.h>

#include "report/column.h"

namespace rheocyte {

/// By the names of the columns, with the numbers as texts give them; None where a column has no value.
template <class Row>
pybind11::dict row_dict(const Columns<Row>& columns, const Row& row) {
  pybind11::dict dict;
  for (const auto& column : columns) {
    const CellValue value = printed_value(column, column.value(row));
    dict[column.name.c_str()] = has_value(value) ? pybind11::cast(value) : pybind11::none();
  }
  return dict;
}

}  // namespace rheocyte
