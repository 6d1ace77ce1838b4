// Laws of cells by the moments of their events: against what is known of normal distributions.
#include "population/fit_moments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numeric/cell_random.h"

namespace rheocyte::fit_moments_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Three measures of two numbers a, b of a cell: a + curve b^2, a - b, 2 b, with noise. The means of a and b are
/// parameters, and ln of their spreads.
class ThreeMeasures : public MomentModel {
 public:
  explicit ThreeMeasures(double curve) : curve_(curve) {}

  int means() const override { return 2; }
  Moments at(const VectorXd& q) const override {
    const double a = q(0), b = q(1), va = std::exp(2 * q(2)), vb = std::exp(2 * q(3));
    Moments moments{VectorXd(3), MatrixXd(3, 3)};
    moments.mean << a + curve_ * (b * b + vb), a - b, 2 * b;
    const double slope = 2 * curve_ * b, bent = 2 * curve_ * curve_ * vb * vb;  // variance of b^2 about its mean
    MatrixXd by(3, 2);
    by << 1, slope, 1, -1, 0, 2;
    moments.covariance = by * Eigen::Vector2d(va, vb).asDiagonal() * by.transpose();
    moments.covariance(0, 0) += bent;
    moments.covariance.diagonal().array() += noise * noise;
    return moments;
  }
  MomentSlopes slopes(const VectorXd& q) const override {
    constexpr double step = 1e-5;
    MomentSlopes all{at(q), {}};
    for (int a = 0; a < 4; ++a) {
      const Moments above = at(q + step * VectorXd::Unit(4, a)), below = at(q - step * VectorXd::Unit(4, a));
      all.by_parameter.push_back(
          {(above.mean - below.mean) / (2 * step), (above.covariance - below.covariance) / (2 * step)});
    }
    return all;
  }

  /// Of cells with these means and spreads.
  MatrixXd events(int count, std::uint64_t seed, double a, double b, double sa, double sb) const {
    MatrixXd rows(count, 3);
    for (int i = 0; i < count; ++i) {
      CellRandom random(seed, std::uint64_t(i), Purpose::population);
      const double x = a + sa * random.normal(), y = b + sb * random.normal();
      rows.row(i) << x + curve_ * y * y, x - y, 2 * y;
      for (int k = 0; k < 3; ++k) rows(i, k) += noise * random.normal();
    }
    return rows;
  }

  static constexpr double noise = 0.1;

 private:
  double curve_;
};

MomentSettings settings() {
  MomentSettings s;
  s.least = VectorXd::Constant(4, -5), s.greatest = VectorXd::Constant(4, 5);
  s.common_covariance = MatrixXd::Zero(3, 3);
  return s;
}

const VectorXd start = Eigen::Vector4d(0.5, 0.5, std::log(0.3), std::log(0.3));

TEST(FitMoments, MeansAndSpreadsComeBackWithinTheirErrors) {
  const ThreeMeasures model(0.3);
  const Eigen::Vector4d truth(1, 2, std::log(0.2), std::log(0.15));
  constexpr int experiments = 40;
  Eigen::Vector4d bias = Eigen::Vector4d::Zero(), squares = bias, stated = bias;
  for (std::uint64_t seed = 0; seed < experiments; ++seed) {
    const MomentFit fit = fit_moments(model, model.events(400, seed, 1, 2, 0.2, 0.15), start, settings());
    ASSERT_TRUE(fit.is_found);
    const Eigen::Vector4d off = fit.parameters - truth;
    bias += off / experiments;
    squares += off.cwiseAbs2() / experiments;
    stated += fit.covariance.diagonal() / experiments;
  }
  for (int a = 0; a < 4; ++a) {
    EXPECT_LT(std::abs(bias(a)), 3 * std::sqrt(stated(a) / experiments)) << a;
    EXPECT_NEAR(squares(a) / stated(a), 1, 3 * std::sqrt(2.0 / experiments)) << "chi squared of the experiments, " << a;
  }
}

// A scatter that the law does not have, of the first measure alone: if the means follow from the means, it moves the
// spreads and not them.
TEST(FitMoments, AScatterOfAnotherKindMovesTheSpreadsOnly) {
  const ThreeMeasures model(0);
  MatrixXd events = model.events(4000, 3, 1, 2, 0.2, 0.15);
  for (Eigen::Index i = 0; i < events.rows(); ++i)
    events(i, 0) += 0.5 * CellRandom(9, std::uint64_t(i), Purpose::place).normal();
  const MomentFit fit = fit_moments(model, events, start, settings());
  ASSERT_TRUE(fit.is_found);
  for (const int a : {0, 1}) EXPECT_NEAR(fit.parameters(a), a + 1, 3 * std::sqrt(fit.covariance(a, a))) << a;
  EXPECT_GT(fit.parameters(2), std::log(0.2));
}

TEST(FitMoments, ACommonShiftMovesTheMeansAsItIsSaid) {
  const ThreeMeasures model(0.3);
  const MatrixXd events = model.events(500, 5, 1, 2, 0.2, 0.15);
  const MomentFit fit = fit_moments(model, events, start, settings());
  constexpr double shift = 1e-3;
  for (int k = 0; k < 3; ++k) {
    MatrixXd shifted = events;
    shifted.col(k).array() += shift;
    const MomentFit moved = fit_moments(model, shifted, fit.parameters, settings());
    for (int a = 0; a < 2; ++a)
      EXPECT_NEAR((moved.parameters(a) - fit.parameters(a)) / shift, fit.by_shift(a, k), 0.05) << a << " by " << k;
  }
}

TEST(FitMoments, StrangersDoNotCount) {
  const ThreeMeasures model(0);
  MatrixXd events = model.events(300, 7, 1, 2, 0.2, 0.15);
  events.topRows(5).array() += 8;
  const MomentFit fit = fit_moments(model, events, start, settings());
  ASSERT_TRUE(fit.is_found);
  EXPECT_EQ(fit.events, 295U);
  EXPECT_TRUE(fit.is_stranger[0] && fit.is_stranger[4]);
  EXPECT_NEAR(fit.parameters(0), 1, 0.05);
}

TEST(FitMoments, WhatNothingScattersIsAtItsBound) {
  const ThreeMeasures model(0);
  MomentSettings s = settings();
  s.least.tail(2).setConstant(std::log(0.05));
  const MomentFit fit = fit_moments(model, model.events(200, 8, 1, 2, 0.2, 0), start, s);
  ASSERT_TRUE(fit.is_found);
  EXPECT_TRUE(fit.at_bound[3]);
  EXPECT_FALSE(fit.at_bound[2]);
  EXPECT_EQ(fit.covariance(3, 3), 0);
}

TEST(FitMoments, AMeanAtItsBoundIsNotKnownForThat) {
  // The bound is the model's. What depends on this mean is known about as well as if there were no bound, not better.
  const ThreeMeasures model(0.3);
  const MatrixXd events = model.events(500, 11, 1, 2, 0.2, 0.15);
  MomentSettings bounded = settings();
  bounded.greatest(1) = 1.97;
  const MomentFit without = fit_moments(model, events, start, settings()),
                  fit = fit_moments(model, events, start, bounded);
  ASSERT_TRUE(without.is_found && fit.is_found);
  EXPECT_TRUE(fit.at_bound[1]);
  EXPECT_EQ(fit.parameters(1), 1.97);
  for (const int a : {0, 1}) EXPECT_NEAR(fit.covariance(a, a) / without.covariance(a, a), 1, 0.3) << a;
}

}  // namespace
}  // namespace rheocyte::fit_moments_test
