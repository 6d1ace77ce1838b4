#include "shape/measures.h"

#include <cmath>

#include "numeric/no_value.h"
#include "shape/arc_integrals.h"
#include "shape/convex_hull.h"

namespace rheocyte {
namespace {

ShapeMeasures no_measures() {
  ShapeMeasures none{no_value, no_value, no_value, no_value, no_value, no_value, no_value,
                     no_value, no_value, no_value, no_value, {},       {}};
  none.modes.fill(no_value);
  none.modes_raw.fill(no_value);
  return none;
}

}  // namespace

ShapeMeasures measure(const Contour& contour) {
  const auto meridian = SampledMeridian::of(contour);
  const auto hull = meridian ? convex_hull(*meridian, HullParts::all) : std::nullopt;
  if (!hull) return no_measures();

  const double origin = meridian->points().col(0).mean();
  const ArcChain outline = whole(*meridian);
  const ArcIntegrals raw = integrate(outline, origin), convex = integrate(hull->arcs, origin);
  if (!(raw.area > 0 && raw.volume > 0)) return no_measures();
  return {.area = convex.area,
          .perimeter = convex.perimeter,
          .deformation = convex.deformation(),
          .area_raw = raw.area,
          .perimeter_raw = raw.perimeter,
          .deformation_raw = raw.deformation(),
          .volume = raw.volume,
          .barycentre = origin + raw.volume_x / raw.volume,
          .moment_ratio = convex.lateral_moment() / convex.axial_moment(),
          .inertia_ratio = std::sqrt(convex.axial_moment() / convex.lateral_moment()),
          .moment_ratio_raw = raw.lateral_moment() / raw.axial_moment(),
          .modes = radius_modes(hull->arcs, origin + convex.area_x / convex.area),
          .modes_raw = radius_modes(outline, origin + raw.area_x / raw.area)};
}

}  // namespace rheocyte
