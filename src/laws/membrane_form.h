// The weak form of the cell's surface in three dimensions at a point of a face (docs/theory-square.md, eq:membrane).
// The laws are those of the meridian (laws/cortex.h), on the invariants of the deformation of the surface.
#pragma once
#include <array>

#include "laws/cortex.h"
#include "laws/derivative.h"
#include "laws/fields.h"

namespace rheocyte {

/// First fundamental form of a surface with respect to the coordinates s and t of its face.
template <class T>
struct SurfaceMetric {
  T ss, st, tt;

  T det() const { return ss * tt - st * st; }
};

/// Positions differentiated with respect to s and t.
template <class T>
struct MembraneFields {
  Components<T, 3> s, t;

  static constexpr int count = 6;
  template <class Visitor>
  void visit(const Visitor& on) {
    visit_vector(on, Source::position, s, 1);
    visit_vector(on, Source::position, t, 2);
  }
  SurfaceMetric<T> metric() const { return {dot(s, s), dot(s, t), dot(t, t)}; }
};

/// The metric of the undeformed surface, its parts along the flow and across it.
struct RestMetric {
  SurfaceMetric<double> along, across;

  /// That of the spheroid that the shell rests in (docs/theory.md, eq:rest-shape).
  SurfaceMetric<double> at_rest(double rest_stretch) const {
    const double a = rest_stretch * rest_stretch, b = 1 / rest_stretch;
    return {a * along.ss + b * across.ss, a * along.st + b * across.st, a * along.tt + b * across.tt};
  }
};

/// Elastic energy and surface tension.
struct MembranePoint {
  Cortex law;
  SurfaceMetric<double> rest;  ///< of the shell without stress

  /// Energy per d(s) d(t).
  template <class T>
  T operator()(const MembraneFields<T>& f) const {
    using std::sqrt;
    const SurfaceMetric<T> now = f.metric();
    const T area = sqrt(now.det()), stretch = area / constant<T>(sqrt(rest.det()));
    // l1^2 + l2^2 is the trace of rest^-1 now.
    const T squares =
        (constant<T>(rest.tt) * now.ss - constant<T>(2 * rest.st) * now.st + constant<T>(rest.ss) * now.tt) /
        constant<T>(rest.det());
    const T sum = sqrt(squares + constant<T>(2) * stretch);
    return (shell_energy_of(law, sum, stretch) + constant<T>(law.tension)) * area;
  }
  /// The same of the numbers of the fields.
  template <class T>
  T operator()(const std::array<T, MembraneFields<T>::count>& numbers) const {
    return (*this)(read_fields<MembraneFields<T>>([&](int i) { return numbers[i]; }));
  }
};

/// The pressure of a liquid interior against the volume: its parts of all faces of a closed surface, and of the faces
/// of a part of it that mirror planes through the centre cut out, are integrals of x . (s x t) / 3.
struct InflationPoint {
  double rest_pressure = 0;  ///< Laplace's pressure of the sphere at rest
  double rest_volume = 0;    ///< per d(s) d(t)
  double axial_tension = 0;  ///< of the surroundings (docs/theory.md, eq:axial-tension)

  /// Of x, s, t and the pressure above that at rest, which is the first of the last three numbers.
  template <class T>
  T operator()(const std::array<T, 12>& n) const {
    const T volume =
        (n[0] * (n[4] * n[8] - n[5] * n[7]) + n[1] * (n[5] * n[6] - n[3] * n[8]) + n[2] * (n[3] * n[7] - n[4] * n[6])) *
        constant<T>(1.0 / 3);
    return (n[9] + constant<T>(rest_pressure)) * (constant<T>(rest_volume) - volume);
  }

  /// What the axial tension does on x, per d(s) d(t): T n_x, which no energy gives.
  template <class T>
  T pull(const std::array<T, 12>& n) const {
    return constant<T>(axial_tension) * (n[4] * n[8] - n[5] * n[7]);
  }
};

}  // namespace rheocyte
