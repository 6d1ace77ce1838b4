// Features of the outlines of solids, what pixels make of them, and their noise.
#pragma once
#include <Eigen/Core>

#include "measurement/pixel_errors.h"
#include "table/elongated_table.h"

namespace rheocyte {

/// What determines the stiffness beside the area, and what determines the elongation, which is eliminated: c_3 with
/// c_2; deformation with the inertia ratio; the deformation of cells that nothing but the flow elongates.
enum class StiffnessMeasure { asymmetry, odd_deformation, deformation };

/// Features of an outline without pixels, and through pixels on average.
struct SolidFeatures {
  double log_area = 0, deformation = 0, inertia_ratio = 0;
  OutlineModes modes;
};

/// On average; area and deformation as the measure's law has them.
SolidFeatures through_pixels(const SolidFeatures& smooth, StiffnessMeasure by, double pixel_size_um);

/// Of a cell of the table in a channel that is so many times as large.
SolidFeatures features_of(const ElongatedState& state, double length_factor);

/// What determines the elongation, and what determines the stiffness.
double elongation_of(const SolidFeatures& features, StiffnessMeasure by);
double measure_of(const SolidFeatures& features, StiffnessMeasure by);

/// Covariance of (ln A, elongation, measure) by pixels, at measured values.
Eigen::Matrix3d noise_of(const SolidFeatures& seen, StiffnessMeasure by, double pixel_size_um);

}  // namespace rheocyte
