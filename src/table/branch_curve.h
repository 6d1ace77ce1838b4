// One computed branch of a table as polynomials over s = sqrt(d).
#pragma once
#include <vector>

#include "table/branch.h"
#include "table/reference_stiffness.h"

namespace rheocyte {

/// Slopes along a branch from its values alone: those of the polynomials through all samples over a number of each one
/// that grows about as 1 / stiffness.
void set_slopes(SampledBranch&, const std::vector<double>& along);
/// Such a number: the root of the deformation.
std::vector<double> roots_of_deformation(const SampledBranch&);

/// A measure as q in value = base + s^power q with s = sqrt(d): q is smooth and has no zero at s = 0.
struct Scaling {
  double base = 0;
  int power = 0;
};

Scaling scaling_of(int measure);

/// The polynomials along one computed branch, which must outlive it.
class BranchCurve {
 public:
  BranchCurve(const SampledBranch& branch, const ReferenceStiffness& reference);

  const SampledBranch& branch() const { return *branch_; }
  double last() const { return s_.back(); }
  const std::vector<double>& s() const { return s_; }

  /// Measures as `Scaling` has them, and ln(E) less that of the reference.
  Eigen::VectorXd numbers(const std::vector<double>& weights) const;
  Eigen::MatrixX2d contour(const std::vector<double>& weights) const;
  /// Relative, of the deformation: what the polynomial makes of the independent errors of the states.
  double error(double s) const;
  /// ln(E) over the reference at a sample, and by the other samples.
  double log_ratio(int sample) const { return numbers_(sample, measure_count); }
  double log_ratio_without(int sample) const;

 private:
  const SampledBranch* branch_;
  std::vector<double> s_;
  Eigen::MatrixXd numbers_;  ///< samples x (measures, ln of the ratio)
};

}  // namespace rheocyte
