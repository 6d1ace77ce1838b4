// The analytical model of Mietke et al. 2015: shape of a little deformed cell, solid or shell, in a tube.
//
// It is the limit of vanishing deformation of every elastic law; how far it reaches beyond is measured against
// `rheocyte solve` (docs/verification.md, sec. 8).
#pragma once
#include "analytic/elastic_response.h"
#include "analytic/sphere_in_tube.h"
#include "shape/measures.h"

namespace rheocyte {

/// Up to these deformations and this ratio r0 / R the deformation is within 10 % of the laws `linear` for finite
/// strain, and a modulus derived from it within 5 %. (Neo-Hookean solids: within 17 %.)
inline constexpr double max_solid_deformation = 0.02, max_shell_deformation = 0.001;
inline constexpr double max_ratio_of_agreement = 0.8;

/// Which velocity on the axis belongs to a flow rate Q (eq:peak-velocity): that of the tube, or that of the square duct
/// of width L = R / 0.547, as in the published analytical tables.
enum class Duct { tube, square };

/// u_max in Q / R^2.
double peak_velocity(Duct);

/// A cell in the tube and its displacement for unit strain; lengths in R.
struct CellInTube {
  SphereInTube sphere;
  SurfaceModes displacement;  ///< in r0
};

/// Solid, incompressible cell of radius r0 = lambda R; its strain is `solid_strain`.
CellInTube solid_in_tube(double lambda);

/// Shell with a cortical tension gamma = tension_ratio E2D around a liquid; its strain is `shell_strain`.
CellInTube shell_in_tube(double lambda, double tension_ratio);

/// eq:strain, eta u_max / (R mu) with Ca = eta Q / (R^3 E), E = 3 mu.
double solid_strain(double capillary_number, Duct = Duct::tube);

/// eq:strain, eta u_max r0 / (R E2D) with Ca = eta Q / (R^2 E2D).
double shell_strain(double capillary_number, double lambda, Duct = Duct::tube);

/// Points (x, r) of the deformed surface, one row per angle of the undeformed sphere, 0 .. pi from the flow direction
/// (eq:material-points). x counts from the cell's barycentre, unit R.
Eigen::MatrixX2d surface_points(const CellInTube&, double strain, const Eigen::ArrayXd& angles);

/// The deformed surface as a meridian from front to rear; its error of interpolation is below 1e-13.
Contour contour(const CellInTube&, double strain);

/// eq:leading-deformation: the deformation to second order in the strain, divided by its square.
double leading_deformation(const CellInTube&);

/// Contour and its measures, lengths in R. All measures are NaN if the linear shape has no inside, as for strains far
/// beyond the model.
struct SmallDeformation {
  Contour contour;
  ShapeMeasures shape;
};

SmallDeformation small_deformation(const CellInTube&, double strain);

}  // namespace rheocyte
