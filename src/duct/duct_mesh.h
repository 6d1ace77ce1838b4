// The mesh of one eighth of cell and duct: hexahedra that subdivide the parts of the geometry.
#pragma once
#include <array>
#include <vector>

#include "duct/duct_geometry.h"
#include "fem/node_numbers.h"

namespace rheocyte {

/// How finely the eighth is divided. Across the flow each face in front and rear is a triangle of three quadrilaterals.
struct DuctSubdivision {
  int along = 3;   ///< elements along the side of the cell
  int layers = 0;  ///< of liquid from the surface to the box, each twice as high as the one below; 0: duct_layers_for()
  int axial = 2;   ///< elements from the box to each end
  bool operator==(const DuctSubdivision&) const = default;
};

/// As many layers as make the first one half as high as the surface's elements are wide (docs/theory.md, sec. mesh).
int duct_layers_for(const DuctGeometry&, const DuctSubdivision&);

/// One hexahedron. The first two element coordinates run over a quadrilateral of the face, the third outward (along the
/// flow in the core).
struct DuctElement {
  Part part;
  Face face;
  std::array<FacePoint, 4> corners;  ///< at (0,0), (1,0), (0,1), (1,1)
  std::array<double, 2> outward;
  int foot = -1;  ///< in the layers: the element between the same spokes that touches the cell

  bool in_cell() const { return part == Part::core || part == Part::ring; }
  /// Coordinates on the face, and outward, of element coordinates in [0, 1]^3.
  FacePoint on_face(double xi1, double xi2) const;
  double outward_at(double xi3) const { return outward[0] + xi3 * (outward[1] - outward[0]); }
};

class DuctMesh {
 public:
  DuctMesh(const DuctGeometry&, const DuctSubdivision&);

  const DuctGeometry& geometry() const { return geometry_; }
  const DuctSubdivision& subdivision() const { return subdivision_; }
  const std::vector<DuctElement>& elements() const { return elements_; }
  /// Point of the undeformed mesh for element coordinates in [0, 1]^3.
  DuctPoint point(int element, const Eigen::Vector3d& xi) const;
  /// Of the Gauss-Lobatto nodes of continuous elements of one degree.
  NodeNumbers number_nodes(int degree) const;

 private:
  void add(Part, Face, const std::vector<std::array<FacePoint, 4>>& quadrilaterals, const std::vector<double>& outward);

  DuctGeometry geometry_;
  DuctSubdivision subdivision_;
  std::vector<DuctElement> elements_;
};

/// Quadrilaterals of the triangle 0 <= Z <= Y <= 1, corners as those of an element, counterclockwise in (Y, Z).
std::vector<std::array<FacePoint, 4>> triangle_quadrilaterals();

}  // namespace rheocyte
