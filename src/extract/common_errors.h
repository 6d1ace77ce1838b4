// What the moduli of all events of a recording have in common of their errors, so that more events do not make it
// smaller (docs/theory-extract.md, sec. "Elongated cells").
#pragma once
#include <cmath>

#include "events/plausibility.h"
#include "infer/elongated_solids.h"

namespace rheocyte {

/// Standard deviations, relative to the modulus, of its median in a recording, by pixels, table and the liquid's
/// inertia; what is wrong with viscosity, flow rate and pixel size comes on top. `of_event` is the standard error of
/// the median event, of which the law of the pixels leaves up to a quarter in the median (bench/pixel_coverage). Masks
/// differ in which pixels of the edge they contain: a sixteenth of a pixel along rows and columns changes the
/// deformation by 0.0055 pixels per radius and the modulus by three tenths of that error
/// (bench/independent_recordings.py).
inline double common_error_by_deformation(double of_event, double reynolds) {
  constexpr double left_by_law = 0.25, of_masks = 0.3;
  return std::hypot(std::hypot(left_by_law, of_masks) * of_event, modulus_per_reynolds * reynolds);
}

/// The same of the table of elongated cells, for cells of the model's shapes: by how much medians are off where every
/// mask has other rules for the edge (bench/independent_recordings.py).
inline double common_error_of_elongated(ElongatedBy by, double reynolds) {
  const double left = by == ElongatedBy::modes ? 0.006 : 0.025;
  return std::hypot(left, modulus_per_reynolds * reynolds);
}

/// What comes on top of it, relative, for cells of other shapes. Those that a tension draws out are 0 to 0.6 % off,
/// those that are long at rest 2 to 6 % too stiff by the outlines (bench/independent_recordings.py), linear solids
/// 0.2 to 2.7 %.
inline constexpr double common_error_of_other_shapes = 0.025;
/// The same of cells that lie 1 um off the axis in height, which no image shows: they look elongated, and their modulus
/// comes out 4 to 6 % too high, at 2 um 20 to 25 % (6.5 um, 4 kPa in a square channel of 20 um; it grows as the
/// square).
inline constexpr double error_of_height = 0.06;
/// The same of elongated cells without outlines, which may have a cortex: one sample of HL60 has 0.970 kPa from its
/// outlines, 0.721 kPa from deformation and inertia ratio (docs/real-cells.md).
inline constexpr double error_of_unseen_cortex = 0.35;

/// Of the effective modulus of cells with a cortex, relative, by the proportions of bulk, cortex and tension: at equal
/// area, deformation and inertia ratio it moves by -3 to +9 % where the cortex makes 0.45 to 0.75 of the stiffness and
/// its tension is 0.4 to 0.85 of E2D, by up to 17 % at 0.2; a solid would have 30 to 55 % more (docs/theory-extract.md,
/// sec. "The effective modulus"). Of E + E2D / r0, and of the axial tension.
inline constexpr double error_of_proportions = 0.04, error_of_unseen_proportions = 0.1, stiffness_by_proportions = 0.3,
                        tension_by_proportions = 0.15;

/// The same of the elongation by the axial tension, and of that tension over Young's modulus, in cells that a tension
/// draws out (bench/round_trip_elongated).
inline double common_error_of_elongation() { return 0.005; }
inline double common_error_of_tension_ratio(ElongatedBy by) { return by == ElongatedBy::modes ? 0.004 : 0.01; }

}  // namespace rheocyte
