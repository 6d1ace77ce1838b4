// Whether a surface is stable along the meridian, against short wrinkles and against the collapse of its cortex
// (docs/theory.md, sec. "surface instability").
#pragma once
#include <cmath>
#include <optional>

#include "case/problem.h"
#include "fem/observe.h"
#include "solve/stationary.h"
#include "state/outcome.h"

namespace rheocyte {

/// What a surface has the least of.
struct SurfaceExtremes {
  double wrinkling_margin;     ///< of the bare bulk (laws/short_waves.h)
  double min_tension;          ///< principal
  double collapse_margin = 1;  ///< of the cortex
};

/// Of the bare bulk at the points of the surface, against wrinkles along the meridian.
VectorXd wrinkling_margins(const Bulk&, const SurfaceState&);

/// What compression along the meridian has left of a cortex's resistance to it, at the points of the surface: 1 where
/// it is not compressed, 0 where it collapses.
VectorXd collapse_margins(const Problem&, const SurfaceState&);

/// Distance from the limit of stability against short waves: stable above 0, 1 without deformation; 1 throughout where
/// the surface is held and has no cortex.
double stability_margin(const Problem&, const SurfaceState&);
/// The same by what decides of it.
double stability_margin(const Media&, double radius_ratio, const SurfaceExtremes&);
double stability_margin(const Problem&, const Discretisation&, const VectorXd& unknowns);
/// Where the cortex resists compression the least, if its margin there is below the given one, and wrinkles are farther
/// from their limit.
std::optional<WeakPoint> weak_point(const Problem&, const SurfaceProfile&, double margin);
/// Of the sphere: 0 for a shell without tension, which some load compresses somewhere at once.
double margin_at_rest(const Problem&);

/// So close to the limit the surface is the reason if Newton fails: no mesh resolves the last stretch.
inline constexpr double small_margin = 0.1;

/// Whether a surface is beyond its limit, or (near it, or where it is held) its contour shows more changes of
/// curvature than a rear dent and a hollow flank make.
bool is_wrinkled(const Problem&, const Discretisation&, const VectorXd& unknowns);

}  // namespace rheocyte
