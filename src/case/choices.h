// What a case chooses: the enumerations, and how a duct and its camera are oriented. Nothing here knows a law.
#pragma once
#include "laws/choices.h"

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

/// What is requested as accurately as the case says of a cell off the axis: the deformation of its silhouette, or its
/// velocity, drift and rotation, which are right sooner.
enum class AccuracyOf { deformation, motion };

/// What drives the liquid: a given flow rate, a given pressure drop over the channel, or a pressure drop that is
/// adapted in each step in time until the flow rate is the requested one (Mokbel et al. 2017).
enum class Drive { rate, pressure_drop, controlled_pressure };

}  // namespace rheocyte
