// The two weak forms at a quadrature point, as functions from fields to fluxes (docs/theory.md, eq:weak), in any
// dimension for which there is a map. Written once; evaluated with doubles for the residual and with dual numbers for
// the exact tangent.
#pragma once
#include "laws/axisymmetric.h"
#include "laws/bulk.h"
#include "laws/liquid.h"

namespace rheocyte {

/// Fields in the liquid; w is the velocity relative to the cell.
template <class T, int dim>
struct LiquidFields {
  MapFields<T, dim> map;
  Components<T, dim> w;
  Slopes<T, dim> w_xi;
  T p;

  static constexpr int count = MapFields<T, dim>::count + dim + dim * dim + 1;
  template <class Visitor>
  void visit(const Visitor& on) {
    map.visit(on);
    visit_vector(on, Source::velocity, w);
    visit_slopes(on, Source::velocity, w_xi);
    on(Input{Source::pressure}, p);
  }
};

/// Fields in the cell.
template <class T, int dim>
struct CellFields {
  MapFields<T, dim> map;
  T p;

  static constexpr int count = MapFields<T, dim>::count + 1;
  template <class Visitor>
  void visit(const Visitor& on) {
    map.visit(on);
    on(Input{Source::pressure}, p);
  }
};

template <int dim>
struct LiquidPoint {
  template <class T>
  using Fields = LiquidFields<T, dim>;

  Liquid law;

  template <class T>
  Flux<T, dim> operator()(const LiquidFields<T, dim>& f) const {
    const PointMap<T, dim> map(f.map);
    const Tensor<T> L = gradient(map, f.w, f.w_xi);
    Tensor<T> sigma = viscous_stress(law, L);
    for (int i = 0; i < 3; ++i) sigma(i, i) -= f.p;
    Flux<T, dim> flux = pull_back(map, sigma);
    const T volume = map.volume();
    if (law.reynolds != 0) {
      Vector<T> w = Vector<T>::Zero();
      for (int c = 0; c < dim; ++c) w(c) = f.w(c);
      const Vector<T> a = inertia(law, w, L);
      for (int c = 0; c < dim; ++c) flux.value(c) += a(c) * volume;
    }
    flux.pressure = -(L(0, 0) + L(1, 1) + L(2, 2)) * volume;
    return flux;
  }
};

template <int dim>
struct CellPoint {
  template <class T>
  using Fields = CellFields<T, dim>;

  Bulk law;
  PointMap<double, dim> undeformed;

  template <class T>
  Flux<T, dim> operator()(const CellFields<T, dim>& f) const {
    const PointMap<T, dim> map(f.map);
    const T J = map.volume() / T(undeformed.volume());
    Tensor<T> sigma = loaded_stress(law, deformation_gradient(map, undeformed)) / J;
    for (int i = 0; i < 3; ++i) sigma(i, i) -= f.p;
    Flux<T, dim> flux = pull_back(map, sigma);
    flux.pressure = T(undeformed.volume()) - map.volume();
    return flux;
  }
};

}  // namespace rheocyte
