// Reference values: an implementation in another language, with arbitrary precision for the integrals.
#include "analytic/wall_reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rheocyte::wall_reflection_test {
namespace {

// Sums of 300 terms; the Bessel functions of the library are good to 1e-14.
constexpr double rounding = 1e-13;

TEST(WallReflection, MomentsAreThoseOfTheReference) {
  // Normalised moments of the wall integrals for p from 2 to 120.
  struct Moment {
    int p;
    double m, v;
  };
  constexpr Moment expected[] = {{2, 3.7926490140004, 1.3911297229580e+00},  {4, 1.7141976656122, 4.3304077333478e-01},
                                 {6, 1.3646077150264, 2.7020186623898e-01},  {8, 1.2375498074058, 2.0344121079145e-01},
                                 {10, 1.1758790209649, 1.6582874371580e-01}, {20, 1.0790033074663, 8.9430620068474e-02},
                                 {40, 1.0383306774301, 4.7121015786625e-02}, {80, 1.0189408174040, 2.4249954990198e-02},
                                 {120, 1.0125825013339, 1.6328740529834e-02}};
  const WallMoments moments = wall_moments(160);
  for (const auto& [p, m, v] : expected) {
    EXPECT_NEAR(moments.m(p / 2 - 1) / m, 1, rounding) << p;
    EXPECT_NEAR(moments.v(p / 2 - 1) / v, 1, rounding) << p;
  }
  EXPECT_NEAR(moments.lambda_0 / -4.4075353044687, 1, rounding);
}

TEST(WallReflection, HighMomentsTendToTheirLimit) {
  // m_p - 1 falls like 1/p: Delta tends to exp(2 k) / (2 pi k^2), whose moment is c_p, with corrections in 1/k.
  const WallMoments moments = wall_moments(320);
  EXPECT_NEAR((moments.m(159) - 1) * 320 / 1.5, 1, 0.02);
  EXPECT_NEAR((moments.m(79) - 1) * 160 / 1.5, 1, 0.03);
}

TEST(WallReflection, TheWallHoldsASmallSphereWithTheClassicalCoefficient) {
  // Drag of a small towed sphere: 6 pi eta r0 U (1 + 2.10444 r0/R), Faxen and Ladenburg.
  EXPECT_NEAR(-1.5 * wall_moments(2).lambda_0 / std::numbers::pi, 2.1044431, 5e-8);  // digits of the value
}

TEST(WallReflection, MatricesAreThoseOfTheReference) {
  // Coefficients of the first three functions that the wall reflects.
  const WallReflection wall = wall_reflection(3);
  Eigen::Array33d CA, DA, CB, DB;
  CA << -2.086694584437058, 0.4059757250013568, -0.11821331647955349,  //
      1.2980596458080345, -1.4517876848910092, 0.8819090342993748,     //
      -0.7018262061856592, 1.5082540645370417, -1.567732906009555;
  DA << 1.1377947042001066, -0.3214120623022929, 0.11940317506481068,  //
      -1.0713735410076433, 0.9950264588734224, -0.6767850509250208,    //
      0.688864471527754, -1.171358741985613, 1.2242850984505416;
  CB << -1.4029620611164786, 0.28371104931316476, -0.0761423684520826,  //
      0.34045325917579755, -1.3654531544691815, 0.829152547022659,      //
      -0.12690394742013766, 1.1516007597536928, -1.4617169445186098;
  DB << 0.41733891688741154, -0.216343274301339, 0.08421914474227914,  //
      -0.2706504833342379, 0.8065487138283385, -0.6033016258148167,    //
      0.13639998055333094, -0.8479894560570913, 1.0853535503143072;
  EXPECT_LT((wall.CA / CA - 1).abs().maxCoeff(), 10 * rounding);  // differences of a few moments
  EXPECT_LT((wall.DA / DA - 1).abs().maxCoeff(), 10 * rounding);
  EXPECT_LT((wall.CB / CB - 1).abs().maxCoeff(), 10 * rounding);
  EXPECT_LT((wall.DB / DB - 1).abs().maxCoeff(), 10 * rounding);
}

TEST(WallReflection, MoreFunctionsLeaveTheFirstEntriesAsTheyAre) {
  // An entry is an integral of its own; only the rounding of the recurrence in p may differ.
  const WallReflection few = wall_reflection(4), many = wall_reflection(80);
  EXPECT_TRUE(many.CB.isFinite().all() && many.DA.isFinite().all());
  EXPECT_LT((many.CB.topLeftCorner(4, 4) / few.CB - 1).abs().maxCoeff(), rounding);
}

}  // namespace
}  // namespace rheocyte::wall_reflection_test
