// Axial symmetry in one place: from fields on the meridian half-plane to full 3 x 3 tensors and back
// (docs/theory.md, eq:axisymmetric). The laws never see it; a geometry in three dimensions replaces this file alone.
//
// Coordinates: x along the flow, r >= 0 to the axis; xi = (xi1, xi2) are those of a reference element.
// Tensor entries: 0 = x, 1 = r, 2 = hoop direction.
#pragma once
#include "laws/fields.h"

namespace rheocyte {

/// What a weak form needs to know of the map xi -> x at a point of an element of `dim` dimensions.
template <class T, int dim>
struct MapFields;

/// The same with what follows from it: determinant, inverse, volume.
template <class T, int dim>
struct PointMap;

template <class T>
struct MapFields<T, 2> {
  Slopes<T, 2> G;  ///< d(x, r)/d(xi)
  T r;             ///< distance to the axis

  static constexpr int count = 5;
  template <class Visitor>
  void visit(const Visitor& on) {
    visit_slopes(on, Source::position, G);
    on(Input{Source::position, 1}, r);
  }
};

template <class T>
struct PointMap<T, 2> : MapFields<T, 2> {
  T det;                 ///< det G; negative where the mesh is folded
  Slopes<T, 2> inverse;  ///< G^-1

  explicit PointMap(const MapFields<T, 2>& fields) : MapFields<T, 2>(fields) {
    const auto& A = fields.G;
    det = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0);
    const T s = T(1) / det;
    inverse = {A(1, 1) * s, -A(0, 1) * s, -A(1, 0) * s, A(0, 0) * s};
  }
  /// Volume per d(xi) and per radian: r det G.
  T volume() const { return this->r * det; }
};

/// Gradient in space of a vector field v = (v_x, v_r) with derivatives v_xi = d v/d(xi).
template <class T>
Tensor<T> gradient(const PointMap<T, 2>& map, const Components<T, 2>& v, const Slopes<T, 2>& v_xi) {
  Tensor<T> L = Tensor<T>::Zero();
  const Slopes<T, 2> plane = v_xi * map.inverse;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) L(i, j) = plane(i, j);
  }
  L(2, 2) = v(1) / map.r;
  return L;
}

/// Deformation gradient dx/dX between the undeformed map (numbers) and the current map of the same point.
template <class T>
Tensor<T> deformation_gradient(const PointMap<T, 2>& map, const PointMap<double, 2>& undeformed) {
  Tensor<T> F = Tensor<T>::Zero();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      F(i, j) = map.G(i, 0) * undeformed.inverse(0, j) + map.G(i, 1) * undeformed.inverse(1, j);
    }
  }
  F(2, 2) = map.r / undeformed.r;
  return F;
}

/// Pull-back of sigma : grad(phi) to the reference element.
template <class T>
Flux<T, 2> pull_back(const PointMap<T, 2>& map, const Tensor<T>& sigma) {
  Flux<T, 2> flux;
  flux.value = {T(0), sigma(2, 2) * map.det};
  const Slopes<T, 2> plane{sigma(0, 0), sigma(0, 1), sigma(1, 0), sigma(1, 1)};
  flux.slope = plane * map.inverse.transpose() * map.volume();
  return flux;
}

}  // namespace rheocyte
