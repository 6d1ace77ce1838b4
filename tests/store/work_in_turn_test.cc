// Pieces are done in turn; what one throws reaches its caller.
#include "store/work_in_turn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace rheocyte::work_in_turn_test {
namespace {

TEST(WorkInTurn, PiecesAreDoneInTheOrderInWhichTheyAreGiven) {
  std::vector<int> done;
  WorkInTurn work;
  for (int i = 0; i < 1000; ++i) work.add([&done, i] { done.push_back(i); });
  work.finish();
  ASSERT_EQ(done.size(), 1000U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(done[std::size_t(i)], i);
  work.add([&done] { done.clear(); });
  work.finish();
  EXPECT_TRUE(done.empty());
}

TEST(WorkInTurn, AFailureIsThrownAndNothingIsDoneAfterIt) {
  std::atomic<int> done = 0;
  WorkInTurn work;
  const auto give_all = [&] {
    for (int i = 0; i < 100; ++i) {
      work.add([&done, i] {
        if (i == 7) throw std::runtime_error("the disk is full");
        ++done;
      });
    }
    work.finish();
  };
  EXPECT_THROW(give_all(), std::runtime_error);
  EXPECT_EQ(done, 7);
}

TEST(WorkInTurn, WhatWaitsIsDroppedWhenItGoes) {
  std::atomic<int> begun = 0, ended = 0;
  {
    WorkInTurn work;
    for (int i = 0; i < 5; ++i) {
      work.add([&] {
        ++begun;
        ++ended;
      });
    }
  }
  EXPECT_EQ(begun, ended);
  EXPECT_LE(ended, 5);
}

TEST(WorkInTurn, WithoutWorkThereIsNothingToWaitFor) {
  WorkInTurn work;
  work.finish();
}

}  // namespace
}  // namespace rheocyte::work_in_turn_test
