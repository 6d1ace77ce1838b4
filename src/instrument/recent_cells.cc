#include "instrument/recent_cells.h"

#include <algorithm>
#include <vector>

namespace rheocyte {

RecentCells::RecentCells(std::size_t remembered)
    : remembered_(remembered), places_count_(2 * remembered), places_(std::make_unique<Place[]>(places_count_)) {}

// Whoever reads a number here, or one that was stored later, reads `next_` at least as it was before.
void RecentCells::add(double area_um2, double deformation, double inertia_ratio) {
  const std::uint64_t next = next_.load(std::memory_order_relaxed);
  Place& place = places_[next % places_count_];
  place.area_um2.store(area_um2, std::memory_order_release);
  place.deformation.store(deformation, std::memory_order_release);
  place.inertia_ratio.store(inertia_ratio, std::memory_order_release);
  next_.store(next + 1, std::memory_order_release);
}

void RecentCells::collect(EventFigures& figures) const {
  struct Cell {
    double area_um2, deformation, inertia_ratio;
  };
  const std::uint64_t end = next_.load(std::memory_order_acquire), first = first_.load(std::memory_order_acquire);
  const std::uint64_t start = std::min(end, std::max(first, end - std::min<std::uint64_t>(end, remembered_)));
  std::vector<Cell> cells;
  cells.reserve(end - start);
  for (std::uint64_t i = start; i < end; ++i) {
    const Place& place = places_[i % places_count_];
    cells.push_back({place.area_um2.load(std::memory_order_acquire), place.deformation.load(std::memory_order_acquire),
                     place.inertia_ratio.load(std::memory_order_acquire)});
  }
  // The cell that is being added now may have been written over one of them.
  const std::uint64_t added = next_.load(std::memory_order_acquire) + 1;
  const std::uint64_t whole = added > places_count_ ? added - places_count_ : 0;
  for (std::uint64_t i = std::max(start, whole); i < end; ++i) {
    const auto& [area_um2, deformation, inertia_ratio] = cells[i - start];
    figures.take(area_um2, deformation, inertia_ratio);
  }
}

}  // namespace rheocyte
