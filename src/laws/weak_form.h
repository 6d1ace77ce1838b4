// The two weak forms at a quadrature point, as functions from field values to fluxes (docs/theory.md, eq:weak).
// Written once; evaluated with doubles for the residual and with dual numbers for the exact tangent.
#pragma once
#include <array>

#include "laws/axisymmetric.h"
#include "laws/bulk.h"
#include "laws/liquid.h"

namespace rheocyte {

/// Field values in the liquid, in this order: d(x,r)/d(xi) row by row, r, w_x, w_r, d(w)/d(xi) row by row, p.
/// w is the velocity relative to the cell.
struct LiquidPoint {
  static constexpr int inputs = 12;
  static constexpr int outputs = 7;  ///< (value, xi1, xi2) of the x-test, the same of the r-test, pressure test

  Liquid law;

  template <class T>
  std::array<T, outputs> operator()(const std::array<T, inputs>& f) const {
    Plane<T> G, w_xi;
    G << f[0], f[1], f[2], f[3];
    w_xi << f[7], f[8], f[9], f[10];
    const Place<T> place(G, f[4]);
    const PlaneVector<T> w(f[5], f[6]);
    const Tensor<T> L = gradient(place, w, w_xi);
    Tensor<T> sigma = viscous_stress(law, L);
    for (int i = 0; i < 3; ++i) sigma(i, i) -= f[11];
    Flux<T> flux = pull_back(place, sigma);
    const T volume = place.volume();
    if (law.reynolds != 0) {
      const Vector<T> a = inertia(law, Vector<T>(w(0), w(1), T(0)), L);
      flux.value += PlaneVector<T>(a(0), a(1)) * volume;
    }
    const T divergence = (L(0, 0) + L(1, 1) + L(2, 2)) * volume;
    return {flux.value(0),    flux.slope(0, 0), flux.slope(0, 1), flux.value(1),
            flux.slope(1, 0), flux.slope(1, 1), -divergence};
  }
};

/// Field values in the cell, in this order: d(x,r)/d(xi) row by row, r, p.
struct CellPoint {
  static constexpr int inputs = 6;
  static constexpr int outputs = 7;  ///< as in the liquid; the first is zero

  Bulk law;
  Place<double> reference;

  template <class T>
  std::array<T, outputs> operator()(const std::array<T, inputs>& f) const {
    Plane<T> G;
    G << f[0], f[1], f[2], f[3];
    const Place<T> place(G, f[4]);
    const T swelling = place.volume() - T(reference.volume());
    const T J = place.volume() / T(reference.volume());
    Tensor<T> sigma = elastic_stress(law, deformation_gradient(place, reference)) / J;
    for (int i = 0; i < 3; ++i) sigma(i, i) -= f[5];
    const Flux<T> flux = pull_back(place, sigma);
    return {flux.value(0),    flux.slope(0, 0), flux.slope(0, 1), flux.value(1),
            flux.slope(1, 0), flux.slope(1, 1), -swelling};
  }
};

}  // namespace rheocyte
