// What one reads off a state in the duct: both silhouettes, the stretch of the surface, the volume, transfer to another
// degree.
#pragma once
#include "duct/duct_integrals.h"
#include "shape/contour.h"

namespace rheocyte {

/// The silhouette as a meridian from front to rear pole, lengths in h, its place along the flow as in the mesh: the
/// meridian in the plane z = 0 seen from the side, that in y = z seen along the other diagonal.
Contour duct_contour(const DuctSpace&, const VectorXd& unknowns, Camera);

/// The surface at equidistant points of each edge of that meridian, front pole first; columns: meridional, across.
struct DuctMeridian {
  VectorXd rest_angle;     ///< of the undeformed point, from the flow direction
  Eigen::MatrixX2d point;  ///< (x, distance to the axis)
  Eigen::MatrixX2d stretch;
  Eigen::MatrixX2d curvature;
};
DuctMeridian duct_meridian(const DuctSpace&, const VectorXd& unknowns, Camera, int per_edge);

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
Eigen::MatrixX2d duct_principal_stretches(const DuctSpace&, const VectorXd& unknowns);

/// Greatest relative difference of the stretch along the faces' coordinates between two states.
double duct_stretch_change(const DuctSpace&, const VectorXd& from, const VectorXd& to);

/// Volume and barycentre (along the flow) of the whole cell.
struct CellVolume {
  double volume = 0, barycentre = 0;
};
CellVolume cell_volume(const DuctSpace&, const TensorElement&, const VectorXd& unknowns);

/// The greatest shear rate sqrt(2 D:D) of the liquid between the planes across the duct through the cell's poles.
double greatest_shear_rate(const DuctSpace&, const TensorElement&, const VectorXd& unknowns);

/// Mean pressure over the inlet, in S.
double duct_inlet_pressure(const DuctSpace&, const VectorXd& unknowns);

/// The same fields in the unknowns of another degree on a mesh with the same elements.
VectorXd transfer(const DuctSpace& from, const VectorXd& unknowns, const DuctSpace& to);

/// Current point of a node of the cell.
DuctPoint duct_point(const DuctSpace&, const VectorXd& unknowns, int node);

}  // namespace rheocyte
