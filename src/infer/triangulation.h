// Linear interpolation between scattered points of a plane: Delaunay triangulation and fast location of points in it.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "numeric/no_value.h"

namespace rheocyte {

struct PlanePoint {
  double x = 0, y = 0;
};

/// The Delaunay triangulation of points, made by Qhull with the options that scipy uses, so that both choose the same
/// triangles where the choice is free (four points on a circle).
class Triangulation {
 public:
  /// One value per point. UserError if the points have no triangulation (all on a line, fewer than three).
  Triangulation(std::span<const PlanePoint> points, std::span<const double> values);

  /// Values at many points, barycentric in the triangle of each; NaN outside the convex hull and for coordinates that
  /// are not finite. Equally long spans (asserted).
  void interpolate(std::span<const double> x, std::span<const double> y, std::span<double> values) const;

  /// The y of the lower and the upper border of the convex hull at x; NaN beyond its ends.
  struct Border {
    double lower = no_value, upper = no_value;
  };
  Border border_at(double x) const;

  double min_x() const { return lower_border_.front().x; }
  double max_x() const { return lower_border_.back().x; }
  std::size_t triangles() const { return triangles_.size(); }

 private:
  // All that one step of the search needs, in two cache lines.
  struct alignas(128) Triangle {
    PlanePoint last;                         // third corner
    std::array<double, 4> to_barycentric;    // rows of the inverse of (first - last, second - last)
    std::array<double, 3> values;            // at the corners
    std::array<std::int32_t, 3> neighbours;  // across the edge opposite each corner; -1: outside
  };
  using Corners = std::array<std::int32_t, 3>;  // of a triangle, by the numbers of the points
  enum class WalkEnd { inside, border, lost };  // border: of the hull, or of a gap

  void make_triangles(std::span<const PlanePoint> points, std::span<const double> values);
  void find_neighbours(std::span<const Corners> corners);
  void make_borders(std::span<const PlanePoint> points);
  void make_start_grid();
  WalkEnd walk(double x, double y, std::int32_t& at, std::array<double, 3>& weights) const;
  double value_at(double x, double y, std::int32_t start) const;
  bool is_near(double x, double y) const;
  std::int32_t search_all(double x, double y, std::array<double, 3>& weights) const;
  std::int32_t start_for(double x, double y) const;

  std::vector<Triangle> triangles_;
  bool has_gaps_ = false;                                // triangles without area were left out
  std::vector<PlanePoint> lower_border_, upper_border_;  // ascending in x
  PlanePoint min_{}, max_{};
  double cells_per_x_ = 0, cells_per_y_ = 0;
  std::vector<std::int32_t> start_grid_;  // a triangle at or near each cell's middle
};

}  // namespace rheocyte
