#include "solve/surface_stability.h"

#include <numbers>

#include "shape/wrinkles.h"

namespace rheocyte {

namespace {

/// In r0. A wave k of a membrane on an incompressible half-space has the stiffness 2 mu k + T1 k^2: under compression
/// the shortest waves buckle first. Those that are shorter than a cortex is thick do not exist.
constexpr double shortest_wave = 0.05;

}  // namespace

VectorXd wrinkling_margins(const Bulk& bulk, const SurfaceState& surface) {
  return VectorXd::NullaryExpr(surface.stretch.rows(), [&](Eigen::Index i) {
    return wrinkling_margin(bulk, surface.stretch(i, 0), surface.stretch(i, 1));
  });
}

double stability_margin(const Problem& problem, const SurfaceState& surface) {
  return stability_margin(problem, problem.radius_ratio,
                          {wrinkling_margins(problem.bulk, surface).minCoeff(),
                           surface_tensions(problem.cortex, surface).col(0).minCoeff()});
}

double stability_margin(const Media& media, double radius_ratio, const SurfaceExtremes& least) {
  switch (surface_kind(media)) {
    case SurfaceKind::bare: return least.wrinkling_margin;
    case SurfaceKind::membrane: {
      const Cortex& cortex = media.cortex;
      const double support = media.bulk.shear_modulus * shortest_wave * radius_ratio / std::numbers::pi;
      // Tensions of the order of the modulus are as far as 1 from the limit.
      return (least.min_tension + support) / (cortex.modulus + cortex.tension + support);
    }
    case SurfaceKind::held: return 1;
  }
  return 1;
}

double stability_margin(const Problem& problem, const Discretisation& space, const VectorXd& unknowns) {
  const int per_edge = 2 * space.reference().degree() + 1;
  return stability_margin(problem, surface_state(space, unknowns, per_edge, problem.bulk.rest_stretch));
}

double margin_at_rest(const Problem& problem) {
  return stability_margin(problem, problem.radius_ratio, {1, problem.cortex.tension});
}

bool is_wrinkled(const Problem& problem, const Discretisation& space, const VectorXd& unknowns) {
  constexpr int max_sign_changes = 3;  // a rear dent makes one, a hollow flank two
  const double margin = stability_margin(problem, space, unknowns);
  if (margin < 0) return true;
  // Farther from the limit, changes of curvature are faint errors of discretisation on nearly straight flanks.
  if (surface_kind(problem) != SurfaceKind::held && margin > small_margin) return false;
  return surface_smoothness(contour(space, unknowns)).curvature_sign_changes > max_sign_changes;
}

}  // namespace rheocyte
