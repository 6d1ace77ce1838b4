// The mesh of cell and duct, or of one part of them by symmetry: hexahedra that subdivide the parts of the geometry.
#pragma once
#include <array>
#include <vector>

#include "duct/duct_geometry.h"
#include "fem/node_numbers.h"

namespace rheocyte {

/// How finely a wedge is divided. Across the flow its faces in front and rear are triangles of three quadrilaterals.
struct DuctSubdivision {
  int along = 3;   ///< elements along the side of the cell
  int layers = 0;  ///< of liquid from the surface to the box, each twice as high as the one below; 0: duct_layers_for()
  int ring = 1;    ///< layers of the cell round its core; of two the outer one is thin
  int axial = 2;   ///< elements from the box to each end
  double growth = 1;  ///< by which elements along the side are longer in front than in the rear, if they were many
  int across = 0;     ///< of the half: its faces across the flow are grids of across x across / 2; 0: triangles
  bool operator==(const DuctSubdivision&) const = default;
};

/// Heights on the cube's side, from -1 in the rear to 1, between which its elements lie round an undeformed cell.
std::vector<double> side_breaks(const DuctSubdivision&);

/// As many layers as make the first one half as high as the surface's elements are wide (docs/theory.md, sec. mesh).
int duct_layers_for(const DuctGeometry&, const DuctSubdivision&);

/// Face of the cube that a block's outward direction crosses, in the wedge: X = 1, Y = 1, X = -1.
enum class Face { front, side, rear };

/// Points of the wedge's faces by two coordinates: (Y, Z) in front and rear, (Z, X) on the side.
using FacePoint = Eigen::Vector2d;

/// One hexahedron. The first two element coordinates run over a quadrilateral of the face, the third outward (along the
/// flow in the core).
struct DuctElement {
  Part part;
  Face face;
  Image image;                       ///< of the wedge
  std::array<FacePoint, 4> corners;  ///< at (0,0), (1,0), (0,1), (1,1)
  std::array<double, 2> outward;
  int foot = -1;  ///< in the layers: the element between the same spokes that touches the cell

  bool in_cell() const { return part == Part::core || part == Part::ring; }
  /// The element coordinate along which it lies between two of the side's breaks, -1 if there is none, and these.
  int direction_along() const;
  std::array<double, 2> along() const;
  double outward_at(double xi3) const { return outward[0] + xi3 * (outward[1] - outward[0]); }
  /// The cube's point of element coordinates in [0, 1]^3, outside the core on its surface.
  DuctPoint on_cube(double xi1, double xi2, double xi3) const;
};

struct CubeFace;

class DuctMesh {
 public:
  DuctMesh(const DuctGeometry& geometry, const DuctSubdivision& subdivision)
      : DuctMesh(geometry, subdivision, symmetry_of(geometry.section())) {}
  DuctMesh(const DuctGeometry& geometry, const DuctSubdivision& subdivision, Symmetry symmetry)
      : DuctMesh(geometry, subdivision, symmetry, rheocyte::side_breaks(subdivision)) {}
  DuctMesh(const DuctGeometry&, const DuctSubdivision&, Symmetry, std::vector<double> side_breaks);

  const DuctGeometry& geometry() const { return geometry_; }
  Symmetry symmetry() const { return symmetry_; }
  const DuctSubdivision& subdivision() const { return subdivision_; }
  const std::vector<double>& side_breaks() const { return side_breaks_; }
  /// Between the pieces of a silhouette, both poles included: the front from 0 to 1, the side to 3, the rear to 4.
  std::vector<double> surface_places() const;
  const std::vector<DuctElement>& elements() const { return elements_; }
  /// Point of the undeformed mesh for element coordinates in [0, 1]^3.
  DuctPoint point(int element, const Eigen::Vector3d& xi) const;
  /// Of an element, for all products of coordinates, the first direction fastest; in rows.
  Eigen::MatrixX3d points(int element, const Eigen::VectorXd& xi) const;
  /// Of the Gauss-Lobatto nodes of continuous elements of one degree.
  NodeNumbers number_nodes(int degree) const;

 private:
  void add(Part, const CubeFace&, const std::vector<double>& outward);

  DuctGeometry geometry_;
  DuctSubdivision subdivision_;
  Symmetry symmetry_;
  std::vector<double> side_breaks_;
  std::vector<DuctElement> elements_;
};

/// Elements at the duct's end, whose first two coordinates run over its cross-section.
std::vector<DuctElement> section_elements(Symmetry, int across);

}  // namespace rheocyte
