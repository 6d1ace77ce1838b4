// Columns with one value a row, declared once, whether the rows are recordings or cells: for text tables, JSON and
// Python.
#pragma once
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace rheocyte {

/// NaN and an empty text are no value.
using CellValue = std::variant<double, std::string>;

template <class Row>
struct RowColumn {
  std::string name;  ///< with its unit
  std::function<CellValue(const Row&)> value;
  int digits = 6;  ///< of numbers in text
};

/// A number with so many digits.
std::string cell_text(const CellValue&, int digits);

template <class Row>
using RowColumns = std::vector<RowColumn<Row>>;

}  // namespace rheocyte
