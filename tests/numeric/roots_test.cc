// Zeros are found to rounding wherever the signs differ, in few steps where the function is smooth.
#include "numeric/roots.h"

#include <gtest/gtest.h>

namespace rheocyte::roots_test {
namespace {

TEST(BracketedRoot, FindsZerosToRoundingInFewSteps) {
  int calls = 0;
  const auto counted = [&](auto f) { return [&calls, f](double x) { return ++calls, f(x); }; };
  EXPECT_NEAR(bracketed_root(counted([](double x) { return x * x - 2; }), 0, 2), std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(bracketed_root(counted([](double x) { return std::log(x) - 3; }), 1e-3, 1e5), std::exp(3.0), 1e-13);
  EXPECT_NEAR(bracketed_root(counted([](double x) { return 10 - std::exp(x); }), 50, 0), std::log(10.0), 1e-15);
  EXPECT_LT(calls, 60);
}

TEST(BracketedRoot, EndsAtAJumpAndAtAnEnd) {
  EXPECT_NEAR(bracketed_root([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0, 1), 0.3, 1e-15);
  EXPECT_EQ(bracketed_root([](double x) { return x; }, 0, 1), 0);
  EXPECT_EQ(bracketed_root([](double x) { return x - 1; }, 0, 1), 1);
}

TEST(BracketedRoot, AToleranceIsKept) {
  EXPECT_NEAR(bracketed_root([](double x) { return x * x * x - 5; }, 0, 9, 1e-3), std::cbrt(5.0), 2e-3);
}

TEST(BracketedNewton, StaysInTheBracketWhereNewtonWouldLeaveIt) {
  // Newton's step from 3 leaves it.
  const auto f = [](double x) { return ValueAndSlope{std::atan(x - 0.5), 1 / (1 + (x - 0.5) * (x - 0.5))}; };
  EXPECT_NEAR(bracketed_newton(f, 0, 4, 3, true, 1e-15), 0.5, 1e-15);
  const auto falling = [&](double x) { return ValueAndSlope{-f(x).value, -f(x).slope}; };
  EXPECT_NEAR(bracketed_newton(falling, 0, 4, 3, false, 1e-15), 0.5, 1e-15);
}

}  // namespace
}  // namespace rheocyte::roots_test
