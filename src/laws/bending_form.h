// Bending of the cell's surface in three dimensions: the energy at a point of a face, and at a point of an edge where
// two faces meet at an angle (docs/theory-square.md, eq:bending, eq:edge).
#pragma once
#include <array>
#include <cmath>

#include "laws/cortex.h"
#include "laws/tensor.h"

namespace rheocyte {

/// First and second derivatives of a surface's positions with respect to two coordinates a and b; a x b points out of
/// the cell.
template <class T>
struct SurfaceSlopes {
  Vector<T> a, b, aa, ab, bb;

  Vector<T> area() const { return cross(a, b); }
  /// Sum of the principal curvatures: 2/r for a sphere of radius r.
  T curvature() const {
    using std::sqrt;
    const Vector<T> n = area();
    const T det = dot(n, n);
    return (constant<T>(2) * dot(a, b) * dot(ab, n) - dot(b, b) * dot(aa, n) - dot(a, a) * dot(bb, n)) /
           (det * sqrt(det));
  }
};

/// Bending energy per d(a) d(b).
struct BendingPoint {
  Cortex law;

  template <class T>
  T operator()(const SurfaceSlopes<T>& f) const {
    using std::sqrt;
    const Vector<T> n = f.area();
    return bending_energy(law, f.curvature()) * sqrt(dot(n, n));
  }
};

/// Bending at a point of an edge, where the surfaces before and behind it have a common coordinate a along it, and b
/// runs across it from the one to the other. As at the vertices of a meridian (laws/surface_form.h) an angle is
/// curvature concentrated on the edge: its work against the mean moment, and a penalty that makes it vanish with
/// refinement.
struct BendingEdge {
  Cortex law;
  double penalty = 0;  ///< some multiple of degree^2

  /// Energy per d(a).
  template <class T>
  T operator()(const SurfaceSlopes<T>& before, const SurfaceSlopes<T>& behind) const {
    using std::atan2, std::sqrt;
    const Vector<T> m = before.area(), n = behind.area();
    const T along = sqrt(dot(before.a, before.a));
    // The direction across the edge on the surface before it is the normal turned about the edge.
    const T angle = atan2(T(dot(n, cross(m, before.a)) / along), dot(m, n));
    const T inverse_width =
        along * (constant<T>(1) / sqrt(dot(m, m)) + constant<T>(1) / sqrt(dot(n, n))) * constant<T>(0.5);
    const T mean_curvature = (before.curvature() + behind.curvature()) * constant<T>(0.5);
    return constant<T>(law.bending / 4) * along * angle *
           (mean_curvature + angle * inverse_width * constant<T>(0.5 * penalty));
  }
};

}  // namespace rheocyte
