#include "infer/course_normal.h"

#include <cmath>

#include "infer/time_course.h"
#include "numeric/dense_solve.h"

namespace rheocyte {

namespace {

/// Narrower than that the points of a cell, which lie a few per cent apart, do not resolve a population.
constexpr double min_variance = min_spread * min_spread;

/// What a cell adds: mean and variance about the population's mean of what it may be.
struct CellMoments {
  Eigen::Array2d first = Eigen::Array2d::Zero(), second = Eigen::Array2d::Zero();
};

CellMoments moments_of(const LikelyCells& cell, const CourseNormal& population) {
  CellMoments moments;
  double all = 0;
  for (std::size_t i = 0; i < cell.weight.size(); ++i) {
    const Eigen::Array2d away = Eigen::Array2d(cell.log_modulus[i], cell.log_viscosity[i]) - population.mean;
    const double weight = cell.weight[i] * std::exp(-(away.square() / population.variance).sum() / 2);
    all += weight;
    moments.first += weight * away;
    moments.second += weight * away.square();
  }
  if (all > 0) moments.first /= all, moments.second /= all;
  return moments;
}

}  // namespace

CourseNormal first_guess(const std::vector<LikelyCells>& cells) {
  CourseNormal flat;
  flat.variance.setConstant(1e6);
  Eigen::Array2d sum = Eigen::Array2d::Zero(), squares = sum;
  for (const LikelyCells& cell : cells) {
    const CellMoments moments = moments_of(cell, flat);
    sum += moments.first;
    squares += moments.first.square();
  }
  const double n = double(cells.size());
  return {sum / n, (squares / n - (sum / n).square()).max(0.01)};
}

CourseNormal most_likely(const std::vector<LikelyCells>& cells, CourseNormal population) {
  constexpr int max_steps = 400;
  constexpr double settled = 1e-5;
  for (int step = 0; step < max_steps; ++step) {
    Eigen::Array2d first = Eigen::Array2d::Zero(), second = first;
    for (const LikelyCells& cell : cells) {
      const CellMoments moments = moments_of(cell, population);
      first += moments.first;
      second += moments.second;
    }
    first /= double(cells.size());
    second /= double(cells.size());
    population.mean += first;
    population.variance = (second - first.square()).max(min_variance);
    if (first.abs().maxCoeff() < settled) break;
  }
  return population;
}

Eigen::Array2d errors_of(const std::vector<LikelyCells>& cells, const CourseNormal& population) {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (const LikelyCells& cell : cells) {
    const CellMoments moments = moments_of(cell, population);
    Eigen::Vector4d score;
    const auto is_free = (population.variance > min_variance).cast<double>();
    score << (moments.first / population.variance).matrix(),
        (is_free * (moments.second / population.variance - 1) / 2).matrix();
    information += score * score.transpose();
  }
  for (Eigen::Index i = 0; i < 2; ++i)
    if (!(population.variance[i] > min_variance)) information(2 + i, 2 + i) = 1;
  const Eigen::MatrixXd covariance = regular_inverse(information);
  if (covariance.size() == 0) return Eigen::Array2d::Constant(HUGE_VAL);
  return {std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1))};
}

}  // namespace rheocyte
