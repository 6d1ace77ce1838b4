// The weak form of the cell in the splitting of Mokbel et al. 2017 (docs/theory-time.md, eq:split-cell): an
// incompressible viscous flow on the present shape, driven by the elastic stress of that shape.
#pragma once
#include "laws/weak_form.h"

namespace rheocyte {

/// v is the velocity in the laboratory.
template <class T>
struct SplitCellFields {
  Components<T, 2> v;
  Slopes<T, 2> v_xi;
  T p;

  static constexpr int count = 7;
  template <class Visitor>
  void visit(const Visitor& on) {
    visit_vector(on, Source::velocity, v);
    visit_slopes(on, Source::velocity, v_xi);
    on(Input{Source::pressure}, p);
  }
};

/// Linear in its fields.
struct SplitCellPoint {
  template <class T>
  using Fields = SplitCellFields<T>;

  Bulk law;
  PointMap<double, 2> undeformed, map;
  double rate = 0;  ///< 1 / step
  Components<double, 2> velocity_before = Components<double, 2>::Zero();

  template <class T>
  Flux<T, 2> operator()(const SplitCellFields<T>& f) const {
    const PointMap<T, 2> here(MapFields<T, 2>{map.G.template cast<T>(), T(map.r)});
    const Tensor<T> L = gradient(here, f.v, f.v_xi);
    const Tensor<double> loaded = loaded_stress(law, deformation_gradient(map, undeformed));
    Tensor<T> sigma = (L + L.transpose()) * T(law.viscosity) + loaded.template cast<T>();
    for (int i = 0; i < 3; ++i) sigma(i, i) -= f.p;
    Flux<T, 2> flux = pull_back(here, sigma);
    const double mass = law.reynolds * map.volume() * rate;
    for (int c = 0; c < 2; ++c) flux.value(c) += (f.v(c) - T(velocity_before(c))) * T(mass);
    flux.pressure = -(L(0, 0) + L(1, 1) + L(2, 2)) * T(map.volume());
    return flux;
  }
};

}  // namespace rheocyte
