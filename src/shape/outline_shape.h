// Shape of an outline as a camera sees it: its convex hull as a polygon, and the cosine modes of the hull's radius.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

#include "shape/outline_tilt.h"
#include "shape/polygon.h"
#include "shape/radius_modes.h"

namespace rheocyte {

/// Modes k = min_mode .. max_mode; the first one vanishes about the centroid but for second order.
inline constexpr int min_mode = 2, max_mode = 12, mode_count = max_mode - min_mode + 1;
/// The power of the compliance with which the flow makes a mode of a stiff round cell (docs/theory-tables.md): odd ones
/// change their sign with the flow's.
constexpr int order_of_mode(int k) { return k % 2 == 1 ? 1 : 2; }

/// Of the convex hull of a closed polygon; moments and radius about its centroid (docs/theory-extract.md, eq:modes).
struct OutlineShape {
  double area = 0, deformation = 0, moment_ratio = 1;  ///< Lambda1 / Lambda2, as in shape/measures.h
  double x = 0, y = 0;                                 ///< centroid
  double mean_radius = 0;                              ///< over all directions
  /// c_k of r(theta) = mean radius (1 + sum c_k cos(k theta) + sines), theta = 0 along +x, where the liquid flows to.
  std::array<double, mode_count> modes{};
};

/// What a shape is described by: size (area, or ln of it in a ShapeVector), deformation, Lambda1 / Lambda2, and the
/// modes.
enum class ShapeFeature { area_um2, deformation, moment_ratio, first_mode };
inline constexpr int feature_count = int(ShapeFeature::first_mode) + mode_count;
constexpr int feature_of_mode(int k) { return int(ShapeFeature::first_mode) + k - min_mode; }

/// ln(area), deformation, Lambda1 / Lambda2, modes: all errors are then absolute and of the size of a small number.
using ShapeVector = Eigen::Matrix<double, feature_count, 1>;
ShapeVector shape_vector(const OutlineShape& shape);

/// What a camera adds to the features of a shape: measured = true + bias + noise.
struct ShapeErrors {
  ShapeVector bias = ShapeVector::Zero();
  Eigen::Matrix<double, feature_count, feature_count> covariance =
      Eigen::Matrix<double, feature_count, feature_count>::Zero();
};

/// Points (x, y) in order, the first one not repeated, at least one; NaN everywhere if all lie on a line.
OutlineShape outline_shape(const Eigen::MatrixX2d& polygon);
/// The same without its radius and modes, which take most of the time.
OutlineShape outline_figure(const Eigen::MatrixX2d& polygon);

/// The same of a polygon that is its own hull: counterclockwise, without points on its edges. NaN below three points.
OutlineShape hull_shape(const Polygon& hull);
OutlineShape hull_figure(const Polygon& hull);

/// The first of its modes alone.
RadiusModes hull_modes(const Polygon& hull);

/// Of the same polygon, what distinguishes a cell of the model from any other, and how it lies to the flow; NaN below
/// three points.
struct HullAsymmetry {
  double moment_ratio = no_value, mode_2 = no_value, mode_3 = no_value, mode_4 = no_value, mode_5 = no_value;  ///< c_k
  SineModes sine_modes{no_value, no_value, no_value};

  double inertia_ratio() const { return 1 / std::sqrt(moment_ratio); }
};
HullAsymmetry hull_asymmetry(const Polygon& hull);

/// The closed polygon of a meridian (x, r) and its mirror image.
Eigen::MatrixX2d mirrored(const Eigen::MatrixX2d& meridian);

/// The outline with these modes, area and nothing else, `points` of them; about the origin.
Eigen::MatrixX2d outline_of_modes(const std::array<double, mode_count>& modes, double area, int points);

/// The one of which the hull has these modes and this area, to 1e-4 of the radius if there is one.
Eigen::MatrixX2d outline_of_hull_modes(const std::array<double, mode_count>& modes, double area, int points);

/// Volume of the body of revolution about the x-axis of a closed outline that is symmetric about it and starts at an
/// angle of 0: that of its upper half.
double volume_of_revolution(const Eigen::MatrixX2d& outline);

}  // namespace rheocyte
