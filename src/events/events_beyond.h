// Events beyond the cells of a table, by the side on which they lie: they count there, although they have no modulus.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

enum class TableSide { softer, longer, rounder, smaller, larger, count };
std::string_view name_of(TableSide side);

class EventsBeyond {
 public:
  void add(TableSide side, std::size_t events = 1) { counts_[std::size_t(side)] += events; }
  void add(const EventsBeyond& others);
  std::size_t on(TableSide side) const { return counts_[std::size_t(side)]; }
  std::size_t all() const;
  /// "31 % softer and 22 % longer" of so many events, those sides with half a per cent and more; else empty.
  std::string shares(std::size_t events) const;
  /// Where more than half of so many events lie on one side: "54 % of 2147 events are softer or longer"; else empty.
  /// Softer cells and longer ones lie on the same.
  std::string majority(std::size_t events) const;

 private:
  std::array<std::size_t, std::size_t(TableSide::count)> counts_{};
};

/// Below which value the median of so many cells lies, if some of them are known to be below a value each, and of the
/// others nothing is known; nothing if these are not more than half of all.
std::optional<double> bound_of_median(std::vector<double> below, std::size_t all);

}  // namespace rheocyte
