#include "duct/duct_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheocyte {
namespace {

/// Size of the core relative to the cell, and how far its faces bulge from the cube (0) to the ball (1).
constexpr double core_size = 0.5, core_bulge = 0.55;
/// Of the half width, from the axis: beyond it the spokes of front and rear lean to the cell.
constexpr double max_middle = 0.85;

/// The cube [-1, 1]^3 onto the unit ball.
DuctPoint smooth_ball(const DuctPoint& c) {
  const auto stretched = [&](int i, int j, int k) {
    const double b = c(j) * c(j), d = c(k) * c(k);
    return c(i) * std::sqrt(1 - b / 2 - d / 2 + b * d / 3);
  };
  return {stretched(0, 1, 2), stretched(1, 2, 0), stretched(2, 0, 1)};
}

/// The cube onto the cylinder of radius 1, wedge by wedge; on its side angles round the flow are nearly even.
DuctPoint cylinder(const DuctPoint& c) {
  constexpr double evenly = 0.22;
  const double y = std::abs(c(1)), z = std::abs(c(2)), least = std::min(y, z),
               factor = 1 - evenly * std::abs(y * y - z * z), scale = 1 / std::hypot(1, factor * least);
  return {c(0), scale * (y < z ? factor : 1) * c(1), scale * (y < z ? 1 : factor) * c(2)};
}

/// The cylinder onto the unit ball: planes across the flow on the cylinder's side become circles of latitude, as which
/// the rim of a dented cell runs round it.
DuctPoint ball_of_cylinder(const DuctPoint& c) {
  const double along = std::sqrt(1 - c.tail<2>().squaredNorm() / 2), across = std::sqrt(1 - c(0) * c(0) / 2);
  return {along * c(0), across * c(1), across * c(2)};
}

}  // namespace

DuctGeometry::DuctGeometry(const DuctShape& shape)
    : shape_(shape),
      box_(shape.box > 0 ? shape.box : disturbed_half_length(shape.radius, shape.extent)),
      min_length_(shape.section == Section::tube ? min_half_length(shape.radius)
                                                 : min_half_length(shape.radius, shape.extent)),
      half_length_(std::max(min_length_, shape.length / 2)) {}

double DuctGeometry::area() const {
  return shape_.section == Section::tube ? std::numbers::pi : 4 * shape_.extent.width * shape_.extent.height;
}

DuctGeometry DuctGeometry::across_wedges() const {
  DuctGeometry geometry = *this;
  geometry.has_wedges_ = false;
  return geometry;
}

DuctPoint DuctGeometry::ball(const DuctPoint& cube) const {
  return has_wedges_ ? ball_of_cylinder(cylinder(cube)) : smooth_ball(cube);
}

DuctPoint DuctGeometry::surface(const DuctPoint& cube) const {
  return shape_.radius * ball(cube) + DuctPoint(0, shape_.offset, 0);
}

DuctPoint DuctGeometry::core(const DuctPoint& cube) const {
  const DuctPoint flat = has_wedges_ ? cylinder(cube) / std::sqrt(2.0) : cube / std::sqrt(3.0);
  return shape_.radius * core_size * (core_bulge * ball(cube) + (1 - core_bulge) * flat) +
         DuctPoint(0, shape_.offset, 0);
}

// Denser spokes opposite the equator, where the gap is narrow: the nearer the wall, the more they cross it straight.
double DuctGeometry::box_along(const DuctPoint& cube) const {
  const double X = cube(0), centre_slope = 1 - 0.75 * shape_.radius * shape_.radius;
  const double x = box_ * (centre_slope * X + (1 - centre_slope) * X * X * X);
  if (shape_.edge == 0) return x;
  // A wall that slants towards the cell is below it not far ahead.
  const double at_edge = (1 + X) / 2 * (1 + std::copysign(cube(1), shape_.offset * cube(1))) / 2;
  return x * (1 - (1 - shape_.edge / box_) * at_edge * at_edge);
}

double DuctGeometry::end_along(const DuctPoint& cube, double outward) const {
  const double sign = std::copysign(1, cube(0));
  return std::lerp(box_along(cube), sign * half_length_, std::min(outward, 1.0)) +
         sign * shape_.run_out * std::max(outward - 1, 0.0);
}

Eigen::Vector2d DuctGeometry::box_across(const DuctPoint& cube, double stretch, double centre) const {
  const double Y = cube(1), Z = cube(2);
  if (shape_.section == Section::tube)
    return stretch * Eigen::Vector2d(Y * std::sqrt(1 - Z * Z / 2), Z * std::sqrt(1 - Y * Y / 2));
  const double width = shape_.extent.width * (shape_.narrows_in_height ? 1 : stretch),
               height = shape_.extent.height * (shape_.narrows_in_height ? stretch : 1);
  // In a funnel the middle of front and rear is where the cell's own axis leaves it.
  const double fraction = shape_.edge > 0 ? std::clamp(centre / width, -max_middle, max_middle) : 0;
  return {width * (Y + fraction) / (1 + fraction * Y), height * Z};
}

DuctPoint DuctGeometry::map(Part part, const DuctPoint& cube, double outward) const {
  switch (part) {
    case Part::core: return core(cube);
    case Part::ring: return (1 - outward) * core(cube) + outward * surface(cube);
    case Part::layers:
    case Part::end: {
      const double x =
          part == Part::end ? end_along(cube, outward) : (1 - outward) * surface(cube)(0) + outward * box_along(cube);
      const Eigen::Vector2d yz = across(part, cube, outward, 1, 0);
      return {x, yz(0), yz(1)};
    }
  }
  return DuctPoint::Zero();
}

Eigen::Vector2d DuctGeometry::across(Part part, const DuctPoint& cube, double outward, double stretch,
                                     double aside) const {
  // At the ends of the duct the mesh does not follow the cell.
  const double in_mesh = part == Part::end ? std::min(outward, 1.0) : 0;
  const double centre = std::lerp(shape_.offset + aside, shape_.offset * stretch, in_mesh);
  Eigen::Vector2d side = box_across(cube, stretch, centre);
  side(0) -= aside;
  return part == Part::end ? side : Eigen::Vector2d((1 - outward) * surface(cube).tail<2>() + outward * side);
}

bool DuctGeometry::is_wall(const DuctPoint& x) const {
  if (shape_.section == Section::tube) return x.tail<2>().norm() > 1 - same_place;
  return std::abs(x(1)) > shape_.extent.width - same_place || std::abs(x(2)) > shape_.extent.height - same_place;
}

double wall_slide(const DuctPoint& cube) { return 1 - std::pow(cube(0), 4); }

}  // namespace rheocyte
