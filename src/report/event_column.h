// Columns with a number for each event, declared once: text tables, companions, the data frames of Python and the
// features of the view are made from lists of these (report/event_columns.h, moduli_columns.h).
#pragma once
#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/column.h"

namespace rheocyte {

/// With the values of the events of a block, which lie in the block, or in the room until it is used again.
template <class Block>
struct ColumnOf : ColumnDescription {
  std::function<std::span<const double>(const Block&, std::vector<double>& room)> values;
};

template <class Block>
using ColumnsOf = std::vector<ColumnOf<Block>>;

/// The values that a block holds as they are.
template <class Block>
auto stored(std::span<const double> Block::*part) {
  return [part](const Block& block, std::vector<double>&) { return block.*part; };
}

/// A number of each of the things that a block holds.
template <class Block, class One, class Number>
auto of_each(std::span<const One> Block::*part, Number number) {
  return [part, number](const Block& block, std::vector<double>& room) -> std::span<const double> {
    room.resize((block.*part).size());
    std::ranges::transform(block.*part, room.begin(),
                           [&](const One& one) { return static_cast<double>(std::invoke(number, one)); });
    return room;
  };
}

/// All columns of one block after the other.
template <class Block>
class BlockValues {
 public:
  explicit BlockValues(ColumnsOf<Block> columns)
      : columns_(std::move(columns)), rooms_(columns_.size()), values_(columns_.size()) {}

  const ColumnsOf<Block>& columns() const { return columns_; }
  /// One span a column, until the next call.
  std::span<const std::span<const double>> of(const Block& block) {
    for (std::size_t k = 0; k < columns_.size(); ++k) values_[k] = columns_[k].values(block, rooms_[k]);
    return values_;
  }

 private:
  ColumnsOf<Block> columns_;
  std::vector<std::vector<double>> rooms_;
  std::vector<std::span<const double>> values_;
};

/// The number of an event; of a flag what it says.
inline CellValue cell_value(const ColumnDescription& column, double number) {
  return column.is_flag ? CellValue(number != 0) : CellValue(number);
}

/// Without their values.
template <class Block>
std::vector<ColumnDescription> descriptions(const ColumnsOf<Block>& columns) {
  return {columns.begin(), columns.end()};
}

}  // namespace rheocyte
