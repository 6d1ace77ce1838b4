// What pixels do to area and deformation of a solid cell's contour, on average and at random: a fitted law, fast enough
// for millions of events in a second (docs/theory-extract.md, eq:pixel-errors). For cells with a cortex, and for all
// features of a shape with their covariance, see infer/rendered_errors.h.
#pragma once
#include <array>

#include "numeric/whole_packets.h"
#include "shape/outline_shape.h"

namespace rheocyte {

/// For a contour through the centres of the outermost pixels; of one event, or of a Packet of them.
template <class Number>
struct PixelErrorsOf {
  Number area_factor;            ///< area of the smooth contour's hull / measured area
  Number deformation_excess;     ///< measured deformation - that of the smooth contour
  Number area_deviation;         ///< standard deviation of ln(area) from cell to cell
  Number deformation_deviation;  ///< of the deformation
  Number correlation;            ///< of both
};
using PixelErrors = PixelErrorsOf<double>;

/// Areas (pixels) for which the law was fitted; outside, the nearest one counts.
inline constexpr double min_fitted_area_px = 50, max_fitted_area_px = 9000;
/// Deformations go up to this; greater ones count as this.
inline constexpr double max_fitted_deformation = 0.15;

/// By the natural logarithm of the measured area in pixels and the measured deformation of a solid. By what one solid
/// differs from another of the same area and deformation counts as scatter; a shell differs by more.
template <class Number>
PixelErrorsOf<Number> pixel_errors(const Number& log_area_px, const Number& deformation);

/// The numbers in it, for programs that cannot call it: polynomials of the deformation and s = (area in pixels)^(-1/3)
/// with coefficients [power of the deformation][power of s], and the least deviations. All but the correlation are
/// multiplied by s^2; 1 is added to the area's.
struct PixelErrorLaws {
  using Law = std::array<std::array<double, 3>, 4>;
  Law area, deformation, area_deviation, deformation_deviation, correlation;
  double min_area_deviation, min_deformation_deviation;
};
PixelErrorLaws pixel_error_laws();

/// The first modes c_k of an outline's radius.
struct OutlineModes {
  double mode_2 = 0, mode_3 = 0, mode_4 = 0, mode_5 = 0;
};

/// For these modes and what goes with them (docs/theory-extract.md, eq:mode-errors).
struct ModeErrors {
  struct OfMode {
    double excess;     ///< measured - that of the smooth contour
    double deviation;  ///< standard deviation of the measured one
  };
  OfMode mode_2, mode_3, mode_4, mode_5;
  double correlation;                         ///< of the scatter of c_2 and c_3
  double deformation_excess, inertia_excess;  ///< measured - those of the smooth contour
  double deformation_deviation;               ///< standard deviation of the measured one
};

/// By the natural logarithm of the measured area in pixels and the measured modes. Pixels make the ends of an elongated
/// cell more alike: they take away the more of c_3 the greater c_2 is. They lie in four directions, so that c_4 counts
/// with c_2 and with the deformation, c_5 with c_3.
ModeErrors mode_errors(double log_area_px, const OutlineModes& modes);

/// For the deformation and the inertia ratio of an elongated cell, whose deformation pixels change in another way than
/// a round one's (docs/theory-extract.md, eq:inertia-errors).
struct InertiaErrors {
  double deformation_excess, inertia_excess;  ///< measured - that of the smooth contour
  double deformation_deviation, inertia_deviation, correlation;
};
InertiaErrors inertia_errors(double log_area_px, double deformation, double inertia_ratio);

/// What the law leaves of c_3 of a single shape, in parts of it (standard deviation); alike in all pictures of it.
inline constexpr double left_by_asymmetry_law = 0.01;

/// What the smooth contour of a measured one is like.
struct SmoothAsymmetry {
  double area_um2 = 0, mode_2 = 0, mode_3 = 0;
  double deviation = 0;  ///< standard deviation of mode_3
};

/// Of the features of a contour through the centres of pixels, which are all numbers.
SmoothAsymmetry without_pixels(const ShapeVector& measured, double pixel_size_um);

/// The inverse: the mean measured area in pixels and deformation of a smooth contour.
struct PixelShape {
  double area_px = 0, deformation = 0;
};
PixelShape seen_through_pixels(const PixelShape& smooth);

}  // namespace rheocyte
