// The columns of all events of a recording, on their way from a child of the process to Python.
#pragma once
#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <vector>

#include "python/shared_columns.h"
#include "report/event_column.h"

namespace rheocyte {

/// Columns in shared memory, and what is said about them in sentences.
struct GatheredEvents {
  std::uint64_t events = 0;
  std::vector<SharedColumn> columns;
  std::vector<std::string> settings, warnings;
  std::string settings_hash;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.events, s.columns, s.settings, s.warnings, s.settings_hash);
  }

  /// A pair: SharedColumns::arrays, and `said` with the rest.
  pybind11::tuple to_python(const SharedColumns& memory, const pybind11::dict& said = {}) const {
    said["settings"] = settings;
    said["warnings"] = warnings;
    said["settings_hash"] = settings_hash;
    return pybind11::make_tuple(memory.arrays(columns, events), said);
  }
};

template <class Block>
class GatheredColumns {
 public:
  explicit GatheredColumns(ColumnsOf<Block> columns) : values_(std::move(columns)), all_(values_.columns().size()) {}

  void append(const Block& block) {
    const auto values = values_.of(block);
    for (std::size_t k = 0; k < all_.size(); ++k) all_[k].insert(all_[k].end(), values[k].begin(), values[k].end());
  }
  std::size_t events() const { return all_.front().size(); }
  /// Into the memory that Python reads.
  std::vector<SharedColumn> write(const SharedColumns& memory) const {
    std::vector<SharedColumn> written;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      const ColumnDescription& column = values_.columns()[k];
      SharedColumn& told = written.emplace_back(
          SharedColumn{column.name, std::string(column.unit), {column.words.begin(), column.words.end()}});
      told.is_bytes = column.is_flag || !told.words.empty();
      if (told.is_bytes)
        memory.write(std::vector<std::int8_t>(all_[k].begin(), all_[k].end()));
      else
        memory.write(all_[k]);
    }
    return written;
  }

 private:
  BlockValues<Block> values_;
  std::vector<std::vector<double>> all_;
};

}  // namespace rheocyte
