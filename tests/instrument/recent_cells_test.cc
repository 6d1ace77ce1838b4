// What a thread has seen lately, read by another one: always whole cells, and the last ones.
#include "instrument/recent_cells.h"

#include <gtest/gtest.h>

#include <thread>

namespace rheocyte::recent_cells_test {
namespace {

/// The numbers of a cell follow from each other.
void add(RecentCells& cells, double number) { cells.add(100 + number, number, 1 + number / 1e7); }

TEST(RecentCells, TheLastOnesAreRememberedInTheirOrder) {
  RecentCells cells(20);
  for (int i = 0; i < 137; ++i) add(cells, i);
  EventFigures found;
  cells.collect(found);
  ASSERT_EQ(found.area_um2.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(found.deformation[std::size_t(i)], 117 + i);
  cells.forget();
  add(cells, 5);
  EventFigures later;
  cells.collect(later);
  EXPECT_EQ(later.deformation, std::vector<double>{5});
}

TEST(RecentCells, AnotherThreadReadsWholeCells) {
  RecentCells cells(64);
  std::atomic<bool> goes_on = true;
  std::jthread adding([&] {
    for (int i = 0; goes_on; ++i) add(cells, i % 1'000'000);
  });
  constexpr std::size_t enough = 100'000;
  for (std::size_t read = 0; read < enough;) {
    EventFigures found;
    cells.collect(found);
    read += found.area_um2.size();
    for (std::size_t i = 0; i < found.area_um2.size(); ++i) {
      ASSERT_EQ(found.area_um2[i], 100 + found.deformation[i]);
      ASSERT_EQ(found.inertia_ratio[i], 1 + found.deformation[i] / 1e7);
    }
  }
  goes_on = false;
}

TEST(RecentCells, RedCellsAndMissingNumbersDoNotCount) {
  RecentCells cells(20);
  cells.add(50, 0.1, 2.5);
  cells.add(NAN, 0.1, 1.2);
  cells.add(80, 0.1, 1.2);
  EventFigures found;
  cells.collect(found);
  EXPECT_EQ(found.area_um2, std::vector<double>{80});
}

}  // namespace
}  // namespace rheocyte::recent_cells_test
