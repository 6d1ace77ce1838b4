// Branches as a table holds them, from the analytical model in place of simulations.
#pragma once
#include "table/branch.h"

namespace rheocyte::test {

/// Solids at 20 um, 0.04 ul/s, 15 mPa s: 16 samples from 40 to 4 kPa, slopes by differences.
SampledBranch analytic_branch(double radius_um);

}  // namespace rheocyte::test
