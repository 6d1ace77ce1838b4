#include "shape/radius_modes.h"

#include <cmath>
#include <utility>

#include "shape/convex_hull.h"
#include "shape/curve.h"

namespace rheocyte {

RadiusModes radius_modes(const ArcChain& arcs, double centre) {
  static const Quadrature rule = gauss_legendre(40);  // as many as the other measures take
  std::array<double, last_radius_mode + 1> integral{};
  for (const CurveArc& arc : arcs) {
    const double span = arc.end - arc.start;
    const Eigen::MatrixXd basis = lagrange_basis(degree_of(arc.piece), arc.start + span * rule.points.array());
    const Eigen::MatrixX2d points = basis * arc.piece, tangents = basis * derivative(arc.piece);
    for (int q = 0; q < points.rows(); ++q) {
      const double x = points(q, 0) - centre, y = points(q, 1), radius = std::hypot(x, y), cosine = x / radius;
      const double angle = (x * tangents(q, 1) - y * tangents(q, 0)) / (radius * radius);
      const double weight = span * rule.weights(q) * radius * angle;
      double before = cosine, here = 1;  // cos(-theta), cos(0)
      for (double& sum : integral) {
        sum += weight * here;
        before = std::exchange(here, 2 * cosine * here - before);
      }
    }
  }
  RadiusModes modes;
  for (int k = first_radius_mode; k <= last_radius_mode; ++k)
    modes[std::size_t(k - first_radius_mode)] = 2 * integral[std::size_t(k)] / integral[0];
  return modes;
}

}  // namespace rheocyte
