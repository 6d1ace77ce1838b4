// Rules of few nodes for means of smooth functions of numbers that are normally distributed: of all, or of those that
// pass a gate (docs/theory-populations.md, sec. "Several moduli").
#pragma once
#include <Eigen/Core>
#include <limits>

namespace rheocyte {

/// Of numbers that are independent of each other, in standard deviations from their means.
struct NormalNodes {
  Eigen::VectorXd weight;  ///< some are negative; they sum up to 1
  Eigen::MatrixXd place;   ///< a column for each node
};

/// Exact for polynomials up to the fifth degree (Smolyak's sum of Gauss-Hermite rules of three nodes). The first node
/// is the mean.
NormalNodes normal_nodes(int numbers);

/// What lies between its limits passes.
struct ValueGate {
  double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();

  bool pass(double value) const { return value > least && value < greatest; }
};

/// A value that is linear in the numbers.
struct GatedValue {
  double mean = 0;
  Eigen::VectorXd slope;  ///< by the numbers; the first one is positive
};

double fraction_within(const ValueGate& gate, const GatedValue& value);

/// Of the numbers whose value passes: the value has the Gauss rule of its own truncated distribution, so that
/// polynomials up to the fifth degree are exact again. Smooth in the value's mean and slope. More than about a
/// thousandth must pass.
NormalNodes kept_nodes(const ValueGate& gate, const GatedValue& value);

}  // namespace rheocyte
