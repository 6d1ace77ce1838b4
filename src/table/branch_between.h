// The branch of a radius between computed ones (docs/theory.md, sec. "tables").
#pragma once
#include <span>
#include <string>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// Why a branch goes no farther: the status of its end. Only between branches of one family is there a smooth one.
std::string family_of(const SampledBranch&);

/// Polynomials in ln(radius) through the states at equal heights of branches of one family (ascending radii, at least
/// two). A height is the fraction of the way from the first to the last ln(deformation). Empty if there are heights
/// that one of them does not have.
SampledBranch branch_between(const TableSpec&, std::span<const SampledBranch* const> near, double radius_um);

/// How far a branch is from what such polynomials through others (the same) predict.
struct BranchDifference {
  double stiffness = 0;  ///< greatest, relative, at deformations that both have
  double end = 0;        ///< of the last deformations, relative; 0 where the branch covers the table's ranges
};
BranchDifference difference(const TableSpec&, std::span<const SampledBranch* const> near,
                            const SampledBranch& computed);

}  // namespace rheocyte
