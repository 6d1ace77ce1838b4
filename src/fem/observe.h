// What one reads off a state: the contour, the stretch of the surface, pressures, transfer to another degree.
#pragma once
#include "fem/discretisation.h"
#include "fem/element_integrals.h"
#include "laws/cortex.h"
#include "laws/short_waves.h"
#include "shape/contour.h"

namespace rheocyte {

/// Meridian of the deformed cell from front to rear pole, lengths in R.
Contour contour(const Discretisation&, const VectorXd& unknowns);

/// The surface at points along the meridian, front pole first; columns: meridional, hoop.
struct SurfaceState {
  VectorXd angle;              ///< of the undeformed point, from the flow direction
  Eigen::MatrixX2d point;      ///< current (x, r), in R
  Eigen::MatrixX2d stretch;    ///< ds/ds0, r/r0' from the shape without stress
  Eigen::MatrixX2d curvature;  ///< in 1/R; both 1/a for a sphere of radius a
};
/// `per_edge` equidistant points on each surface edge, ends included: each vertex appears twice. Without stress the
/// cell is the sphere, stretched so along x (docs/theory.md, eq:rest-shape).
SurfaceState surface_state(const Discretisation&, const VectorXd& unknowns, int per_edge, double rest_stretch = 1);

/// Principal Cauchy tensions at those points, in S R.
Eigen::MatrixX2d surface_tensions(const Cortex&, const SurfaceState&);

/// Least ratio of meridional to normal stretch along the surface. A free surface of any incompressible
/// Mooney-Rivlin solid loses stability against short meridional wrinkles below `biot_limit` (Biot 1963;
/// docs/theory.md, eq:biot; laws/short_waves.h); the boundary value problem is then ill-posed and results depend on the
/// mesh.
double min_biot_ratio(const SurfaceState&);
/// That ratio at the points.
VectorXd biot_ratios(const SurfaceState&);

/// The least of some values at the points of the surface, and between them: near the least one they go along a
/// parabola.
double least_along(const SurfaceState&, const VectorXd& values);

/// Greatest relative difference of the surface's meridional stretch between two states.
double stretch_change(const Discretisation&, const VectorXd& from, const VectorXd& to);

/// The ends of the reported channel.
enum class ChannelEnd { upstream, downstream };

/// Mean pressure over the plane across the channel at an end of it, in S; the undisturbed pressure at the cell is zero.
double end_pressure(const Discretisation&, const VectorXd& unknowns, ChannelEnd);

/// Flow rate through the inlet, in pi R^2 U; 1 where it is given.
double flow_rate(const Discretisation&, const VectorXd& unknowns);

/// Largest displacement component of the cell's nodes, in R.
double largest_displacement(const Discretisation&, const VectorXd& unknowns);

/// Multiplies the displacements alone.
void scale_displacement(const Discretisation&, double factor, VectorXd& unknowns);

/// The same fields in the unknowns of another degree on the same mesh.
VectorXd transfer(const Discretisation& from, const VectorXd& unknowns, const Discretisation& to);

/// Points for Discretisation::set_points: the liquid's nodes are moved as those of another mesh, in proportion to the
/// cells' radii.
std::vector<Point> transferred_points(const Discretisation& from, const Discretisation& to);

/// Current point of a node of the cell (its undeformed point plus displacement); undeformed point elsewhere.
Point current_point(const Discretisation&, const VectorXd& unknowns, int node);

}  // namespace rheocyte
