#include "shape/wrinkles.h"

#include <cmath>
#include <numbers>

#include "numeric/no_value.h"
#include "shape/arc_integrals.h"
#include "shape/convex_hull.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

constexpr double relative_weak_curvature = 0.02;
constexpr int curvature_samples =
    24;  // per piece, away from its ends, where a polynomial's curvature is least accurate

int curvature_sign_changes(const std::vector<CurvePiece>& pieces, double weak_curvature) {
  const Eigen::VectorXd parameters =
      Eigen::VectorXd::LinSpaced(curvature_samples, 0.5 / curvature_samples, 1 - 0.5 / curvature_samples);
  int changes = 0;
  int sign = 1;
  for (const CurvePiece& piece : pieces) {
    const CurvePiece slope = derivative(piece);
    const Eigen::MatrixX2d first = evaluate(slope, parameters), second = evaluate(derivative(slope), parameters);
    for (int k = 0; k < curvature_samples; ++k) {
      const double turn = first(k, 0) * second(k, 1) - first(k, 1) * second(k, 0);
      const double curvature = turn / std::pow(first.row(k).norm(), 3);
      if (std::abs(curvature) < weak_curvature || curvature * sign > 0) continue;
      sign = -sign;
      ++changes;
    }
  }
  return changes;
}

}  // namespace

SurfaceSmoothness surface_smoothness(const Contour& contour) {
  const auto meridian = SampledMeridian::of(contour);
  const auto hull = meridian ? convex_hull(*meridian, HullParts::all) : std::nullopt;
  if (!hull) return {0, 0, no_value};

  const double origin = meridian->points().col(0).mean();
  const ArcIntegrals convex = integrate(hull->arcs, origin);
  const auto dents_closed = convex_hull(*meridian, HullParts::dents_at_poles);
  const double radius = std::sqrt(convex.area / std::numbers::pi);
  return {curvature_sign_changes(meridian->pieces(), relative_weak_curvature / radius), hull->flank_bridges,
          integrate(dents_closed->arcs, origin).deformation() - convex.deformation()};
}

}  // namespace rheocyte
