// The measures of a state and their slopes along the branch.
#pragma once
#include "solve/path.h"
#include "table/branch.h"

namespace rheocyte {

/// One state of a sweep in physical units.
struct MeasuredState {
  Eigen::VectorXd value;     ///< in the order of table_measures
  Eigen::MatrixX2d contour;  ///< um, at fixed points of the unstressed sphere
};

MeasuredState measure_state(const Discretisation&, const Problem&, const Scales&, const VectorXd& unknowns);

}  // namespace rheocyte
