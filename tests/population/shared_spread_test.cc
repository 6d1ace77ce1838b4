#include "population/shared_spread.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

namespace rheocyte::shared_spread_test {
namespace {

ParameterVector normal(std::mt19937& random) {
  std::normal_distribution<double> one;
  ParameterVector z;
  for (double& x : z) x = one(random);
  return z;
}

ParameterMatrix random_root(std::mt19937& random) {
  ParameterMatrix root;
  for (int j = 0; j < root.cols(); ++j) root.col(j) = 0.05 * normal(random);
  return root + 0.1 * ParameterMatrix::Identity();
}

TEST(SharedSpread, IsTheSolutionOfAllEstimatesTogether) {
  // Generalised least squares for the means of each recording and one set of spreads, in one dense system.
  std::mt19937 random(4);
  constexpr int count = 3, unknowns = 2 * count + 3;
  std::vector<RecordingLaw> laws;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd score = Eigen::VectorXd::Zero(unknowns);
  for (int j = 0; j < count; ++j) {
    const ParameterMatrix root = random_root(random);
    laws.push_back({normal(random), root * root.transpose()});
    Eigen::MatrixXd picks = Eigen::MatrixXd::Zero(population_parameters, unknowns);
    picks.block(0, 2 * j, 2, 2).setIdentity();
    picks.block(2, 2 * count, 3, 3).setIdentity();
    const ParameterMatrix precision = laws.back().covariance.inverse();
    information += picks.transpose() * precision * picks;
    score += picks.transpose() * precision * laws.back().parameters;
  }
  const Eigen::MatrixXd covariance = information.inverse();
  const Eigen::VectorXd solution = covariance * score;
  share_spread(laws);
  for (int j = 0; j < count; ++j) {
    EXPECT_LT((laws[j].parameters.head<2>() - solution.segment<2>(2 * j)).norm(), 1e-10);
    EXPECT_LT((laws[j].parameters.tail<3>() - solution.tail<3>()).norm(), 1e-10);
    EXPECT_LT((laws[j].covariance.topLeftCorner<2, 2>() - covariance.block(2 * j, 2 * j, 2, 2)).norm(), 1e-10);
    EXPECT_LT((laws[j].covariance.topRightCorner<2, 3>() - covariance.block(2 * j, 2 * count, 2, 3)).norm(), 1e-10);
    EXPECT_LT((laws[j].covariance.bottomRightCorner<3, 3>() - covariance.bottomRightCorner<3, 3>()).norm(), 1e-10);
  }
}

TEST(SharedSpread, HowUnlikeTheSpreadsAreIsChiSquared) {
  // Of 2000 experiments with five recordings each the mean of chi squared with 12 degrees of freedom is 12 +- 0.11, and
  // p is below 0.05 in 5 +- 0.5 %.
  std::mt19937 random(5);
  double sum = 0;
  int rejected = 0;
  constexpr int experiments = 2000;
  for (int k = 0; k < experiments; ++k) {
    std::vector<RecordingLaw> laws;
    for (int j = 0; j < 5; ++j) {
      const ParameterMatrix root = random_root(random);
      laws.push_back({root * normal(random), root * root.transpose()});
    }
    const SpreadsApart apart = share_spread(laws);
    EXPECT_EQ(apart.freedom, 12);
    sum += apart.chi_squared;
    rejected += apart.p < 0.05;
  }
  EXPECT_NEAR(sum / experiments, 12, 0.4);
  EXPECT_NEAR(double(rejected) / experiments, 0.05, 0.02);
}

TEST(SharedSpread, OneRecordingStaysAsItIs) {
  std::vector<RecordingLaw> one{{ParameterVector::Constant(0.3), ParameterMatrix::Identity()}};
  EXPECT_TRUE(std::isnan(share_spread(one).p));
  EXPECT_EQ(one[0].parameters, ParameterVector::Constant(0.3));
}

}  // namespace
}  // namespace rheocyte::shared_spread_test
