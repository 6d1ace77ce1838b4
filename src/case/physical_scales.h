// The physical size of the dimensionless units.
#pragma once

namespace rheocyte {

/// Physical size of the dimensionless units, SI. In a duct of area A they are h, half the lesser of width and height,
/// U = Q / A and S = eta(U/h) U / h (docs/theory-square.md, eq:square-scales).
struct Scales {
  double length_m = 1;          ///< tube radius R, or h
  double velocity_m_per_s = 1;  ///< mean speed U = Q / (pi R^2), undisturbed if the pressure drop is given
  double stress_Pa = 1;         ///< S = eta(U/R) U / R

  double length_um() const { return 1e6 * length_m; }
  double time_s() const { return length_m / velocity_m_per_s; }
  double time_us() const { return 1e6 * time_s(); }
};

}  // namespace rheocyte
