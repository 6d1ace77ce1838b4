// Which element of a mesh contains a point, and where.
#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "fem/reference_element.h"

namespace rheocyte {

/// Elements by the places of their nodes, which may be curved; the mesh must not be folded.
template <int dim>
class LocatedPoints {
 public:
  using Point = Eigen::Matrix<double, dim, 1>;
  struct Place {
    int element = 0;  ///< as it was given
    Point xi;         ///< in it, within [0, 1]
  };

  /// `reference` must outlive this object; each element is given by its nodes, nodes x dim.
  LocatedPoints(const ReferenceElement<dim>& reference, std::vector<MatrixXd> elements);

  /// The place of a point; of one that lies just outside all elements (two curved boundaries differ a little), the
  /// nearest one.
  Place find(const Point&) const;

 private:
  struct Found {
    Place place;
    double distance = 0;  ///< of the point from that place
  };
  Found find_in(int element, const Point&) const;

  const ReferenceElement<dim>& reference_;
  std::vector<MatrixXd> elements_;
  std::vector<Eigen::AlignedBox<double, dim>> boxes_;
};

}  // namespace rheocyte
