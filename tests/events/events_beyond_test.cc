// Events beyond a table: on which side, and what they say of the median.
#include "events/events_beyond.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rheocyte::events_beyond_test {
namespace {

TEST(EventsBeyond, AreNamedBySideWithTheirShares) {
  EventsBeyond beyond;
  EXPECT_EQ(beyond.shares(100), "");
  beyond.add(TableSide::softer, 31);
  beyond.add(TableSide::larger, 5);
  beyond.add(TableSide::rounder, 0);
  EXPECT_EQ(beyond.all(), 36U);
  EXPECT_EQ(beyond.shares(100), "31 % softer and 5 % larger");
  EXPECT_EQ(beyond.shares(2000), "2 % softer") << "less than half a per cent is not worth a word";
}

TEST(EventsBeyond, HaveAMajorityOnOneSideAlone) {
  EventsBeyond beyond;
  beyond.add(TableSide::softer, 30);
  beyond.add(TableSide::smaller, 40);
  EXPECT_EQ(beyond.majority(100), "") << "the median cell lies between both sides";
  beyond.add(TableSide::longer, 21);
  EXPECT_EQ(beyond.majority(100), "51 % of 100 events are softer or longer") << "both are deformed further";
  EXPECT_EQ(beyond.majority(102), "") << "exactly half of them";
}

/// Nothing is known of the other cells: they may all be above.
TEST(EventsBeyond, BoundTheMedianOfAllByThatOfTheKnownOnes) {
  EXPECT_FALSE(bound_of_median({1, 2, 3}, 6));
  EXPECT_EQ(bound_of_median({4, 1, 3, 2}, 6), 4) << "three of six may lie above 3";
  EXPECT_EQ(bound_of_median({4, 1, 3, 2, 5}, 5), 3) << "then it is their median";
}

}  // namespace
}  // namespace rheocyte::events_beyond_test
