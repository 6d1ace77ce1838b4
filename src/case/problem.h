// The stationary problem in dimensionless groups: what every floor above `case` computes with.
//
// Lengths are measured in the tube radius R, velocities in the mean speed U = Q / (pi R^2), and stresses in
// S = eta U / R for a Newtonian liquid and S = K (U/R)^n for a power-law liquid (docs/theory.md, eq:scales).
#pragma once
#include <cmath>
#include <vector>

namespace rheocyte {

enum class LiquidLaw { newtonian, power_law };

/// Bulk laws of the cell (docs/theory.md, eq:bulk): `linear` is the Euler-Almansi law of Mokbel et al. 2017,
/// the pure c2 member of the Mooney-Rivlin family; `neo_hookean` is the pure c1 member.
/// `none`: no elastic interior but a liquid at rest, a pure shell.
enum class BulkLaw { linear, neo_hookean, mooney_rivlin, none };

/// Elastic laws of the cell's surface (docs/theory.md, eq:cortex): `linear`, `thin_shell`, `neo_hookean` are those of
/// Mokbel et al. 2017; `neo_hookean_reference` is the usual membrane law with its energy per reference area.
enum class CortexLaw { none, linear, thin_shell, neo_hookean, neo_hookean_reference };

/// How a case is computed: the stationary shape at once, or the way to it (docs/theory-time.md).
enum class TimeScheme { stationary, monolithic, partitioned };

/// What drives the liquid: a given flow rate, a given pressure drop over the channel, or a pressure drop that is
/// adapted in each step in time until the flow rate is the wanted one (Mokbel et al. 2017).
enum class Drive { rate, pressure_drop, controlled_pressure };

/// Pressure gradient (positive number, in S/R) of a power-law liquid in a tube of radius 1 at mean speed 1: 8 for n
/// = 1.
inline double undisturbed_pressure_gradient(double exponent) {
  return 2 * std::pow((3 * exponent + 1) / exponent, exponent);
}

/// Half-length (in R) of the part of the channel where the cell disturbs the flow most.
inline double disturbed_half_length(double radius_ratio) { return 1.4 * radius_ratio + 0.8; }

/// Least half-length (in R) of a simulated channel. The slowest Stokes mode decays like exp(-4.47 x/R): its round trip
/// through the undisturbed part to the end and back is damped by exp(-8.9 * 2) = 2e-8.
inline double least_half_length(double radius_ratio) { return disturbed_half_length(radius_ratio) + 2.0; }

/// Physical size of the dimensionless units, SI.
struct Scales {
  double length_m = 1;          ///< tube radius R
  double velocity_m_per_s = 1;  ///< mean speed U = Q / (pi R^2), undisturbed if the pressure drop is given
  double stress_Pa = 1;         ///< S = eta U / R, or K (U/R)^n

  double time_s() const { return length_m / velocity_m_per_s; }
};

/// Radii of a channel that is not straight, at places from the start of the cell; constant beyond the ends. Empty:
/// straight. In R, which is the least of the radii.
struct WallTable {
  std::vector<double> x, radius;
  bool is_straight() const { return x.empty(); }
};

/// One stationary case, dimensionless.
struct Problem {
  double radius_ratio = 0.5;  ///< r0 / R, in (0, 0.95)
  LiquidLaw liquid = LiquidLaw::newtonian;
  double exponent = 1;             ///< flow behaviour index n of the power law
  double shear_rate_floor = 1e-2;  ///< regularisation of the power law, in U/R: gdot -> sqrt(gdot^2 + floor^2)
  double reynolds = 0;             ///< rho U^2 / S; 0 = Stokes
  Drive drive = Drive::rate;       ///< the given rate is 1; the given pressure drop that of the undisturbed flow
  double channel_length = 0;       ///< simulated, in R; 0: the shortest, 2 least_half_length()
  BulkLaw bulk = BulkLaw::neo_hookean;
  double shear_modulus = 10;  ///< mu / S = E / (3 S)
  double mooney_share = 1;    ///< a of the Mooney-Rivlin law: a (B - I) + (1 - a) (I - B^-1)
  CortexLaw cortex = CortexLaw::none;
  double cortex_modulus = 0;     ///< E2D / (S R)
  double tension = 0;            ///< gamma / (S R)
  double bending_stiffness = 0;  ///< c_b / (S R^3)
  double accuracy = 1e-4;        ///< wanted relative accuracy of the deformation
  WallTable wall;                ///< the way of the cell; acts in time only
  double cell_viscosity = 0;     ///< eta1 U / (R S); acts only while the cell moves
  double cell_reynolds = 0;      ///< of the cell's density, rho1 U^2 / S; likewise
};

}  // namespace rheocyte
