// The problem in dimensionless groups: what every floor above `case` computes with.
//
// Lengths are measured in the tube radius R, velocities in the mean speed U = Q / (pi R^2), and stresses in
// S = eta U / R, where eta is the viscosity at the shear rate U / R (docs/theory.md, eq:scales).
#pragma once
#include <algorithm>

#include "case/choices.h"
#include "case/physical_scales.h"
#include "laws/media.h"
#include "laws/wall_profile.h"

namespace rheocyte {

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
  AxialTensionTable tension_profile;  ///< as above, in place of the media's tension
  double start_stretch = 1;           ///< of the cell along the flow when it starts in time
  double accuracy = 1e-4;             ///< requested relative accuracy of the deformation
  AccuracyOf accuracy_of = AccuracyOf::deformation;  ///< off the axis
};

/// The same cell in the same channel with other media.
inline Problem with_media(Problem problem, const Media& media) {
  static_cast<Media&>(problem) = media;
  return problem;
}

}  // namespace rheocyte
