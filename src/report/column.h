// Everything that leaves the program about recordings is a column, declared once: its name, unit, label and sentence,
// and how its value follows from a row. Rows are recordings, conditions, comparisons, checks, cells or channels; events
// come in blocks of many (report/event_column.h). Text tables (report/rows_text.h), JSON (report/rows_json.h), Python's
// frames and the page's rows are made from lists of columns.
//
// Names: the quantity, then the statistic if it is that of several cells, then the unit: young_modulus_kPa,
// young_modulus_median_kPa. The standard error of x is x_error, what all events have in common of it x_common_error,
// the ends of its interval are x_low and x_high. Former names: report/former_names.h.
#pragma once
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace rheocyte {

/// All about a column but its values.
struct ColumnDescription {
  std::string name;            ///< with its unit
  std::string_view unit = {};  ///< as it is written; empty for pure numbers
  std::string label = {};      ///< for the eye, without the unit
  std::string sentence = {};   ///< what it is
  std::string role = {};       ///< in a companion, which has few names; empty: it is not there
  int rank = 0;                ///< of the role: the least ones have names first; 0: a feature of the field's programs
  int digits = 0;              ///< in text; 0: of rows 6, of events as many as give back single precision
  std::span<const std::string_view> words = {};  ///< for which the numbers stand
  bool is_flag = false;
};

/// NaN and an empty text are no value. A flag is "yes" or "no" in text, true or false elsewhere.
using CellValue = std::variant<double, std::string, bool>;

inline constexpr int digits_of_counts = 15, digits_of_values = 6, digits_of_errors = 3;

template <class Row>
struct Column : ColumnDescription {
  std::function<CellValue(const Row&)> value;
};

template <class Row>
using Columns = std::vector<Column<Row>>;

/// What a function of the row says, whatever kind of number, text or flag it is.
template <class Row, class Value>
std::function<CellValue(const Row&)> value_of(Value value) {
  return [value](const Row& row) -> CellValue {
    using Result = std::remove_cvref_t<decltype(std::invoke(value, row))>;
    if constexpr (std::is_same_v<Result, bool> || std::is_same_v<Result, CellValue>)
      return std::invoke(value, row);
    else if constexpr (std::is_arithmetic_v<Result>)
      return static_cast<double>(std::invoke(value, row));
    else
      return std::string(std::invoke(value, row));
  };
}

/// A list of columns that grows: one call for a number with its error, or with its interval.
template <class Row>
class ColumnList {
 public:
  /// `value`: a member of the row, or a function of it, with a number, a text or a flag.
  template <class Value>
  ColumnList& add(ColumnDescription about, Value value) {
    all_.push_back({std::move(about), value_of<Row>(value)});
    return *this;
  }
  template <class Value>
  ColumnList& add_count(const std::string& name, Value value) {
    return add({.name = name, .digits = digits_of_counts}, value);
  }
  /// x and x_error.
  template <class Value, class Error>
  ColumnList& add_with_error(const ColumnDescription& about, Value value, Error error) {
    add(about, value);
    return add(beside(about, "_error", "standard error"), error);
  }
  /// x, x_error and x_common_error.
  template <class Value, class Error, class Common>
  ColumnList& add_with_errors(const ColumnDescription& about, Value value, Error error, Common common) {
    add_with_error(about, value, error);
    return add(beside(about, "_common_error", "standard error that all events have in common"), common);
  }
  /// x, x_low and x_high.
  template <class Value, class Low, class High>
  ColumnList& add_with_interval(const ColumnDescription& about, Value value, Low low, High high) {
    add(about, value);
    add(beside(about, "_low", "lower end of the interval"), low);
    return add(beside(about, "_high", "upper end of the interval"), high);
  }
  /// Columns of a part of the row: of a member, or of what a function of the row returns; rows for which that is a null
  /// pointer have no value. Names begin with `start`.
  template <class Part, class Get>
  ColumnList& add_of(const Columns<Part>& columns, Get part, const std::string& start = {}) {
    for (const Column<Part>& column : columns) {
      all_.push_back({column, value_of_part<Part>(column, part)});
      all_.back().name.insert(0, start);
    }
    return *this;
  }
  Columns<Row> columns() && { return std::move(all_); }

 private:
  template <class Part, class Get>
  static std::function<CellValue(const Row&)> value_of_part(const Column<Part>& column, Get part) {
    if constexpr (std::is_pointer_v<std::invoke_result_t<Get, const Row&>>)
      return [value = column.value, part, none = none_like(column.value(Part{}))](const Row& row) {
        const Part* const one = std::invoke(part, row);
        return one ? value(*one) : none;
      };
    else
      return [value = column.value, part](const Row& row) { return value(std::invoke(part, row)); };
  }
  static CellValue none_like(const CellValue& value) {
    return std::holds_alternative<std::string>(value) ? CellValue(std::string())
                                                      : CellValue(std::numeric_limits<double>::quiet_NaN());
  }
  static ColumnDescription beside(ColumnDescription about, const std::string& ending, const std::string& words) {
    about.sentence = words + " of " + about.name;
    if (!about.label.empty()) about.label += ", " + words;
    about.name += ending;
    about.role = {};
    if (ending.ends_with("_error") && about.digits == 0) about.digits = digits_of_errors;
    return about;
  }

  Columns<Row> all_;
};

/// A number with the digits of its column, the word for which it stands, a text, "yes" or "no".
std::string cell_text(const ColumnDescription& column, const CellValue& value);

/// The value that its text gives: the same number in all outputs.
CellValue printed_value(const ColumnDescription& column, const CellValue& value);

/// Whether it is one: no NaN or infinity, no empty text.
bool has_value(const CellValue& value);

}  // namespace rheocyte
