// Columns of numbers that a child of the process computes and Python reads, without a copy.
#pragma once
#include <pybind11/pybind11.h>

#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "python/shared_memory.h"

namespace rheocyte {

/// One that was written; whole numbers of one byte, or 64-bit ones.
struct SharedColumn {
  std::string name, unit;
  std::vector<std::string> words;  ///< for which bytes stand; else they are truths
  bool is_bytes = false;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.name, s.unit, s.words, s.is_bytes);
  }
};

/// Constructing it throws std::system_error if there is no memory to share.
class SharedColumns {
 public:
  /// In the child: behind what was written before.
  void write(std::span<const double> column) const;
  void write(std::span<const std::int8_t> column) const;

  /// In the parent: a pair of the columns as numpy arrays, by their names, in the order in which they were written, all
  /// equally long, and of what is said about them: {"units": ..., "words": of columns that have them}.
  pybind11::tuple arrays(const std::vector<SharedColumn>& columns, std::size_t length) const;

 private:
  SharedMemory memory_;
};

}  // namespace rheocyte
