// The cell of the model that has the area and the deformation of a measured one: its outline, and its radius at rest.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "infer/modulus_map.h"
#include "infer/shape_map.h"
#include "shape/outline_shape.h"

namespace rheocyte {

struct ModelOutline {
  double area_um2 = 0, deformation = 0;  ///< without what pixels do to them
  double radius_um = 0;                  ///< of the sphere of the same volume
  /// Points (x, y) in um about the centroid of the outline's hull, x along the flow; the first one is not repeated.
  Eigen::MatrixX2d outline;
};

/// The outline with these modes and area, about the centroid of its hull.
Eigen::MatrixX2d outline_about_centroid(const std::array<double, mode_count>& modes, double area_um2, int points = 180);

/// By the modes c_2 to c_7 of the table's shapes (docs/theory-extract.md, eq:modes), with `points` on the outline. The
/// table's nearest cell counts beyond the ends of its states; nothing where area or deformation is not a number, or not
/// that of a deformed cell.
std::optional<ModelOutline> model_outline(const ShapeMap& map, const MeasuringConditions& conditions, double area_um2,
                                          double deformation, int points = 180);

}  // namespace rheocyte
