#include "synth/course_shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "case/scales.h"
#include "shape/radius_modes.h"

namespace rheocyte {

namespace {

constexpr int points = 181;  // from pole to pole

/// Half of the outline r = 1 + sum c_k cos(k theta), with the area of a whole one.
Eigen::MatrixX2d meridian_of(const RadiusModes& modes, double area) {
  Eigen::MatrixX2d meridian(points, 2);
  for (int i = 0; i < points; ++i) {
    const double theta = std::numbers::pi * i / (points - 1);
    double radius = 1;
    for (std::size_t k = 0; k < modes.size(); ++k)
      radius += modes[k] * std::cos(double(int(k) + first_radius_mode) * theta);
    meridian.row(i) << radius * std::cos(theta), radius * std::sin(theta);
  }
  double twice = 0;
  for (int i = 0; i + 1 < points; ++i)
    twice += meridian(i, 0) * meridian(i + 1, 1) - meridian(i + 1, 0) * meridian(i, 1);
  return meridian * std::sqrt(area / twice);
}

std::optional<NoShape> why_not(const DynamicSpec& spec, const DynamicCell& cell) {
  const auto at = coordinates_of(spec, cell);
  const auto axes = nodes_of(spec);
  constexpr std::array below{NoShape::too_small, NoShape::too_soft, NoShape::outside_times},
      above{NoShape::too_large, NoShape::too_stiff, NoShape::outside_times};
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k] < axes[k].front()) return below[k];
    if (at[k] > axes[k].back()) return above[k];
  }
  return {};
}

}  // namespace

std::variant<CellShape, NoShape> CourseShapes::shape(const VirtualCell& cell) const {
  const ChannelFlow simulated = channel_flow_of(table_.spec().base);
  const ScaleFactors scale = scale_factors(simulated, {flow_.width_um, flow_.rate_ul_s, cell.viscosity_mPas});
  const double viscosity_Pas = cell.own_viscosity_mPas * 1e-3 * simulated.viscosity_mPas / cell.viscosity_mPas;
  const double modulus_kPa = cell.stiffness / scale.modulus;
  const DynamicCell there{cell.radius_um / scale.length, modulus_kPa, 3 * viscosity_Pas / modulus_kPa};
  if (const auto reason = why_not(table_.spec(), there)) return *reason;
  const double place = cell.place_um / scale.length;
  if (!table_.has_place(place)) return NoShape::outside_places;
  const auto value = [&](CourseMeasure measure) { return table_.value(measure, there, place); };
  RadiusModes modes{};
  for (std::size_t k = 0; k < modes.size(); ++k) modes[k] = value(CourseMeasure(int(CourseMeasure::mode_2) + int(k)));
  const double sphere = std::numbers::pi * cell.radius_um * cell.radius_um;
  CellShape shape;
  shape.area_um2 = sphere * value(CourseMeasure::area_ratio);
  shape.meridian = meridian_of(modes, shape.area_um2);
  shape.deformation = value(CourseMeasure::deformation);
  shape.volume_um3 = 4.0 / 3 * sphere * cell.radius_um;
  shape.time_s = value(CourseMeasure::time) * unit_time_s(table_.spec().base, scale.length, flow_.rate_ul_s);
  return shape;
}

std::string CourseShapes::description() const {
  const DynamicSpec& spec = table_.spec();
  const double length = flow_.width_um / channel_flow_of(spec.base).width_um;
  return fmt::format("dynamic table {} by {}, {:.4g} to {:.4g} um behind the contraction", spec.identifier,
                     table_.content().program, length * spec.first_um, length * spec.last_um);
}

}  // namespace rheocyte
