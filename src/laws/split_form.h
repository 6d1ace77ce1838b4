// The weak form of the cell in the splitting of Mokbel et al. 2017 (docs/theory-time.md, eq:split-cell): an
// incompressible viscous flow on the present shape, driven by the elastic stress of that shape.
#pragma once
#include "laws/weak_form.h"

namespace rheocyte {

/// Inputs in this order: v_x, v_r, d(v)/d(xi) row by row, p; v is the velocity in the laboratory. Linear in them.
struct SplitCellPoint {
  static constexpr int inputs = 7;
  static constexpr int outputs = CellPoint::outputs;

  Bulk law;
  Place<double> reference, place;
  double rate = 0;  ///< 1 / step
  PlaneVector<double> velocity_before = PlaneVector<double>::Zero();

  template <class T>
  std::array<T, outputs> operator()(const std::array<T, inputs>& f) const {
    Plane<T> G, v_xi;
    G << T(place.G(0, 0)), T(place.G(0, 1)), T(place.G(1, 0)), T(place.G(1, 1));
    v_xi << f[2], f[3], f[4], f[5];
    const Place<T> here(G, T(place.r));
    const PlaneVector<T> v(f[0], f[1]);
    const Tensor<T> L = gradient(here, v, v_xi);
    const Tensor<double> elastic = elastic_stress(law, deformation_gradient(place, reference));
    Tensor<T> sigma = (L + L.transpose()) * T(law.viscosity);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sigma(i, j) += T(elastic(i, j));
      sigma(i, i) -= f[6];
    }
    const Flux<T> flux = pull_back(here, sigma);
    const double mass = law.reynolds * place.volume() * rate;
    const T divergence = (L(0, 0) + L(1, 1) + L(2, 2)) * T(place.volume());
    return {flux.value(0) + (f[0] - T(velocity_before(0))) * T(mass),
            flux.slope(0, 0),
            flux.slope(0, 1),
            flux.value(1) + (f[1] - T(velocity_before(1))) * T(mass),
            flux.slope(1, 0),
            flux.slope(1, 1),
            -divergence};
  }
};

}  // namespace rheocyte
