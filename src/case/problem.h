// The problem in dimensionless groups: what every floor above `case` computes with.
//
// Lengths are measured in the tube radius R, velocities in the mean speed U = Q / (pi R^2), and stresses in
// S = eta U / R, where eta is the viscosity at the shear rate U / R (docs/theory.md, eq:scales).
#pragma once
#include <algorithm>

#include "laws/media.h"
#include "laws/wall_profile.h"

namespace rheocyte {

/// How a case is computed: the stationary shape at once, or the way to it (docs/theory-time.md).
enum class TimeScheme { stationary, monolithic, partitioned };

/// What the viscosity of the interior is to its elasticity: beside it, in series with it, or in series with a spring of
/// its own, both beside it.
enum class Viscoelasticity { kelvin_voigt, maxwell, standard_linear_solid };

/// The channel's cross-section. A tube also stands for the square channel of the same pressure drop.
enum class Section { tube, square, rectangle };

/// Half the width and half the height of a rectangle, in h, which is the lesser one.
struct Extent {
  double width = 1, height = 1;
};

/// Whether the channel is computed in three dimensions.
inline bool is_duct(Section section) { return section != Section::tube; }

/// From where the camera looks at a cell in a duct: so far round the flow from the direction of the height. `side`
/// looks at right angles onto a wall, `diagonal` along the diagonal of a square, `along_width` along the width.
struct Camera {
  double degrees = 0;

  static const Camera side, diagonal, along_width;
  bool operator==(const Camera&) const = default;
};
inline constexpr Camera Camera::side{0}, Camera::diagonal{45}, Camera::along_width{90};

/// Where a cell off the axis of a duct is: at the given place, or where it does not drift, sought from there.
enum class CellPlace { given, equilibrium };

/// What is wanted as accurately as the case says of a cell off the axis: the deformation of its silhouette, or its
/// velocity, drift and rotation, which are right sooner.
enum class AccuracyOf { deformation, motion };

/// What drives the liquid: a given flow rate, a given pressure drop over the channel, or a pressure drop that is
/// adapted in each step in time until the flow rate is the wanted one (Mokbel et al. 2017).
enum class Drive { rate, pressure_drop, controlled_pressure };

/// Half-length (in R) of the part of the channel where the cell disturbs the flow most.
inline double disturbed_half_length(double radius_ratio) { return 1.4 * radius_ratio + 0.8; }

/// Least half-length (in R) of a simulated channel. The slowest Stokes mode decays like exp(-4.47 x/R): its round trip
/// through the undisturbed part to the end and back is damped by exp(-8.9 * 2) = 2e-8.
inline double min_half_length(double radius_ratio) { return disturbed_half_length(radius_ratio) + 2.0; }

/// The same in a duct (in h). The slowest mode of a square decays as in a tube of radius 1.1, that of a wide slit like
/// exp(-pi x/h) with half its width as h.
inline double disturbed_half_length(double radius_ratio, const Extent& extent) {
  return disturbed_half_length(radius_ratio) + 0.5 * (std::max(extent.width, extent.height) - 1);
}
inline double min_half_length(double radius_ratio, const Extent& extent) {
  const double wide = std::max(extent.width, extent.height);
  return disturbed_half_length(radius_ratio, extent) + wide * (1.1 + 0.33 * (1 - 1 / wide)) * 2.0;
}

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

/// One case, dimensionless: the media and the channel that they are in.
struct Problem : Media {
  Section section = Section::tube;
  Extent extent = {};
  Camera camera = Camera::side;  ///< in a duct
  double radius_ratio = 0.5;     ///< r0 / R, in (0, 0.965)
  double offset = 0;             ///< in a duct: of the cell from the axis, towards the camera, in h
  CellPlace place = CellPlace::given;
  Drive drive = Drive::rate;          ///< the given rate is 1; the given pressure drop that of the undisturbed flow
  double pressure_gradient = 0;       ///< in a duct the given one, in S/h, where U is a nominal speed
  double channel_length = 0;          ///< simulated, in R; 0: the shortest, 2 min_half_length()
  WallTable wall;                     ///< the way of the cell; acts in time only
  AxialTensionTable tension_profile;  ///< likewise, in place of the media's tension
  double start_stretch = 1;           ///< of the cell along the flow when it starts in time
  double accuracy = 1e-4;             ///< wanted relative accuracy of the deformation
  AccuracyOf accuracy_of = AccuracyOf::deformation;  ///< off the axis
};

/// The same cell in the same channel with other media.
inline Problem with_media(Problem problem, const Media& media) {
  static_cast<Media&>(problem) = media;
  return problem;
}

/// The problem on its way from the rigid cell.
inline Problem at_compliance(const Problem& problem, double compliance) {
  return with_media(problem, media_at(problem, compliance));
}

}  // namespace rheocyte
