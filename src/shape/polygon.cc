#include "shape/polygon.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

using Four = Eigen::Array<double, 4, 1>;

Four four_from(const double* values) { return Eigen::Map<const Four>(values); }

}  // namespace

// Green's theorem about the first corner. Of pixels all terms but the lengths are whole numbers; for a contour in a
// picture they and their sums are exact in double precision, and what a damaged file holds does not overflow.
PolygonMoments Polygon::moments() const {
  Four twice_area = Four::Zero(), sx = twice_area, sy = twice_area, sxx = twice_area, sxy = twice_area,
       syy = twice_area, length = twice_area;
  for (std::size_t i = 0; i < edges(); i += 4) {
    const Four x0 = four_from(&x_[i]), x1 = four_from(&x_[i + 1]), y0 = four_from(&y_[i]), y1 = four_from(&y_[i + 1]);
    const Four c = x0 * y1 - x1 * y0;
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
  m.x = x + origin_.x();
  m.y = y + origin_.y();
  m.mu20 = sign * sxx.sum() / 12 - m.area * x * x;
  m.mu11 = sign * sxy.sum() / 24 - m.area * x * y;
  m.mu02 = sign * syy.sum() / 12 - m.area * y * y;
  return m;
}

// The integral of pi r^2 dz; the halves run in opposite directions along the axis, and the direction of the chain
// itself does not count.
double Polygon::volume_of_rotation(double y) const {
  const double axis = y - origin_.y();
  const auto below_edge = [](const Four& r0, const Four& r1) { return Four(r0 * r0 + r0 * r1 + r1 * r1); };
  Four both = Four::Zero();
  for (std::size_t i = 0; i < edges(); i += 4) {
    const Four dz = four_from(&x_[i + 1]) - four_from(&x_[i]);
    const Four h0 = four_from(&y_[i]) - axis, h1 = four_from(&y_[i + 1]) - axis;
    both += dz * (below_edge(h0.max(0), h1.max(0)) - below_edge(h0.min(0), h1.min(0)));
  }
  return std::numbers::pi / 3 * std::abs(both.sum()) / 2;
}

}  // namespace rheocyte
