// Three dimensions without symmetry of rotation: the counterpart of axisymmetric.h (docs/theory-square.md,
// eq:cartesian). Tensor entries: 0 = x along the flow, 1 = y, 2 = z.
#pragma once
#include "laws/axisymmetric.h"

namespace rheocyte {

template <class T>
struct MapFields<T, 3> {
  Slopes<T, 3> G;  ///< d(x, y, z)/d(xi)

  static constexpr int count = 9;
  template <class Visitor>
  void visit(const Visitor& on) {
    visit_slopes(on, Source::position, G);
  }
};

template <class T>
struct PointMap<T, 3> : MapFields<T, 3> {
  T det;                 ///< det G; negative where the mesh is folded
  Slopes<T, 3> inverse;  ///< G^-1

  explicit PointMap(const MapFields<T, 3>& fields) : MapFields<T, 3>(fields) {
    const auto& A = fields.G;
    inverse = adjugate(A);
    det = A(0, 0) * inverse(0, 0) + A(0, 1) * inverse(1, 0) + A(0, 2) * inverse(2, 0);
    inverse = inverse / det;
  }
  /// Volume per d(xi).
  T volume() const { return det; }
};

/// Gradient in space of a vector field with derivatives v_xi = d v/d(xi).
template <class T>
Tensor<T> gradient(const PointMap<T, 3>& map, const Components<T, 3>&, const Slopes<T, 3>& v_xi) {
  return v_xi * map.inverse;
}

/// Deformation gradient dx/dX between the undeformed map (numbers) and the current map of the same point.
template <class T>
Tensor<T> deformation_gradient(const PointMap<T, 3>& map, const PointMap<double, 3>& undeformed) {
  Tensor<T> F;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      F(i, j) = map.G(i, 0) * undeformed.inverse(0, j) + map.G(i, 1) * undeformed.inverse(1, j) +
                map.G(i, 2) * undeformed.inverse(2, j);
    }
  }
  return F;
}

/// Pull-back of sigma : grad(phi) to the reference element.
template <class T>
Flux<T, 3> pull_back(const PointMap<T, 3>& map, const Tensor<T>& sigma) {
  Flux<T, 3> flux;
  flux.value = Components<T, 3>::Zero();
  flux.slope = sigma * map.inverse.transpose() * map.det;
  return flux;
}

}  // namespace rheocyte
