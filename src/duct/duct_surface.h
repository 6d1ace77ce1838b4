// The cell's surface in a duct: polynomial faces, and what one reads off them at any place.
#pragma once
#include "duct/duct_space.h"

namespace rheocyte {

/// The last layer of nodes of an element of the ring, first coordinate fastest; its normal s x t points outward.
struct SurfaceFace {
  int element;
  std::vector<int> nodes;
};
std::vector<SurfaceFace> surface_faces(const DuctSpace&);

/// A point of the surface by the coordinates in [0, 1] of its face.
struct SurfacePlace {
  int face = 0;
  double s = 0, t = 0;
};

/// A place's position and its derivatives with respect to the coordinates of the face.
struct SurfaceJet {
  DuctPoint x, s, t, ss, st, tt;

  DuctPoint normal() const { return DuctPoint(s.cross(t)).normalized(); }
  double area() const { return s.cross(t).norm(); }
};

/// The sphere as the spheroid that a cell rests in (docs/theory.md, eq:rest-shape).
inline DuctPoint at_rest(const DuctPoint& undeformed, double rest_stretch) {
  const double across = 1 / std::sqrt(rest_stretch);
  return {rest_stretch * undeformed(0), across * undeformed(1), across * undeformed(2)};
}

/// The surface of one state, and the undeformed one. The space must outlive it.
class DuctSurfaceMap {
 public:
  DuctSurfaceMap(const DuctSpace&, const VectorXd& unknowns);

  const DuctSpace& space() const { return space_; }
  const std::vector<SurfaceFace>& faces() const { return faces_; }
  SurfaceJet now(const SurfacePlace& at) const { return jet(now_[at.face], at); }
  SurfaceJet rest(const SurfacePlace& at) const { return jet(rest_[at.face], at); }
  /// The point of the sphere itself, which the polynomials of `rest` meet in their nodes alone, moved by the
  /// displacement of `now`. So an undeformed cell is round to rounding.
  DuctPoint point(const SurfacePlace&) const;

 private:
  using Nodes = std::array<MatrixXd, 3>;  ///< x, y, z by node along s and t
  SurfaceJet jet(const Nodes&, const SurfacePlace&) const;

  const DuctSpace& space_;
  std::vector<SurfaceFace> faces_;
  std::vector<Nodes> now_, rest_;
  MatrixXd slopes_at_nodes_;
};

/// Current point of a node of the cell.
DuctPoint duct_point(const DuctSpace&, const VectorXd& unknowns, int node);

}  // namespace rheocyte
