// Place and second moments of a cell that is off the axis.
#pragma once
#include "duct/duct_integrals.h"

namespace rheocyte {

/// Volume of the whole cell, its barycentre, and the mean of (x - barycentre)(x - barycentre)^T.
struct CellMoments {
  double volume = 0;
  DuctPoint barycentre = DuctPoint::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};
/// Of a half with the mirror plane z = 0.
CellMoments cell_moments(const DuctSpace&, const TensorElement&, const VectorXd& unknowns);

}  // namespace rheocyte
