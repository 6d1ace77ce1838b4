#include "solve/surface_stability.h"

#include <algorithm>
#include <numbers>

#include "laws/surface_form.h"
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
  return stability_margin(
      problem, problem.radius_ratio,
      {wrinkling_margins(problem.bulk, surface).minCoeff(), surface_tensions(problem.cortex, surface).col(0).minCoeff(),
       collapse_margins(problem, surface).minCoeff()});
}

namespace {

/// Of a stiffness whose waves the bulk supports: 0 at the limit, 1 at a stiffness that is `far` from it.
double distance_from_limit(double stiffness, double far, const Media& media, double radius_ratio) {
  const double support = media.bulk.shear_modulus * shortest_wave * radius_ratio / std::numbers::pi;
  return (stiffness + support) / (far + support);
}

/// Tensions of the order of the modulus are as far as 1 from the limit.
double margin_against_wrinkles(const Media& media, double radius_ratio, const SurfaceExtremes& least) {
  switch (surface_kind(media)) {
    case SurfaceKind::bare: return least.wrinkling_margin;
    case SurfaceKind::membrane:
      return distance_from_limit(least.min_tension, media.cortex.modulus + media.cortex.tension, media, radius_ratio);
    case SurfaceKind::held: return 1;
  }
  return 1;
}

/// At a point, by the resistance without compression along the meridian. Bending does not change it: points that slide
/// along a surface leave its shape as it is.
double collapse_margin(const Problem& problem, double along, double around) {
  const double uncompressed = resistance_to_compression(problem.cortex, 1, around);
  if (along >= 1 || uncompressed == 0) return 1;
  return std::min(1.0, distance_from_limit(resistance_to_compression(problem.cortex, along, around), uncompressed,
                                           problem, problem.radius_ratio));
}

}  // namespace

double stability_margin(const Media& media, double radius_ratio, const SurfaceExtremes& least) {
  return std::min(margin_against_wrinkles(media, radius_ratio, least), least.collapse_margin);
}

VectorXd collapse_margins(const Problem& problem, const SurfaceState& surface) {
  return VectorXd::NullaryExpr(surface.stretch.rows(), [&](Eigen::Index i) {
    return collapse_margin(problem, surface.stretch(i, 0), surface.stretch(i, 1));
  });
}

double stability_margin(const Problem& problem, const Discretisation& space, const VectorXd& unknowns) {
  const int per_edge = 2 * space.reference().degree() + 1;
  return stability_margin(problem, surface_state(space, unknowns, per_edge, problem.bulk.rest_stretch));
}

std::optional<WeakPoint> weak_point(const Problem& problem, const SurfaceProfile& surface, double margin) {
  SurfaceExtremes least{HUGE_VAL, HUGE_VAL};
  Eigen::Index weakest = 0;
  for (Eigen::Index i = 0; i < surface.stretch.rows(); ++i) {
    const double along = surface.stretch(i, 0), around = surface.stretch(i, 1);
    const double here = collapse_margin(problem, along, around);
    if (here < least.collapse_margin) weakest = i;
    least = {std::min(least.wrinkling_margin, wrinkling_margin(problem.bulk, along, around)),
             std::min(least.min_tension, principal_tensions(problem.cortex, along, around)[0]),
             std::min(least.collapse_margin, here)};
  }
  if (least.collapse_margin >= margin ||
      least.collapse_margin > margin_against_wrinkles(problem, problem.radius_ratio, least))
    return {};
  return WeakPoint{surface.stretch(weakest, 0), surface.stretch(weakest, 1),
                   surface.point(weakest, 0) / problem.radius_ratio};
}

double margin_at_rest(const Problem& problem) {
  return stability_margin(problem, problem.radius_ratio, {1, problem.cortex.tension});
}

bool is_wrinkled(const Problem& problem, const Discretisation& space, const VectorXd& unknowns) {
  constexpr int max_sign_changes = 3;  // a rear dent makes one, a hollow flank two
  const double margin = stability_margin(problem, space, unknowns);
  if (margin < 0) return true;
  // Ripples beside a sharp rim are states of a surface that resists bending; it ends at folds of its branch.
  if (problem.cortex.bending > 0) return false;
  // Farther from the limit, changes of curvature are faint errors of discretisation on nearly straight flanks.
  if (surface_kind(problem) != SurfaceKind::held && margin > small_margin) return false;
  return surface_smoothness(contour(space, unknowns)).curvature_sign_changes > max_sign_changes;
}

}  // namespace rheocyte
