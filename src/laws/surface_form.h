// The weak form of the surface at a point of the meridian, and at the vertices between its polynomial pieces
// (docs/theory.md, eq:surface, eq:kink).
//
// The meridian (x, r)(t) runs from the front pole to the rear pole, t in [0, 1] on each piece; everything is per d(t)
// and per radian.
#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "laws/cortex.h"
#include "laws/derivative.h"
#include "laws/fields.h"

namespace rheocyte {

/// Principal Cauchy tensions T_i = f + l_i df/dl_i of the energy f per current area, surface tension included.
template <class T>
std::array<T, 2> principal_tensions(const Cortex& cortex, const T& l1, const T& l2) {
  const auto energy = [&](const auto& l) { return shell_energy(cortex, l[0], l[1]); };
  const auto [f, slope] = value_and_slopes(energy, std::array<T, 2>{l1, l2});
  return {f + l1 * slope[0] + constant<T>(cortex.tension), f + l2 * slope[1] + constant<T>(cortex.tension)};
}

/// What the shell opposes to being compressed farther along the direction 1: the change of T1 with ln l1, l2 fixed.
/// Below 0 the more compressed part of a surface draws in its neighbours (docs/theory.md, eq:collapse).
inline double resistance_to_compression(const Cortex& cortex, double l1, double l2) {
  const auto tension = [&](const auto& l) {
    using Number = typename std::decay_t<decltype(l)>::value_type;
    return principal_tensions(cortex, l[0], constant<Number>(l2))[0];
  };
  return l1 * value_and_slopes(tension, std::array{l1}).second[0];
}

/// A point of the meridian with its derivatives.
template <class T>
struct Meridian {
  T x_t, r_t, x_tt, r_tt, r;

  T speed() const {
    using std::sqrt;
    return sqrt(x_t * x_t + r_t * r_t);
  }
  /// Curvature along the meridian and in the hoop direction; both 1/a for a sphere of radius a.
  std::array<T, 2> curvatures() const {
    const T s = speed();
    return {(x_t * r_tt - r_t * x_tt) / (s * s * s), -x_t / (r * s)};
  }
};

/// What the undeformed surface is at the same point.
struct SurfaceReference {
  double x_t = 0, r_t = 1, r = 1;  ///< d(x, r)/dt, distance to the axis

  double speed() const { return std::sqrt(x_t * x_t + r_t * r_t); }
  double volume() const { return -0.5 * r * r * x_t; }  ///< of the cell
  /// The same of the spheroid that the shell rests in (eq:rest-shape).
  SurfaceReference at_rest(double rest_stretch) const {
    const double across = 1 / std::sqrt(rest_stretch);
    return {rest_stretch * x_t, across * r_t, across * r};
  }
};

/// Fields on the surface; a source's part k is its k-th derivative with respect to t.
template <class T>
struct SurfaceFields {
  Components<T, 2> x, x_t, x_tt;  ///< (x, r) and its derivatives
  T p;                            ///< excess of the inner pressure over the rest pressure

  static constexpr int count = 7;
  template <class Visitor>
  void visit(const Visitor& on) {
    visit_vector(on, Source::position, x);
    visit_vector(on, Source::position, x_t, 1);
    visit_vector(on, Source::position, x_tt, 2);
    on(Input{Source::pressure}, p);
  }
  Meridian<T> meridian() const { return {x_t(0), x_t(1), x_tt(0), x_tt(1), x(1)}; }
};

/// What the surface does on the test functions of position (and their derivatives), pressure and frame.
template <class T>
struct SurfaceFlux {
  Components<T, 2> value, slope, second;
  T volume;  ///< change of the cell's
  T moment;  ///< axial one of the volume

  static constexpr int count = 8;
  template <class Visitor>
  void visit(const Visitor& on) {
    visit_vector(on, Source::position, value);
    visit_vector(on, Source::position, slope, 1);
    visit_vector(on, Source::position, second, 2);
    on(Input{Source::pressure}, volume);
    on(Input{Source::frame}, moment);
  }
};

struct SurfacePoint {
  Cortex law;
  double rest_pressure = 0;  ///< Laplace's pressure 2 gamma / r0 of the sphere at rest
  SurfaceReference reference;

  template <class T>
  SurfaceFlux<T> operator()(const SurfaceFields<T>& f) const {
    const Meridian<T> here = f.meridian();
    const T &x = f.x(0), &r = here.r, speed = here.speed();
    // Virtual work of the tensions: T1 r delta(speed) + T2 speed delta(r).
    const SurfaceReference rest = reference.at_rest(law.rest_stretch);
    const auto [T1, T2] = principal_tensions(law, T(speed / constant<T>(rest.speed())), T(r / constant<T>(rest.r)));
    const T pull = T1 * r / speed;
    // Work -p delta(volume) of the inner pressure, volume = -r^2/2 x_t; the axial tension does that along x alone.
    const T p = f.p + constant<T>(rest_pressure), half_r2 = r * r * constant<T>(0.5);
    SurfaceFlux<T> flux;
    flux.value = {constant<T>(0), T2 * speed + p * r * here.x_t};
    flux.slope = {pull * here.x_t + (p + constant<T>(law.axial_tension)) * half_r2, pull * here.r_t};
    flux.second = Components<T, 2>::Zero();
    flux.volume = half_r2 * here.x_t + constant<T>(reference.volume());
    flux.moment = x * x * r * here.r_t * constant<T>(0.5);
    if (law.bending != 0) add_bending(here, flux);
    return flux;
  }

 private:
  template <class T>
  void add_bending(const Meridian<T>& here, SurfaceFlux<T>& flux) const {
    const auto energy = [this](const auto& m) {
      using Number = typename std::decay_t<decltype(m)>::value_type;
      const Meridian<Number> meridian{m[0], m[1], m[2], m[3], m[4]};
      const auto curvature = meridian.curvatures();
      return bending_energy(law, Number(curvature[0] + curvature[1])) * meridian.r * meridian.speed();
    };
    const auto [density, work] =
        value_and_slopes(energy, std::array<T, 5>{here.x_t, here.r_t, here.x_tt, here.r_tt, here.r});
    flux.slope(0) += work[0];
    flux.slope(1) += work[1];
    flux.second(0) += work[2];
    flux.second(1) += work[3];
    flux.value(1) += work[4];
  }
};

/// Fields at a vertex, of the piece before and of the piece after; component 2 side + c is c of that side's piece.
template <class T>
struct KinkFields {
  std::array<Components<T, 2>, 2> x_t, x_tt;
  T r;

  static constexpr int count = 9;
  template <class Visitor>
  void visit(const Visitor& on) {
    for (int side = 0; side < 2; ++side) {
      for (int c = 0; c < 2; ++c) on(Input{Source::position, 2 * side + c, 1}, x_t[side](c));
      for (int c = 0; c < 2; ++c) on(Input{Source::position, 2 * side + c, 2}, x_tt[side](c));
    }
    on(Input{Source::position, 3}, r);
  }
  Meridian<T> meridian(int side) const { return {x_t[side](0), x_t[side](1), x_tt[side](0), x_tt[side](1), r}; }
};

/// Bending at a vertex where two pieces meet at an angle alpha: alpha is curvature concentrated in a point. Its work
/// against the mean moment, and a penalty that makes it vanish with refinement (symmetric interior penalty).
struct SurfaceKink {
  Cortex law;
  double penalty = 0;  ///< some multiple of degree^2

  /// Energy per radian.
  template <class T>
  T operator()(const KinkFields<T>& f) const {
    using std::atan2;
    const Meridian<T> before = f.meridian(0), after = f.meridian(1);
    const T alpha =
        atan2(T(before.x_t * after.r_t - before.r_t * after.x_t), T(before.x_t * after.x_t + before.r_t * after.r_t));
    const auto k = before.curvatures(), l = after.curvatures();
    const T mean_curvature = (k[0] + k[1] + l[0] + l[1]) * constant<T>(0.5);
    const T inverse_length = (constant<T>(1) / before.speed() + constant<T>(1) / after.speed()) * constant<T>(0.5);
    return constant<T>(law.bending / 4) * f.r * alpha *
           (mean_curvature + alpha * inverse_length * constant<T>(0.5 * penalty));
  }
  /// The same of the numbers of the fields.
  template <class T>
  T operator()(const std::array<T, KinkFields<T>::count>& numbers) const {
    return (*this)(read_fields<KinkFields<T>>([&](int i) { return numbers[i]; }));
  }
};

}  // namespace rheocyte
