// The measures of a state and their slopes along the branch.
#pragma once
#include "solve/stationary.h"
#include "solve/tube.h"
#include "table/branch.h"

namespace rheocyte {

/// One state of a sweep in physical units.
struct MeasuredState {
  Eigen::VectorXd value;     ///< in the order of table_measures
  Eigen::MatrixX2d contour;  ///< um, at fixed points of the unstressed sphere
};

MeasuredState measure_state(const Discretisation&, const Problem&, const Scales&, const VectorXd& unknowns);

/// Of a state in a square channel, whose silhouette has its pieces in front, on the side, and in the rear. The volume
/// is that of the body of revolution of the silhouette, as programs compute it from images.
MeasuredState measure_state(const StationaryState&, const Scales&);

}  // namespace rheocyte
