// The cells that a thread has seen lately, which another thread reads at any time: neither waits for the other.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>

#include "extract/effective_cell.h"

namespace rheocyte {

class RecentCells {
 public:
  /// The last `remembered` ones, above 0.
  explicit RecentCells(std::size_t remembered);

  /// Only one thread adds and forgets.
  void add(double area_um2, double deformation, double inertia_ratio);
  void forget() { first_.store(next_.load(std::memory_order_relaxed), std::memory_order_release); }

  /// Adds those that count (EventFigures::take), the oldest first. Any thread.
  void collect(EventFigures& figures) const;

 private:
  struct Place {
    std::atomic<double> area_um2, deformation, inertia_ratio;
  };

  std::size_t remembered_;
  std::size_t places_count_;  ///< twice as many: a reader is not overtaken before so many cells have come
  std::unique_ptr<Place[]> places_;
  std::atomic<std::uint64_t> first_ = 0, next_ = 0;  ///< cells that count, and all of them
};

}  // namespace rheocyte
