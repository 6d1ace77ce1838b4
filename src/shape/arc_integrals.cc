#include "shape/arc_integrals.h"

#include <cmath>
#include <numbers>

#include "shape/curve.h"

namespace rheocyte {
namespace {

// The moments need 2 * degree = 24 points at most; the length of an arc is not polynomial and takes some more.
constexpr int quadrature_points = 40;

// Values of the Lagrange polynomials at the quadrature points of a whole piece, for each degree.
const Eigen::MatrixXd& whole_piece_basis(int degree, const Quadrature& rule) {
  static const auto all = [&] {
    std::vector<Eigen::MatrixXd> bases(1);
    for (int p = 1; p <= max_curve_degree; ++p) bases.push_back(lagrange_basis(p, rule.points));
    return bases;
  }();
  return all[degree];
}

}  // namespace

double ArcIntegrals::deformation() const { return 1 - 2 * std::sqrt(std::numbers::pi * area) / perimeter; }

ArcIntegrals integrate(const ArcChain& arcs, double origin) {
  static const Quadrature rule = gauss_legendre(quadrature_points);
  constexpr double pi = std::numbers::pi;
  ArcIntegrals sum;
  for (const CurveArc& arc : arcs) {
    const double span = arc.end - arc.start;
    const int degree = degree_of(arc.piece);
    const Eigen::MatrixXd part =
        span == 1 ? Eigen::MatrixXd() : lagrange_basis(degree, arc.start + span * rule.points.array());
    const Eigen::MatrixXd& basis = span == 1 ? whole_piece_basis(degree, rule) : part;
    const Eigen::MatrixX2d points = basis * arc.piece;
    const Eigen::MatrixX2d tangents = basis * derivative(arc.piece);
    for (int k = 0; k < quadrature_points; ++k) {
      const double x = points(k, 0) - origin, r = points(k, 1), weight = span * rule.weights(k);
      const double dx = -weight * tangents(k, 0);  // the meridian runs towards smaller x
      sum.perimeter += 2 * weight * tangents.row(k).norm();
      sum.area += 2 * r * dx;
      sum.area_x += 2 * x * r * dx;
      sum.area_xx += 2 * x * x * r * dx;
      sum.area_yy += 2 * r * r * r * dx / 3;
      sum.volume += pi * r * r * dx;
      sum.volume_x += pi * x * r * r * dx;
    }
  }
  return sum;
}

}  // namespace rheocyte
