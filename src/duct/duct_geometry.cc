#include "duct/duct_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheocyte {
namespace {

/// Size of the core relative to the cell, and how far its faces bulge from the cube (0) to the ball (1).
constexpr double core_size = 0.5, core_bulge = 0.55;

/// The cube [-1, 1]^3 onto the unit ball.
DuctPoint ball(const DuctPoint& c) {
  const auto stretched = [&](int i, int j, int k) {
    const double b = c(j) * c(j), d = c(k) * c(k);
    return c(i) * std::sqrt(1 - b / 2 - d / 2 + b * d / 3);
  };
  return {stretched(0, 1, 2), stretched(1, 2, 0), stretched(2, 0, 1)};
}

}  // namespace

DuctGeometry::DuctGeometry(const DuctShape& shape)
    : shape_(shape),
      box_(disturbed_half_length(shape.radius, shape.extent)),
      min_length_(shape.section == Section::tube ? min_half_length(shape.radius)
                                                 : min_half_length(shape.radius, shape.extent)),
      half_length_(std::max(min_length_, shape.length / 2)) {}

double DuctGeometry::area() const {
  return shape_.section == Section::tube ? std::numbers::pi : 4 * shape_.extent.width * shape_.extent.height;
}

DuctPoint DuctGeometry::surface(const DuctPoint& cube) const {
  return shape_.radius * ball(cube) + DuctPoint(0, shape_.offset, 0);
}

DuctPoint DuctGeometry::core(const DuctPoint& cube) const {
  return shape_.radius * core_size * (core_bulge * ball(cube) + (1 - core_bulge) / std::sqrt(3.0) * cube) +
         DuctPoint(0, shape_.offset, 0);
}

DuctPoint DuctGeometry::box_side(const DuctPoint& cube) const {
  // Denser spokes opposite the equator, where the gap is narrow: the nearer the wall, the more they cross it straight.
  const double X = cube(0), Y = cube(1), Z = cube(2), centre_slope = 1 - 0.75 * shape_.radius * shape_.radius;
  const double x = box_ * (centre_slope * X + (1 - centre_slope) * X * X * X);
  if (shape_.section == Section::tube) return {x, Y * std::sqrt(1 - Z * Z / 2), Z * std::sqrt(1 - Y * Y / 2)};
  return {x, shape_.extent.width * Y, shape_.extent.height * Z};
}

DuctPoint DuctGeometry::map(Part part, const DuctPoint& cube, double outward) const {
  switch (part) {
    case Part::core: return core(cube);
    case Part::ring: return (1 - outward) * core(cube) + outward * surface(cube);
    case Part::layers: return (1 - outward) * surface(cube) + outward * box_side(cube);
    case Part::end: {
      DuctPoint x = box_side(cube);
      x(0) *= 1 + outward * (half_length_ / box_ - 1);
      return x;
    }
  }
  return DuctPoint::Zero();
}

Eigen::Vector2d DuctGeometry::wall_share(Part part, const DuctPoint& cube, double outward) const {
  if (part == Part::core || part == Part::ring) return {0, 0};
  const DuctPoint side = box_side(cube);
  return (part == Part::layers ? outward : 1) * Eigen::Vector2d(side(1), section() == Section::tube ? side(2) : 0);
}

bool DuctGeometry::is_wall(const DuctPoint& x) const {
  if (shape_.section == Section::tube) return x.tail<2>().norm() > 1 - same_place;
  return std::abs(x(1)) > shape_.extent.width - same_place || std::abs(x(2)) > shape_.extent.height - same_place;
}

double wall_slide(const DuctPoint& cube) { return 1 - std::pow(cube(0), 4); }

}  // namespace rheocyte
