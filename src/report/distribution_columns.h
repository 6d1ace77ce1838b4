// Columns of the distribution of a quantity among events: quartiles, and the median with its standard error.
#pragma once
#include <string>
#include <string_view>

#include "extract/distribution.h"
#include "report/column.h"

namespace rheocyte {

/// What is distributed; the unit as in names of columns and as it is written.
struct DistributedQuantity {
  std::string name, unit_in_names;
  std::string_view unit;
  std::string label, sentence;

  /// Of a statistic: young_modulus_median_kPa.
  ColumnDescription column(const std::string& statistic, const std::string& in_words) const {
    std::string column = name + "_" + statistic;
    if (!unit_in_names.empty()) column += "_" + unit_in_names;
    return {.name = std::move(column),
            .unit = unit,
            .label = label + ", " + in_words,
            .sentence = in_words + " of " + sentence,
            .digits = digits_of_values};
  }
};

/// Median with its standard error, first and third quartile; `of`: the distribution of a row.
template <class Row, class Of>
void add_quartiles(ColumnList<Row>& list, const DistributedQuantity& quantity, Of of) {
  const auto number = [of](double Distribution::*which) {
    return [of, which](const Row& row) { return of(row).*which; };
  };
  list.add_with_error(quantity.column("median", "median"), number(&Distribution::median),
                      number(&Distribution::median_error));
  list.add(quantity.column("first_quartile", "first quartile"), number(&Distribution::first_quartile));
  list.add(quantity.column("third_quartile", "third quartile"), number(&Distribution::third_quartile));
}

}  // namespace rheocyte
