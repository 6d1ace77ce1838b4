#include "synth/analytic_shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "case/scales.h"

namespace rheocyte {

namespace {

constexpr int meridian_points = 361;  // the polygon's area is 1e-5 less than that of the smooth contour

// eta Q in units that make (eta Q / R^3) kPa and (eta Q / R^2) mN/m for R in um: mPa s x ul/s = 1e-12 N m = 1e3 kPa
// um^3.
constexpr double kPa_um3 = 1e3;

}  // namespace

std::variant<CellShape, NoShape> AnalyticShapes::shape(const VirtualCell& cell) const {
  const auto& c = population_;
  const double R = tube_radius_per_channel_width * c.flow.width_um, lambda = cell.radius_um / R;
  if (!(lambda >= min_radius_ratio)) return NoShape::too_small;
  if (lambda > max_ratio_of_agreement) return NoShape::too_large;
  if (!(cell.stiffness > 0)) return NoShape::too_soft;
  const double load = cell.viscosity_mPas * c.flow.rate_ul_s * kPa_um3 / (cell.stiffness * R * R);  // kPa um = mN/m
  const CellInTube in_tube = c.is_shell ? shell_in_tube(lambda, c.tension_ratio) : solid_in_tube(lambda);
  const double strain = c.is_shell ? shell_strain(load, lambda, c.duct) : solid_strain(load / R, c.duct);
  // Far beyond the model the linear shape has no inside; the leading term knows that without looking.
  if (leading_deformation(in_tube) * strain * strain > 2 * c.max_deformation) return NoShape::too_soft;
  const auto measures = small_deformation(in_tube, strain).shape;
  if (!(measures.deformation <= c.max_deformation)) return NoShape::too_soft;
  CellShape shape;
  shape.meridian = R * surface_points(in_tube, strain, Eigen::ArrayXd::LinSpaced(meridian_points, 0, std::numbers::pi));
  shape.area_um2 = measures.area * R * R;
  shape.deformation = measures.deformation;
  shape.volume_um3 = measures.volume * R * R * R;
  return shape;
}

std::string AnalyticShapes::description() const {
  const auto& c = population_;
  return fmt::format("analytical model of small deformations, {}, deformations up to {:g}, radii up to {:g} um",
                     c.is_shell ? fmt::format("shells with tension {:g} E2D", c.tension_ratio) : "solids",
                     c.max_deformation, max_ratio_of_agreement * tube_radius_per_channel_width * c.flow.width_um);
}

}  // namespace rheocyte
