// The numbers of a cell are its own, the same everywhere, and distributed as they say.
#include "numeric/cell_random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::cell_random_test {
namespace {

TEST(CellRandom, GivesTheSameNumbersOnEveryMachine) {
  CellRandom random(1, 0, Purpose::population);
  const double first = random.uniform();
  EXPECT_EQ(first, CellRandom(1, 0, Purpose::population).uniform());
  EXPECT_NE(first, random.uniform());
  EXPECT_NE(first, CellRandom(2, 0, Purpose::population).uniform());
  EXPECT_NE(first, CellRandom(1, 1, Purpose::population).uniform());
  EXPECT_NE(first, CellRandom(1, 0, Purpose::place).uniform());
}

TEST(CellRandom, FirstNumbersOfManyCellsAreIndependentAndNormal) {
  constexpr int cells = 200000;
  double sum = 0, squares = 0, neighbours = 0, fourth = 0, before = 0;
  for (int i = 0; i < cells; ++i) {
    const double value = CellRandom(7, static_cast<std::uint64_t>(i), Purpose::population).normal();
    sum += value;
    squares += value * value;
    fourth += value * value * value * value;
    neighbours += value * before;
    before = value;
  }
  const double error = 1 / std::sqrt(double(cells));  // of a mean of numbers with variance 1
  EXPECT_NEAR(sum / cells, 0, 4 * error);
  EXPECT_NEAR(squares / cells, 1, 4 * std::sqrt(2) * error);
  EXPECT_NEAR(fourth / cells, 3, 4 * std::sqrt(96) * error);
  EXPECT_NEAR(neighbours / cells, 0, 4 * error);
}

}  // namespace
}  // namespace rheocyte::cell_random_test
