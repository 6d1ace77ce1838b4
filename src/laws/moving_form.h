// The weak forms at a quadrature point while cell and liquid move (docs/theory-time.md, eq:momentum-time). They are
// those of the stationary problem plus what depends on time.
//
// Within a time step the derivative of a field is affine in its new value: d(field)/dt = rate * field + history
// (docs/theory-time.md, eq:bdf). So the time terms are functions of the same unknowns, and dual numbers see them.
#pragma once
#include "laws/cartesian.h"
#include "laws/weak_form.h"

namespace rheocyte {

template <class T>
struct MovingLiquidFields : LiquidFields<T, 2> {
  T u_x;  ///< axial displacement of the mesh

  static constexpr int count = LiquidFields<T, 2>::count + 1;
  template <class Visitor>
  void visit(const Visitor& on) {
    LiquidFields<T, 2>::visit(on);
    on(Input{Source::position, 0}, u_x);
  }
};

/// Without inertia, as in three dimensions, the slopes of the map are enough.
template <class T, int dim>
struct MovingCellFields : CellFields<T, dim> {};

template <class T>
struct MovingCellFields<T, 2> : CellFields<T, 2> {
  T u_x;     ///< axial displacement
  T v_cell;  ///< of the frame

  static constexpr int count = CellFields<T, 2>::count + 2;
  template <class Visitor>
  void visit(const Visitor& on) {
    CellFields<T, 2>::visit(on);
    on(Input{Source::position, 0}, u_x);
    on(Input{Source::frame}, v_cell);
  }
};

/// What earlier time steps decide in the liquid.
struct LiquidHistory {
  Components<double, 2> mesh = Components<double, 2>::Zero();      ///< of the mesh's velocity, from (u_x, r)
  Components<double, 2> velocity = Components<double, 2>::Zero();  ///< of dw/dt
};

struct MovingLiquidPoint {
  template <class T>
  using Fields = MovingLiquidFields<T>;

  Liquid law;
  double rate = 0;
  LiquidHistory history = {};

  /// Adds Re (dw/dt - (grad w) m), with the derivative at a fixed point of the mesh, whose velocity is m.
  template <class T>
  Flux<T, 2> operator()(const MovingLiquidFields<T>& f) const {
    Flux<T, 2> flux = LiquidPoint<2>{law}(f);
    if (law.reynolds == 0) return flux;
    const PointMap<T, 2> map(f.map);
    const T mass = map.volume() * T(law.reynolds);
    const Components<T, 2> m(T(rate) * f.u_x + T(history.mesh(0)), T(rate) * f.map.r + T(history.mesh(1)));
    const Components<T, 2> carried = f.w_xi * (map.inverse * m);
    for (int c = 0; c < 2; ++c) flux.value(c) += mass * (T(rate) * f.w(c) + T(history.velocity(c)) - carried(c));
    return flux;
  }
};

/// Parts of the cell's velocity, its slope and its acceleration that earlier time steps decide.
template <int dim>
struct CellHistory {
  Components<double, dim> velocity = Components<double, dim>::Zero();  ///< from (u_x, r); in axial symmetry alone
  Slopes<double, dim> velocity_slope = Slopes<double, dim>::Zero();    ///< from G
  Slopes<double, dim> turning =
      Slopes<double, dim>::Zero();  ///< that of the velocity with which the material turns at spin 1
  Components<double, dim> acceleration = Components<double, dim>::Zero();
  Tensor<double> branch = Tensor<double>::Zero();          ///< of the branch's metric
  Tensor<double> branch_turning = Tensor<double>::Zero();  ///< of what the turning at spin 1 makes of it

  /// With what the material carries along as it turns.
  CellHistory at_spin(double spin) const {
    CellHistory turned = *this;
    turned.velocity_slope += spin * turning;
    turned.branch += spin * branch_turning;
    return turned;
  }
};

template <int dim>
struct MovingCellPoint {
  template <class T>
  using Fields = MovingCellFields<T, dim>;

  Bulk law;
  PointMap<double, dim> undeformed;
  double excess_reynolds = 0;  ///< of the cell's density over the liquid's: feels the acceleration of the frame
  double rate = 0;
  CellHistory<dim> history = {};
  double frame_history = 0;  ///< of the acceleration of the frame, from v_cell

  /// Adds the viscous stress, 2 eta1 D or that of the branch, and the inertia of the cell; its mass stays with its
  /// points.
  template <class T>
  Flux<T, dim> operator()(const MovingCellFields<T, dim>& f) const {
    Flux<T, dim> flux = CellPoint<dim>{law, undeformed}(f);
    const PointMap<T, dim> map(f.map);
    Slopes<T, dim> v_xi;
    for (int i = 0; i < dim * dim; ++i)
      v_xi(i / dim, i % dim) = T(rate) * map.G(i / dim, i % dim) + T(history.velocity_slope(i / dim, i % dim));
    const Components<T, dim> v = velocity(f, map);
    const Flux<T, dim> viscous = pull_back(map, viscous_stress(map, v, v_xi));
    if constexpr (dim == 2) {
      const double mass = undeformed.volume();
      flux.value(0) += (T(rate) * f.v_cell + T(frame_history)) * T(excess_reynolds * mass);
      for (int c = 0; c < 2; ++c) {
        const T acceleration = T(rate) * v(c) + T(history.acceleration(c));
        flux.value(c) += viscous.value(c) + acceleration * T(law.reynolds * mass);
      }
    }
    for (int c = 0; c < dim; ++c) {
      for (int k = 0; k < dim; ++k) flux.slope(c, k) += viscous.slope(c, k);
    }
    return flux;
  }

 private:
  /// In three dimensions nothing depends on the velocity itself.
  template <class T>
  Components<T, dim> velocity(const MovingCellFields<T, dim>& f, const PointMap<T, dim>& map) const {
    if constexpr (dim == 2)
      return {T(rate) * f.u_x + T(history.velocity(0)), T(rate) * map.r + T(history.velocity(1))};
    else
      return Components<T, dim>::Zero();
  }

  template <class T>
  Tensor<T> viscous_stress(const PointMap<T, dim>& map, const Components<T, dim>& v, const Slopes<T, dim>& v_xi) const {
    if (law.branch_modulus > 0) {
      const T J = map.volume() / T(undeformed.volume());
      return branch_stress(law, deformation_gradient(map, undeformed), rate, history.branch) / J;
    }
    const Tensor<T> L = gradient(map, v, v_xi);
    return (L + L.transpose()) * T(law.viscosity);
  }
};

}  // namespace rheocyte
