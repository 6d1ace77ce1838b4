// The weak forms at a quadrature point while cell and liquid move (docs/theory-time.md, eq:momentum-time). They are
// those of the stationary problem plus what depends on time.
//
// Within a time step the derivative of a field is affine in its new value: d(field)/dt = rate * field + history
// (docs/theory-time.md, eq:bdf). So the time terms are functions of the same unknowns, and dual numbers see them.
#pragma once
#include "laws/weak_form.h"

namespace rheocyte {

/// Field values as in LiquidPoint, then the axial displacement of the mesh.
struct MovingLiquidPoint {
  static constexpr int inputs = LiquidPoint::inputs + 1;
  static constexpr int outputs = LiquidPoint::outputs;

  Liquid law;
  double rate = 0;
  PlaneVector<double> mesh_history = PlaneVector<double>::Zero();  ///< of the mesh's velocity, from (u_x, r)
  PlaneVector<double> velocity_history = PlaneVector<double>::Zero();

  /// Adds Re (dw/dt - (grad w) m), with the derivative at a fixed point of the mesh, whose velocity is m.
  template <class T>
  std::array<T, outputs> operator()(const std::array<T, inputs>& f) const {
    std::array<T, LiquidPoint::inputs> steady;
    for (int i = 0; i < LiquidPoint::inputs; ++i) steady[i] = f[i];
    std::array<T, outputs> flux = LiquidPoint{law}(steady);
    if (law.reynolds == 0) return flux;
    Plane<T> G, w_xi;
    G << f[0], f[1], f[2], f[3];
    w_xi << f[7], f[8], f[9], f[10];
    const Place<T> place(G, f[4]);
    const T mass = place.volume() * T(law.reynolds);
    const PlaneVector<T> m(T(rate) * f[12] + T(mesh_history(0)), T(rate) * f[4] + T(mesh_history(1)));
    const PlaneVector<T> carried = w_xi * (place.inverse * m);
    for (int c = 0; c < 2; ++c) flux[3 * c] += mass * (T(rate) * f[5 + c] + T(velocity_history(c)) - carried(c));
    return flux;
  }
};

/// Parts of the cell's velocity, its slope and its acceleration that earlier time steps decide.
struct CellHistory {
  PlaneVector<double> velocity = PlaneVector<double>::Zero();  ///< from (u_x, r)
  Plane<double> velocity_slope = Plane<double>::Zero();        ///< from G
  PlaneVector<double> acceleration = PlaneVector<double>::Zero();
  double frame_acceleration = 0;  ///< from v_cell
};

/// Field values as in CellPoint, then the axial displacement and v_cell.
struct MovingCellPoint {
  static constexpr int inputs = CellPoint::inputs + 2;
  static constexpr int outputs = CellPoint::outputs;

  Bulk law;
  Place<double> reference;
  double excess_reynolds = 0;  ///< of the cell's density over the liquid's: feels the acceleration of the frame
  double rate = 0;
  CellHistory history;

  /// Adds the viscous stress 2 eta1 D and the inertia of the cell; its mass stays with its points.
  template <class T>
  std::array<T, outputs> operator()(const std::array<T, inputs>& f) const {
    std::array<T, CellPoint::inputs> steady;
    for (int i = 0; i < CellPoint::inputs; ++i) steady[i] = f[i];
    std::array<T, outputs> flux = CellPoint{law, reference}(steady);
    Plane<T> G, v_xi;
    G << f[0], f[1], f[2], f[3];
    const Place<T> place(G, f[4]);
    for (int i = 0; i < 4; ++i) v_xi(i / 2, i % 2) = T(rate) * f[i] + T(history.velocity_slope(i / 2, i % 2));
    const PlaneVector<T> v(T(rate) * f[6] + T(history.velocity(0)), T(rate) * f[4] + T(history.velocity(1)));
    const Tensor<T> L = gradient(place, v, v_xi);
    const Flux<T> viscous = pull_back(place, Tensor<T>((L + L.transpose()) * T(law.viscosity)));
    const double mass = reference.volume();
    const PlaneVector<T> frame((T(rate) * f[7] + T(history.frame_acceleration)) * T(excess_reynolds * mass), T(0));
    for (int c = 0; c < 2; ++c) {
      const T acceleration = T(rate) * v(c) + T(history.acceleration(c));
      flux[3 * c] += viscous.value(c) + acceleration * T(law.reynolds * mass) + frame(c);
      flux[3 * c + 1] += viscous.slope(c, 0);
      flux[3 * c + 2] += viscous.slope(c, 1);
    }
    return flux;
  }
};

}  // namespace rheocyte
