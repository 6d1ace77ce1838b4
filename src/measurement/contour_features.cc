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

/// Integrals over the polygon; the sign of the orientation is removed.
struct PolygonMoments {
  double area = 0, x = 0, y = 0;        // area and centroid
  double mu20 = 0, mu11 = 0, mu02 = 0;  // about the centroid
};

// Green's theorem about the first point. All terms are whole numbers; for a contour in a picture they and their sums
// are exact in double precision, and what a damaged file holds does not overflow.
PolygonMoments moments_of(std::span<const PixelPoint> polygon) {
  const PixelPoint origin = polygon[0];
  double twice_area = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  double x0 = polygon.back().x - origin.x, y0 = polygon.back().y - origin.y;
  for (const PixelPoint& point : polygon) {
    const double x1 = point.x - origin.x, y1 = point.y - origin.y, c = x0 * y1 - x1 * y0;
    twice_area += c;
    sx += c * (x0 + x1);
    sy += c * (y0 + y1);
    sxx += c * (x0 * x0 + x0 * x1 + x1 * x1);
    sxy += c * (x0 * (2 * y0 + y1) + x1 * (y0 + 2 * y1));
    syy += c * (y0 * y0 + y0 * y1 + y1 * y1);
    x0 = x1;
    y0 = y1;
  }
  if (twice_area == 0) return {};
  const double sign = twice_area > 0 ? 1 : -1, area = 0.5 * sign * twice_area;
  const double x = sign * sx / (6 * area), y = sign * sy / (6 * area);
  return {area,
          x + origin.x,
          y + origin.y,
          sign * sxx / 12 - area * x * x,
          sign * sxy / 24 - area * x * y,
          sign * syy / 12 - area * y * y};
}

double perimeter_of(std::span<const PixelPoint> polygon) {
  double length = 0;
  PixelPoint before = polygon.back();
  for (const PixelPoint& point : polygon) {
    const double dx = point.x - before.x, dy = point.y - before.y;
    length += std::sqrt(dx * dx + dy * dy);
    before = point;
  }
  return length;
}

struct Principal {
  double ratio, tilt;
};

// The eigenvalues of the matrix of second moments are the moments along the principal axes.
Principal principal_axes(const PolygonMoments& m) {
  const double tilt = std::abs(0.5 * std::atan2(-2 * m.mu11, m.mu20 - m.mu02));
  const double mean = 0.5 * (m.mu20 + m.mu02), half = std::hypot(0.5 * (m.mu20 - m.mu02), m.mu11);
  return {std::sqrt((mean + half) / (mean - half)), tilt};
}

// The part of the integral of pi r^2 dz below the straight piece from (z0, r0) to (z1, r1), of either sign.
double frustum(double dz, double r0, double r1) { return dz * (r0 * r0 + r0 * r1 + r1 * r1); }

}  // namespace

double volume_of_rotation(std::span<const PixelPoint> contour, double y) {
  double right = 0, left = 0;
  PixelPoint before = contour.back();
  for (const PixelPoint& point : contour) {
    const double dz = point.x - before.x;
    right += frustum(dz, std::max(before.y - y, 0.0), std::max(point.y - y, 0.0));
    left += frustum(dz, std::max(y - before.y, 0.0), std::max(y - point.y, 0.0));
    before = point;
  }
  // The halves run in opposite directions along the axis; the direction of the contour itself does not count.
  return std::numbers::pi / 3 * std::abs(right - left) / 2;
}

ContourFeatures ContourMeasurer::measure(std::span<const PixelPoint> contour, double pixel_size_um) {
  if (contour.size() < 4) return no_features;
  const auto hull_points = hull_.of(contour);
  if (hull_points.size() < 3) return no_features;
  const PolygonMoments hull = moments_of(hull_points), raw = moments_of(contour);
  if (!(hull.area > 0) || !(raw.area > 0)) return no_features;
  const auto [left, right] = std::ranges::minmax(hull_points, {}, &PixelPoint::x);
  const auto [top, bottom] = std::ranges::minmax(hull_points, {}, &PixelPoint::y);
  const auto [ratio, tilt] = principal_axes(raw);
  const double px = pixel_size_um;
  return {.area_um2 = hull.area * px * px,
          .deformation = 1 - 2 * std::sqrt(std::numbers::pi * hull.area) / perimeter_of(hull_points),
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
          .volume_um3 = volume_of_rotation(contour, hull.y) * px * px * px,
          .raw_perimeter_um = perimeter_of(contour) * px};
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
