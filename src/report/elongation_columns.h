// The columns of events by a table of elongated cells: in files, in Python and in the view.
#pragma once
#include <span>
#include <vector>

#include "extract/elongation_values.h"
#include "report/event_column.h"

namespace rheocyte {

struct ElongationColumn : ColumnDescription {
  std::span<const double> ElongationBlock::*of;
  bool is_error_of_elongation = false;  ///< or of the tension

  /// Of a block that has an ElongationBlock.
  template <class Block>
  auto values_in() const {
    return [of = of](const Block& block, std::vector<double>&) { return block.elongation.*of; };
  }
};

/// In their order; the modulus is named by what determines it.
std::vector<ElongationColumn> elongation_columns(ElongatedBy by);

}  // namespace rheocyte
