// The triangles of a Delaunay triangulation of points in the plane.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rheocyte {

struct PlanePoint;

/// Numbers of the corners of each triangle, in no particular order or orientation. Empty if Qhull finds none.
std::vector<std::array<std::int32_t, 3>> delaunay_triangles(std::span<const PlanePoint> points);

}  // namespace rheocyte
