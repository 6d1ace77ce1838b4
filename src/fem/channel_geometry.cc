#include "fem/channel_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case/problem.h"

namespace rheocyte {
namespace {

constexpr double pi = std::numbers::pi;
/// Size of the core relative to the cell, and how far its sides bulge from chord (0) to circle (1).
constexpr double core_size = 0.5, core_bulge = 0.55;

}  // namespace

ChannelGeometry::ChannelGeometry(double radius_ratio, double length, double run_out)
    : radius_(radius_ratio),
      box_(disturbed_half_length(radius_ratio)),
      half_length_(std::max(min_half_length(radius_ratio), length / 2)),
      run_out_(run_out),
      front_corner_(0.25 * pi),
      rear_corner_(0.75 * pi) {}

double ChannelGeometry::angle(Sector sector, double along) const {
  switch (sector) {
    case Sector::front: return front_corner_ * along;
    case Sector::top: return front_corner_ + (rear_corner_ - front_corner_) * along;
    case Sector::rear: return pi + (rear_corner_ - pi) * along;
  }
  return 0;
}

Point ChannelGeometry::surface(Sector sector, double along) const {
  const double phi = angle(sector, along);
  return radius_ * Point(std::cos(phi), std::sin(phi));
}

Point ChannelGeometry::core_side(Sector sector, double along) const {
  const Point chord = (1 - along) * surface(sector, 0) + along * surface(sector, 1);
  return core_size * (core_bulge * surface(sector, along) + (1 - core_bulge) * chord);
}

Point ChannelGeometry::core(double outward, double along) const {
  // Transfinite interpolation of the four sides; the lower one is the axis.
  const Point front = core_side(Sector::front, outward), rear = core_side(Sector::rear, outward);
  const Point top = core_side(Sector::top, along);
  const Point axis_front = core_side(Sector::front, 0), axis_rear = core_side(Sector::rear, 0);
  const Point axis = (1 - along) * axis_front + along * axis_rear;
  const Point upper_chord = (1 - along) * core_side(Sector::top, 0) + along * core_side(Sector::top, 1);
  const Point corners = (1 - outward) * axis + outward * upper_chord;
  return (1 - along) * front + along * rear + (1 - outward) * axis + outward * top - corners;
}

Point ChannelGeometry::box_side(Sector sector, double along) const {
  switch (sector) {
    case Sector::front: return {box_, along};
    case Sector::rear: return {-box_, along};
    case Sector::top: break;
  }
  // Denser spokes opposite the equator, where the gap is narrow.
  const double tau = 1 - 2 * along, centre_slope = 1 - 0.45 * radius_;
  return {box_ * (centre_slope * tau + (1 - centre_slope) * tau * tau * tau), 1};
}

Point ChannelGeometry::map(Block block, double outward, double along) const {
  const auto blend = [outward](const Point& inner, const Point& outer) -> Point {
    return (1 - outward) * inner + outward * outer;
  };
  switch (block) {
    case Block::core: return core(outward, along);
    case Block::ring_front: return blend(core_side(Sector::front, along), surface(Sector::front, along));
    case Block::ring_top: return blend(core_side(Sector::top, along), surface(Sector::top, along));
    case Block::ring_rear: return blend(core_side(Sector::rear, along), surface(Sector::rear, along));
    case Block::front: return blend(surface(Sector::front, along), box_side(Sector::front, along));
    case Block::top: return blend(surface(Sector::top, along), box_side(Sector::top, along));
    case Block::rear: return blend(surface(Sector::rear, along), box_side(Sector::rear, along));
    case Block::downstream: return {box_ + outward * (end() - box_), along};
    case Block::upstream: return {-box_ - outward * (end() - box_), along};
  }
  return Point::Zero();
}

}  // namespace rheocyte
