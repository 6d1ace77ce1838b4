#include "duct/duct_geometry.h"

#include <cmath>

namespace rheocyte {
namespace {

constexpr double tiny = 1e-10;
/// Size of the core relative to the cell, and how far its faces bulge from the cube (0) to the ball (1).
constexpr double core_size = 0.5, core_bulge = 0.55;
/// Radius of the tube in which the slowest disturbance of the square decays as fast, in h.
constexpr double radius_of_equal_decay = 1.1;

/// The cube [-1, 1]^3 onto the unit ball.
DuctPoint ball(const DuctPoint& c) {
  const auto stretched = [&](int i, int j, int k) {
    const double b = c(j) * c(j), d = c(k) * c(k);
    return c(i) * std::sqrt(1 - b / 2 - d / 2 + b * d / 3);
  };
  return {stretched(0, 1, 2), stretched(1, 2, 0), stretched(2, 0, 1)};
}

DuctPoint on_cube(Face face, const FacePoint& at) {
  if (face == Face::side) return {at(1), 1, at(0)};
  return {face == Face::front ? 1.0 : -1.0, at(0), at(1)};
}

}  // namespace

DuctGeometry::DuctGeometry(Section section, double radius_ratio)
    : section_(section), radius_(radius_ratio), box_(disturbed_half_length(radius_ratio)) {
  const double rest = least_half_length(radius_ratio) - box_;
  half_length_ = box_ + (section == Section::square ? radius_of_equal_decay : 1.0) * rest;
}

DuctPoint DuctGeometry::surface(Face face, const FacePoint& at) const { return radius_ * ball(on_cube(face, at)); }

DuctPoint DuctGeometry::core(const DuctPoint& cube) const {
  return radius_ * core_size * (core_bulge * ball(cube) + (1 - core_bulge) / std::sqrt(3.0) * cube);
}

Eigen::Vector2d DuctGeometry::across(double Y, double Z) const {
  if (section_ == Section::square) return {Y, Z};
  return {Y * std::sqrt(1 - Z * Z / 2), Z * std::sqrt(1 - Y * Y / 2)};
}

DuctPoint DuctGeometry::box_side(Face face, const FacePoint& at) const {
  if (face != Face::side) {
    const Eigen::Vector2d yz = across(at(0), at(1));
    return {face == Face::front ? box_ : -box_, yz(0), yz(1)};
  }
  // Denser spokes opposite the equator, where the gap is narrow.
  const double X = at(1), centre_slope = 1 - 0.45 * radius_;
  const Eigen::Vector2d yz = across(1, at(0));
  return {box_ * (centre_slope * X + (1 - centre_slope) * X * X * X), yz(0), yz(1)};
}

DuctPoint DuctGeometry::map(Part part, Face face, const FacePoint& at, double outward) const {
  switch (part) {
    case Part::core: return core({outward, at(0), at(1)});
    case Part::ring: return (1 - outward) * core(on_cube(face, at)) + outward * surface(face, at);
    case Part::layers: return (1 - outward) * surface(face, at) + outward * box_side(face, at);
    case Part::end: {
      DuctPoint x = box_side(face, at);
      x(0) *= 1 + outward * (half_length_ / box_ - 1);
      return x;
    }
  }
  return DuctPoint::Zero();
}

bool DuctGeometry::is_wall(const DuctPoint& x) const {
  return (section_ == Section::square ? x(1) : x.tail<2>().norm()) > 1 - tiny;
}

double wall_slide(Face face, const FacePoint& at) { return face == Face::side ? 1 - std::pow(at(1), 4) : 0; }

}  // namespace rheocyte
