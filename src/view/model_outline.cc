#include "view/model_outline.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "infer/smooth_events.h"

namespace rheocyte {

// The modes alone have no c_1: of second order, it is what keeps the centroid in its place.
Eigen::MatrixX2d outline_about_centroid(const std::array<double, mode_count>& modes, double area_um2, int points) {
  Eigen::MatrixX2d outline = outline_of_modes(modes, area_um2, points);
  const OutlineShape shape = outline_shape(outline);
  outline.rowwise() -= Eigen::RowVector2d(shape.x, shape.y);
  return outline;
}

std::optional<ModelOutline> model_outline(const ShapeMap& map, const MeasuringConditions& conditions, double area_um2,
                                          double deformation, int points) {
  SmoothEvents smooth;
  const std::array<double, 1> area{area_um2}, measured{deformation};
  remove_pixels(conditions, map.origin().flow, {area, measured, {}}, smooth);
  const double log_area = smooth.log_area[0], true_deformation = smooth.deformation[0];
  if (!std::isfinite(log_area) || !(true_deformation > 0)) return std::nullopt;
  const auto modes = map.shapes().modes(log_area, true_deformation);
  ModelOutline cell{
      std::exp(log_area) / scale_factors(conditions.flow, map.origin().flow).area, true_deformation, 0, {}};
  // Polygons of so many points are as good as the curve: 1e-5 of the radius.
  constexpr int fine = 1440;
  const Eigen::MatrixX2d curve = outline_of_modes(modes, cell.area_um2, fine);
  cell.radius_um = std::cbrt(3 / (4 * std::numbers::pi) * volume_of_revolution(curve));
  cell.outline = outline_about_centroid(modes, cell.area_um2, points);
  return cell;
}

}  // namespace rheocyte
