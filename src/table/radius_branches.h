// All that is known of one radius: the case's own branch and, beyond its end, the one that bending holds smooth.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "table/branch.h"

namespace rheocyte {

/// A state between the samples of a branch.
struct BranchPoint {
  const SampledBranch* branch = nullptr;
  double stiffness = 0;
  double error = 0;  ///< relative, of the deformation: the greater one of the two samples around
  bool regularised = false;

  double measure(Measure m) const { return interpolate(*branch, m, stiffness); }
};

/// Views of branches, which must outlive it. The regularised branch counts only for states that are softer and more
/// deformed than the last one of the own branch.
class RadiusBranches {
 public:
  explicit RadiusBranches(const SampledBranch& first);
  /// Of the same radius.
  void add(const SampledBranch& branch);

  double radius_um() const { return radius_um_; }
  const SampledBranch* bare() const { return bare_; }
  const SampledBranch* regularised() const { return regularised_; }

  /// The stiffest and the softest state, over both branches.
  BranchPoint stiffest() const;
  BranchPoint softest() const;

  /// Nothing outside the samples.
  std::optional<BranchPoint> at_deformation(double deformation) const;
  std::optional<BranchPoint> at_stiffness(double stiffness) const;

 private:
  bool is_beyond(double stiffness, double deformation) const;

  double radius_um_;
  const SampledBranch* bare_ = nullptr;
  const SampledBranch* regularised_ = nullptr;
};

/// By radius, ascending; radii without any sample are left out.
std::vector<RadiusBranches> by_radius(std::span<const SampledBranch> branches);

/// The state of a branch at a stiffness between its samples (asserted).
BranchPoint point_at(const SampledBranch& branch, double stiffness);

/// How much a relative error of the deformation changes the stiffness that is read from it, relative: the error divided
/// by |d ln(deformation) / d ln(stiffness)|.
double stiffness_error(const BranchPoint& point);

}  // namespace rheocyte
