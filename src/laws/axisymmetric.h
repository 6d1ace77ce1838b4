// Axial symmetry in one place: from fields on the meridian half-plane to full 3 x 3 tensors and back
// (docs/theory.md, eq:axisymmetric). The laws never see it; a 3D floor replaces this file alone.
//
// Coordinates: x along the flow, r >= 0 to the axis; xi = (xi1, xi2) are those of a reference element.
// Tensor entries: 0 = x, 1 = r, 2 = hoop direction.
#pragma once
#include "laws/tensor.h"

namespace rheocyte {

template <class T>
using Plane = Eigen::Matrix<T, 2, 2>;
template <class T>
using PlaneVector = Eigen::Matrix<T, 2, 1>;

/// The map xi -> (x, r) at a point: G = d(x, r)/d(xi), the distance r to the axis.
template <class T>
struct Place {
  Plane<T> G;
  T r;
  T det;             ///< det G; negative where the mesh is folded
  Plane<T> inverse;  ///< G^-1

  Place(const Plane<T>& gradient, const T& distance) : G(gradient), r(distance) {
    det = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0);
    const T s = T(1) / det;
    inverse << G(1, 1) * s, -G(0, 1) * s, -G(1, 0) * s, G(0, 0) * s;
  }
  /// Volume per d(xi) and per radian: r det G.
  T volume() const { return r * det; }
};

/// Gradient in space of a vector field v = (v_x, v_r) with derivatives v_xi = d v/d(xi).
template <class T>
Tensor<T> gradient(const Place<T>& place, const PlaneVector<T>& v, const Plane<T>& v_xi) {
  Tensor<T> L = Tensor<T>::Zero();
  L.template topLeftCorner<2, 2>() = v_xi * place.inverse;
  L(2, 2) = v(1) / place.r;
  return L;
}

/// Deformation gradient dx/dX between a reference place (numbers) and the current place of the same point.
template <class T>
Tensor<T> deformation_gradient(const Place<T>& place, const Place<double>& reference) {
  Tensor<T> F = Tensor<T>::Zero();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      F(i, j) = place.G(i, 0) * reference.inverse(0, j) + place.G(i, 1) * reference.inverse(1, j);
    }
  }
  F(2, 2) = place.r / reference.r;
  return F;
}

/// What a stress does on a test function phi, per d(xi) and radian: value . phi + slope : d(phi)/d(xi).
template <class T>
struct Flux {
  PlaneVector<T> value;
  Plane<T> slope;
};

/// Pull-back of sigma : grad(phi) to the reference element.
template <class T>
Flux<T> pull_back(const Place<T>& place, const Tensor<T>& sigma) {
  Flux<T> flux;
  flux.value << T(0), sigma(2, 2) * place.det;
  const Plane<T> plane = sigma.template topLeftCorner<2, 2>();
  flux.slope = plane * place.inverse.transpose() * place.volume();
  return flux;
}

}  // namespace rheocyte
