// The weak form of the surface at a point of the meridian, and at the vertices between its polynomial pieces
// (docs/theory.md, eq:surface, eq:kink).
//
// The meridian (x, r)(t) runs from the front pole to the rear pole, t in [0, 1] on each piece; everything is per d(t)
// and per radian.
#pragma once
#include <array>
#include <cmath>

#include "laws/cortex.h"
#include "laws/derivative.h"

namespace rheocyte {

/// Principal Cauchy tensions T_i = f + l_i df/dl_i of the energy f per current area, surface tension included.
template <class T>
std::array<T, 2> principal_tensions(const Cortex& cortex, const T& l1, const T& l2) {
  const auto energy = [&](const auto& l) { return shell_energy(cortex, l[0], l[1]); };
  const auto [f, slope] = value_and_slopes<2, T>(energy, {l1, l2});
  return {f + l1 * slope[0] + constant<T>(cortex.tension), f + l2 * slope[1] + constant<T>(cortex.tension)};
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
  double speed = 1, r = 1;  ///< |d(x, r)/dt|, distance to the axis
  double volume = 0;        ///< -r^2/2 dx/dt: volume of the cell
};

/// Inputs in this order: x, r, x_t, r_t, x_tt, r_tt, excess of the inner pressure over `rest_pressure`.
struct SurfacePoint {
  static constexpr int inputs = 7;
  /// (value, slope, second slope) of the x-test and of the r-test, pressure test, axial moment of the volume.
  static constexpr int outputs = 8;

  Cortex law;
  double rest_pressure = 0;  ///< Laplace's pressure 2 gamma / r0 of the sphere at rest
  SurfaceReference reference;

  template <class T>
  std::array<T, outputs> operator()(const std::array<T, inputs>& f) const {
    const T &x = f[0], &r = f[1], &x_t = f[2], &r_t = f[3];
    const Meridian<T> here{x_t, r_t, f[4], f[5], r};
    const T speed = here.speed();
    // Virtual work of the tensions: T1 r delta(speed) + T2 speed delta(r).
    const auto [T1, T2] =
        principal_tensions(law, T(speed / constant<T>(reference.speed)), T(r / constant<T>(reference.r)));
    const T pull = T1 * r / speed;
    // Work -p delta(volume) of the inner pressure, volume = -r^2/2 x_t.
    const T p = f[6] + constant<T>(rest_pressure), half_r2 = r * r * constant<T>(0.5);
    std::array<T, outputs> flux = {constant<T>(0),
                                   pull * x_t + p * half_r2,
                                   constant<T>(0),
                                   T2 * speed + p * r * x_t,
                                   pull * r_t,
                                   constant<T>(0),
                                   half_r2 * x_t + constant<T>(reference.volume),
                                   x * x * r * r_t * constant<T>(0.5)};
    if (law.bending != 0) add_bending(here, flux);
    return flux;
  }

 private:
  template <class T>
  void add_bending(const Meridian<T>& here, std::array<T, outputs>& flux) const {
    const auto energy = [this](const auto& m) {
      using Dual = typename std::decay_t<decltype(m)>::value_type;
      const Meridian<Dual> meridian{m[0], m[1], m[2], m[3], m[4]};
      const auto curvature = meridian.curvatures();
      return bending_energy(law, Dual(curvature[0] + curvature[1])) * meridian.r * meridian.speed();
    };
    const auto [density, slope] = value_and_slopes<5, T>(energy, {here.x_t, here.r_t, here.x_tt, here.r_tt, here.r});
    flux[1] += slope[0];
    flux[2] += slope[2];
    flux[3] += slope[4];
    flux[4] += slope[1];
    flux[5] += slope[3];
  }
};

/// Bending at a vertex where two pieces meet at an angle alpha: alpha is curvature concentrated in a point. Its work
/// against the mean moment, and a penalty that makes it vanish with refinement (symmetric interior penalty).
/// Inputs: x_t, r_t, x_tt, r_tt at the end of the piece before, the same at the start of the piece after, r.
struct SurfaceKink {
  static constexpr int inputs = 9;

  Cortex law;
  double penalty = 0;  ///< some multiple of degree^2

  /// Energy per radian.
  template <class T>
  T operator()(const std::array<T, inputs>& f) const {
    using std::atan2;
    const Meridian<T> before{f[0], f[1], f[2], f[3], f[8]}, after{f[4], f[5], f[6], f[7], f[8]};
    const T alpha =
        atan2(T(before.x_t * after.r_t - before.r_t * after.x_t), T(before.x_t * after.x_t + before.r_t * after.r_t));
    const auto k = before.curvatures(), l = after.curvatures();
    const T mean_curvature = (k[0] + k[1] + l[0] + l[1]) * constant<T>(0.5);
    const T inverse_length = (constant<T>(1) / before.speed() + constant<T>(1) / after.speed()) * constant<T>(0.5);
    return constant<T>(law.bending / 4) * f[8] * alpha *
           (mean_curvature + alpha * inverse_length * constant<T>(0.5 * penalty));
  }
};

}  // namespace rheocyte
