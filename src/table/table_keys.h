// The declaration of the keys of a spec's section [table]: range, default and one sentence of each.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/parameters.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A number of the section; whole ones are counts.
struct TableNumber {
  Range range;
  bool is_whole = false;
  double (*get)(const TableSpec&);
  void (*set)(TableSpec&, double);
};

struct TableWord {
  std::string TableSpec::*field;
};

/// A list of numbers, ascending.
struct TableList {
  Range range;
  std::vector<double> TableSpec::*field;
};

struct TableKey {
  std::string_view key;  ///< dotted: "table.radii"
  std::string_view unit;
  std::string_view sentence;
  std::variant<TableNumber, TableWord, TableList> value;
};

/// All keys in the order in which they are documented and written. Defaults are those of TableSpec.
std::span<const TableKey> table_keys();

/// The key with this name, or null.
const TableKey* find_table_key(std::string_view key);

}  // namespace rheocyte
