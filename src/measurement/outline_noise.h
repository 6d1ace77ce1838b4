// Errors of a segmentation beside those of the pixels (docs/theory-populations.md, eq:outline-noise).
#pragma once
#include <Eigen/Core>

#include "numeric/cell_random.h"

namespace rheocyte {

/// How far an outline is off, and over which length it is off alike.
struct OutlineNoise {
  double deviation = 0;      ///< standard deviation of the displacement along the normal; 0: none
  double correlation = 0.7;  ///< standard deviation of the Gaussian that smooths it along the outline; usual one in um

  OutlineNoise scaled(double lengths) const { return {lengths * deviation, lengths * correlation}; }
};

/// The same polygon at equal distances along its length, displaced; by a negative deviation to the other side. Lengths
/// in the unit of the outline.
Eigen::MatrixX2d displaced(const Eigen::MatrixX2d& outline, const OutlineNoise& noise, CellRandom& random);

}  // namespace rheocyte
