// What is measured of a cell, as a function of its radius and stiffness: all that the estimator of populations knows of
// mechanics, pixels and tables (docs/theory-populations.md, sec. "Forward map").
#pragma once

namespace rheocyte {

/// Mean measured values of a cell with their slopes and the covariance of their noise. The measure determines the
/// stiffness: it falls as the cell gets stiffer.
struct MapPoint {
  double log_area = 0, measure = 0;                      ///< ln(um^2)
  double log_area_by_radius = 0, measure_by_radius = 0;  ///< slopes by u at constant x
  double log_area_by_height = 0, measure_by_height = 0;  ///< by x at constant u
  double area_variance = 0, covariance = 0, measure_variance = 0;
};

/// Coordinates are u = ln(r0 / um) and x = ln E - g(u), with g(u) = ln(E / kPa) of the softest cell of the map at a
/// viscosity of 1 mPa s: x is 0 there and grows with the stiffness.
class ForwardMap {
 public:
  virtual ~ForwardMap() = default;

  /// Within the ranges; beyond them the rim's cell counts.
  virtual MapPoint at(double u, double x) const = 0;
  struct Interval {
    double lower, upper;
  };
  virtual Interval log_radii() const = 0;
  virtual Interval heights() const = 0;

  struct SoftEnd {
    double log_modulus, slope;
  };
  /// g and its slope.
  virtual SoftEnd soft_end(double u) const = 0;
};

/// Slopes of the measured values by u at constant modulus.
struct RadiusSlopes {
  double log_area, measure;
};
inline RadiusSlopes at_constant_modulus(const MapPoint& point, double soft_end_slope) {
  return {point.log_area_by_radius - soft_end_slope * point.log_area_by_height,
          point.measure_by_radius - soft_end_slope * point.measure_by_height};
}

/// Standard error of ln E of one cell by its two measured values: (J^T C^-1 J)^-1.
double event_error(const ForwardMap& map, double u, double log_modulus_per_mPas);

}  // namespace rheocyte
