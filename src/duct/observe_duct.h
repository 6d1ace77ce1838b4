// What one reads off a state in the duct: the stretch of the surface, the volume, transfer to another degree.
#pragma once
#include "duct/duct_integrals.h"
#include "duct/duct_silhouette.h"

namespace rheocyte {

/// The surface at equidistant points of its faces, ends included.
struct DuctSurface {
  Eigen::MatrixX3d point;
  Eigen::MatrixX2d stretch;    ///< principal ones, the least first
  Eigen::MatrixX2d direction;  ///< stretch along the element coordinates of the faces
};
DuctSurface duct_surface(const DuctSpace&, const VectorXd& unknowns, int per_edge);

/// Principal stretches of the surface, the least first, at the Gauss points of its faces and of both silhouettes: there
/// the slopes of polynomials are most accurate, while at the borders of elements they are off by up to a tenth where
/// the surface is bent sharply.
/// They are those from the shape without stress, a sphere that is stretched so along x.
Eigen::MatrixX2d duct_principal_stretches(const DuctSpace&, const VectorXd& unknowns, double rest_stretch = 1);

/// Greatest relative difference of the stretch along the faces' coordinates between two states.
double duct_stretch_change(const DuctSpace&, const VectorXd& from, const VectorXd& to);

/// Volume and barycentre (along the flow) of the whole cell.
struct CellVolume {
  double volume = 0, barycentre = 0;
};
CellVolume cell_volume(const DuctSpace&, const TensorElement&, const VectorXd& unknowns);

/// The greatest shear rate sqrt(2 D:D) of the liquid between the planes across the duct through the cell's poles.
double max_shear_rate(const DuctSpace&, const TensorElement&, const VectorXd& unknowns);

}  // namespace rheocyte
