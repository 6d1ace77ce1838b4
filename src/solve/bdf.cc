#include "solve/bdf.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {
namespace {

/// A step may grow by this factor at once; less keeps formulas of variable step stable at high order.
constexpr double max_growth = 1.8, min_growth = 0.3;
/// A growth below this is not worth the change: equal steps keep the errors smooth.
constexpr double worthwhile_growth = 1.2;
/// Of the step that the error estimate permits.
constexpr double safety = 0.85;

double permitted(int order, double error) { return safety * std::pow(std::max(error, 1e-12), -1.0 / (order + 1)); }

}  // namespace

Eigen::VectorXd extrapolation_weights(std::span<const double> past, double time) {
  const int n = int(past.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (j != i) weights(i) *= (time - past[j]) / (past[i] - past[j]);
    }
  }
  return weights;
}

BdfFormula bdf_formula(std::span<const double> past, int order, double time) {
  BdfFormula formula;
  formula.weights.resize(order);
  for (int j = 0; j < order; ++j) formula.rate += 1 / (time - past[j]);
  for (int i = 0; i < order; ++i) {
    double slope = 1 / (past[i] - time);  // of Lagrange's polynomial that is 1 at past[i], at `time`
    for (int j = 0; j < order; ++j) {
      if (j != i) slope *= (time - past[j]) / (past[i] - past[j]);
    }
    formula.weights(i) = slope;
  }
  // The errors of formula and extrapolation are multiples of the same divided difference of order + 2 values.
  if (int(past.size()) > order) formula.error_fraction = 1 / (formula.rate * (time - past[order]) + 1);
  return formula;
}

StepChoice choose_step(int order, const StepErrors& errors) {
  StepChoice best{order, permitted(order, errors.same)};
  if (errors.below >= 0 && permitted(order - 1, errors.below) > 1.1 * best.factor)
    best = {order - 1, permitted(order - 1, errors.below)};
  if (errors.above >= 0 && permitted(order + 1, errors.above) > 1.1 * best.factor)
    best = {order + 1, permitted(order + 1, errors.above)};
  best.factor = std::clamp(best.factor, min_growth, max_growth);
  if (best.order == order && best.factor > 1 && best.factor < worthwhile_growth) best.factor = 1;
  return best;
}

double shortening(int order, double error) {
  if (!std::isfinite(error)) return 0.25;
  return std::clamp(permitted(order, error), 0.2, 0.8);
}

}  // namespace rheocyte
