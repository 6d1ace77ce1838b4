#include "measurement/pixel_polygon.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

/// Some edges at once, so that the processor computes them side by side.
constexpr std::size_t lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

Lanes lanes_from(const double* values) { return Eigen::Map<const Lanes>(values); }

}  // namespace

void PixelPolygon::assign(std::span<const PixelPoint> chain) {
  assert(!chain.empty());
  origin_ = chain.front();
  edges_ = (chain.size() + lanes - 1) / lanes * lanes;
  x_.resize(edges_ + 1);
  y_.resize(edges_ + 1);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    x_[i] = static_cast<double>(chain[i].x) - origin_.x;
    y_[i] = static_cast<double>(chain[i].y) - origin_.y;
  }
  for (std::size_t i = chain.size(); i <= edges_; ++i) x_[i] = y_[i] = 0;
}

// Green's theorem about the first corner. All terms but the lengths are whole numbers; for a contour in a picture they
// and their sums are exact in double precision, and what a damaged file holds does not overflow.
PolygonMoments PixelPolygon::moments() const {
  Lanes twice_area = Lanes::Zero(), sx = twice_area, sy = twice_area, sxx = twice_area, sxy = twice_area,
        syy = twice_area, length = twice_area;
  for (std::size_t i = 0; i < edges_; i += lanes) {
    const Lanes x0 = lanes_from(&x_[i]), x1 = lanes_from(&x_[i + 1]), y0 = lanes_from(&y_[i]),
                y1 = lanes_from(&y_[i + 1]);
    const Lanes c = x0 * y1 - x1 * y0;
    twice_area += c;
    sx += c * (x0 + x1);
    sy += c * (y0 + y1);
    sxx += c * (x0 * x0 + x0 * x1 + x1 * x1);
    sxy += c * (x0 * (2 * y0 + y1) + x1 * (y0 + 2 * y1));
    syy += c * (y0 * y0 + y0 * y1 + y1 * y1);
    length += ((x1 - x0).square() + (y1 - y0).square()).sqrt();
  }
  PolygonMoments m{.perimeter = length.sum()};
  const double signed_area = 0.5 * twice_area.sum(), sign = signed_area > 0 ? 1 : -1;
  if (signed_area == 0) return m;
  m.area = sign * signed_area;
  const double x = sx.sum() / (6 * signed_area), y = sy.sum() / (6 * signed_area);  // from the origin
  m.x = x + origin_.x;
  m.y = y + origin_.y;
  m.mu20 = sign * sxx.sum() / 12 - m.area * x * x;
  m.mu11 = sign * sxy.sum() / 24 - m.area * x * y;
  m.mu02 = sign * syy.sum() / 12 - m.area * y * y;
  return m;
}

// The integral of pi r^2 dz; the halves run in opposite directions along the axis, and the direction of the chain
// itself does not count.
double PixelPolygon::volume_of_rotation(double y) const {
  const double axis = y - origin_.y;
  const auto below_edge = [](const Lanes& r0, const Lanes& r1) { return Lanes(r0 * r0 + r0 * r1 + r1 * r1); };
  Lanes both = Lanes::Zero();
  for (std::size_t i = 0; i < edges_; i += lanes) {
    const Lanes dz = lanes_from(&x_[i + 1]) - lanes_from(&x_[i]);
    const Lanes h0 = lanes_from(&y_[i]) - axis, h1 = lanes_from(&y_[i + 1]) - axis;
    both += dz * (below_edge(h0.max(0), h1.max(0)) - below_edge(h0.min(0), h1.min(0)));
  }
  return std::numbers::pi / 3 * std::abs(both.sum()) / 2;
}

}  // namespace rheocyte
