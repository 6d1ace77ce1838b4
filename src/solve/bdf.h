// Backward differentiation formulas with variable step and order (docs/theory-time.md, eq:bdf).
#pragma once
#include <Eigen/Core>
#include <span>

namespace rheocyte {

inline constexpr int max_bdf_order = 5;              ///< of the stable formulas that are of use; 6 is nearly unstable
inline constexpr int max_a_stable_order = 2;         ///< of those in which no oscillation grows, however long the step
inline constexpr int max_nearly_a_stable_order = 3;  ///< only those grow that fade by less than a third in a period

/// Local error of a first step of order 1 over its whole change: it has no level to be extrapolated from.
inline constexpr double error_fraction_of_first_step = 0.5;

/// Values at the new time and at past times make a polynomial; weights of its derivative at the new time.
struct BdfFormula {
  double rate = 0;          ///< of the new value
  Eigen::VectorXd weights;  ///< of the past values, the latest first; as many as the order
  /// Local error of the new value over its distance from `extrapolation_weights` of one order more.
  double error_fraction = 0;
};

/// The formula of an order for a step from past times (the latest first, at least `order`) to `time`.
BdfFormula bdf_formula(std::span<const double> past, int order, double time);

/// Weights of past values, one for each of the given times, in the polynomial through them, at `time`.
Eigen::VectorXd extrapolation_weights(std::span<const double> past, double time);

/// What the last step shows about the next: local errors, relative to the tolerance, at the order below (0), at the
/// order of the step (1) and above (2); negative: not known.
struct StepErrors {
  double below = -1, same = -1, above = -1;
};

struct StepChoice {
  int order = 1;
  double factor = 1;  ///< next step over last one
};

/// Order and step for the next step, from the errors of an accepted one.
StepChoice choose_step(int order, const StepErrors&);
/// Factor by which a refused step is shortened.
double shortening(int order, double error);

}  // namespace rheocyte
