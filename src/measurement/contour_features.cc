#include "measurement/contour_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/no_value.h"

namespace rheocyte {

namespace {

constexpr ContourFeatures no_features{no_value, no_value, no_value, no_value, no_value, no_value, no_value,
                                      no_value, no_value, no_value, no_value, no_value, no_value, no_value};

struct Principal {
  double ratio, tilt;
};

// The eigenvalues of the matrix of second moments are the moments along the principal axes.
Principal principal_axes(const PolygonMoments& m) {
  const double tilt = std::abs(0.5 * std::atan2(-2 * m.mu11, m.mu20 - m.mu02));
  const double mean = 0.5 * (m.mu20 + m.mu02), half = std::hypot(0.5 * (m.mu20 - m.mu02), m.mu11);
  return {std::sqrt((mean + half) / (mean - half)), tilt};
}

}  // namespace

const Polygon& ContourMeasurer::find_hull(std::span<const PixelPoint> contour) {
  hull_polygon_.assign(hull_.of(contour));
  return hull_polygon_;
}

ContourFeatures ContourMeasurer::measure(std::span<const PixelPoint> contour, double pixel_size_um) {
  if (contour.size() < 4) return no_features;
  const PolygonMoments hull = find_hull(contour).moments();
  if (hull_polygon_.corners() < 3) return no_features;
  polygon_.assign(contour);
  const PolygonMoments raw = polygon_.moments();
  if (!(hull.area > 0) || !(raw.area > 0)) return no_features;
  const auto hull_points = hull_.points();
  const auto [left, right] = std::ranges::minmax(hull_points, {}, &PixelPoint::x);
  const auto [top, bottom] = std::ranges::minmax(hull_points, {}, &PixelPoint::y);
  const auto [ratio, tilt] = principal_axes(raw);
  const double px = pixel_size_um;
  return {.area_um2 = hull.area * px * px,
          .deformation = 1 - 2 * std::sqrt(std::numbers::pi * hull.area) / hull.perimeter,
          .x_um = hull.x * px,
          .y_um = hull.y * px,
          .raw_area_px = raw.area,
          .area_ratio = hull.area / raw.area,
          .width_um = (right.x - left.x + 1) * px,
          .height_um = (bottom.y - top.y + 1) * px,
          .inertia_ratio = std::sqrt(hull.mu20 / hull.mu02),
          .inertia_ratio_raw = std::sqrt(raw.mu20 / raw.mu02),
          .inertia_ratio_principal = ratio,
          .tilt = tilt,
          .volume_um3 = polygon_.volume_of_rotation(hull.y) * px * px * px,
          .raw_perimeter_um = raw.perimeter * px};
}

namespace {

using F = ContourFeatures;

double hull_perimeter_um(const F& f) { return 2 * std::sqrt(std::numbers::pi * f.area_um2) / (1 - f.deformation); }
double raw_area_um2(const F& f) { return f.area_um2 / f.area_ratio; }

constexpr OutlineFeature all_outline_features[] = {
    {"area_cvx", "px", "area of the convex hull", [](const F& f) { return f.raw_area_px * f.area_ratio; }},
    {"area_msd", "px", "area of the outline", [](const F& f) { return f.raw_area_px; }},
    {"area_ratio", "", "area of the hull over that of the outline", [](const F& f) { return f.area_ratio; }},
    {"area_um", "um2", "area of the convex hull", [](const F& f) { return f.area_um2; }},
    {"area_um_raw", "um2", "area of the outline", raw_area_um2},
    {"aspect", "", "length over height, both in whole pixels", [](const F& f) { return f.width_um / f.height_um; }},
    {"circ", "", "circularity of the hull, 1 - deform", [](const F& f) { return 1 - f.deformation; }},
    {"deform", "", "1 - 2 sqrt(pi A) / P of the hull", [](const F& f) { return f.deformation; }},
    {"deform_raw", "", "the same of the outline",
     [](const F& f) { return 1 - 2 * std::sqrt(std::numbers::pi * raw_area_um2(f)) / f.raw_perimeter_um; }},
    {"eccentr_prnc", "", "eccentricity of the ellipse with the principal moments of the outline",
     [](const F& f) { return std::sqrt(1 - 1 / (f.inertia_ratio_principal * f.inertia_ratio_principal)); }},
    {"inert_ratio_cvx", "", "root of the ratio of the second moments of the hull, along the channel over across",
     [](const F& f) { return f.inertia_ratio; }},
    {"inert_ratio_prnc", "", "the same of the outline along its principal axes",
     [](const F& f) { return f.inertia_ratio_principal; }},
    {"inert_ratio_raw", "", "the same of the outline", [](const F& f) { return f.inertia_ratio_raw; }},
    {"per_ratio", "", "perimeter of the outline over that of the hull",
     [](const F& f) { return f.raw_perimeter_um / hull_perimeter_um(f); }},
    {"per_um_raw", "um", "perimeter of the outline", [](const F& f) { return f.raw_perimeter_um; }},
    {"pos_x", "um", "centroid of the hull along the channel", [](const F& f) { return f.x_um; }},
    {"pos_y", "um", "centroid of the hull across the channel", [](const F& f) { return f.y_um; }},
    {"size_x", "um", "length in whole pixels", [](const F& f) { return f.width_um; }},
    {"size_y", "um", "height in whole pixels", [](const F& f) { return f.height_um; }},
    {"tilt", "rad", "angle of the long principal axis to the channel, without sign", [](const F& f) { return f.tilt; }},
    {"volume", "um3", "mean of both halves of the outline rotated about the line through the hull's centroid",
     [](const F& f) { return f.volume_um3; }}};

}  // namespace

std::span<const OutlineFeature> outline_features() { return all_outline_features; }

}  // namespace rheocyte
