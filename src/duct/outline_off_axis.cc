#include "duct/outline_off_axis.h"

#include <cmath>

#include "duct/farthest_place.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

constexpr double direction_step = std::numbers::pi / off_axis_pieces;

/// Points that lie farthest in so many directions in the image plane of x and `across`, from the front on.
std::vector<Eigen::Vector2d> farthest_points(const DuctSurfaceMap& surface, const DuctPoint& across, int directions) {
  const FarthestPlace farthest(surface);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < directions; ++i) {
    const DuctPoint x = surface.point(farthest(outline_direction(across, i * direction_step)));
    points.emplace_back(x(0), across.dot(x));
  }
  return points;
}

/// A parabola from one point to the next, which lie farthest in the direction `angle` and a step before: its tangents
/// are at right angles to them. Straight where the way does not lie between the tangents: beside an edge of the
/// surface, whose places are known along it to some 1e-6 only.
CurvePiece parabola(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double angle) {
  const auto direction = [](double a) { return Eigen::Vector2d(std::cos(a), std::sin(a)); };
  const auto tangent = [](double a) { return Eigen::Vector2d(-std::sin(a), std::cos(a)); };
  const Eigen::Vector2d way = to - from;
  const double before = angle - direction_step, forth = way.dot(direction(angle)) / std::sin(direction_step),
               back = -way.dot(direction(before)) / std::sin(direction_step);
  Eigen::Vector2d corner = (from + to) / 2;
  if (forth >= 0 && back >= 0) corner = from + forth * tangent(before);
  CurvePiece piece(3, 2);
  piece << from.transpose(), (from + 2 * corner + to).transpose() / 4, to.transpose();
  return piece;
}

/// Their outline. Where faces of the surface meet in an edge, however blunt, neighbouring directions have the same
/// place, and nothing lies between them.
std::vector<CurvePiece> outline_of(const std::vector<Eigen::Vector2d>& points) {
  std::vector<CurvePiece> outline;
  Eigen::Vector2d from = points.front();
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - from).norm() < same_place) continue;
    outline.push_back(parabola(from, points[i], double(i) * direction_step));
    from = points[i];
  }
  return outline;
}

}  // namespace

Contour off_axis_contour(const DuctSurfaceMap& surface, const DuctPoint& across) {
  std::vector<Eigen::Vector2d> points = farthest_points(surface, across, off_axis_pieces + 1);
  points.front()(1) = points.back()(1) = 0;
  return {outline_of(points)};
}

Eigen::MatrixX2d duct_offset_outline(const DuctSpace& space, const VectorXd& unknowns) {
  const DuctSurfaceMap surface(space, unknowns);
  const std::vector<CurvePiece> pieces =
      outline_of(farthest_points(surface, DuctPoint::UnitY(), 2 * off_axis_pieces + 1));
  constexpr int corners_per_piece = 8;
  const VectorXd along = VectorXd::LinSpaced(corners_per_piece, 0, 1 - 1.0 / corners_per_piece);
  Eigen::MatrixX2d outline(Eigen::Index(pieces.size()) * corners_per_piece, 2);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    outline.middleRows(Eigen::Index(i) * corners_per_piece, corners_per_piece) = evaluate(pieces[i], along);
  return outline;
}

}  // namespace rheocyte
