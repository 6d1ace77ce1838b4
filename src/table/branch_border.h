// The upper border of the states that a family of branches has, as a smooth curve.
#pragma once
#include <span>
#include <vector>

#include "numeric/no_value.h"
#include "table/branch.h"
#include "table/table_interpolation.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A branch with the logarithms that a grid needs.
class LogBranch {
 public:
  explicit LogBranch(const SampledBranch& branch) : branch_(&branch) {}
  const SampledBranch& branch() const { return *branch_; }
  struct Point {
    double log_area, log_deformation;
  };
  Point at(double log_stiffness) const;
  double stiffest() const;  ///< ln(stiffness)
  double softest() const;
  Point first() const { return at(stiffest()); }
  Point last() const { return at(softest()); }
  /// ln(stiffness) where the branch, from stiff to soft, first rises to this height above a line; NaN if it does not.
  /// `height(point)` is negative below the line.
  template <class Height>
  double crossing(const Height& height) const {
    double stiff = stiffest(), soft = softest();
    constexpr double rounding = 1e-12;
    // Where the line has no height, neither holds.
    if (!(height(at(stiff)) <= rounding && height(at(soft)) >= -rounding)) return no_value;
    for (int step = 0; step < 60 && stiff - soft > 1e-13; ++step) {
      const double middle = 0.5 * (stiff + soft);
      (height(at(middle)) < 0 ? stiff : soft) = middle;
    }
    return 0.5 * (stiff + soft);
  }

 private:
  const SampledBranch* branch_;
};

/// ln(deformation) by column.
struct Border {
  std::vector<double> height;      ///< -infinity where the branches have nothing
  std::vector<OutOfTable> beyond;  ///< why there is nothing above
};

/// The columns of a grid.
struct Columns {
  double first = 0, step = 0;  ///< ln(um^2)
  int count = 0;
  double at(double column) const { return first + column * step; }
};

/// Just below the ends of all branches (ascending radii); where these scatter, along the lower ones. Branches that the
/// solver did not follow to their end, between others that go on, do not count.
Border upper_border(std::span<const LogBranch> branches, const TableSpec& spec, const Columns& columns);

}  // namespace rheocyte
