#include <algorithm>
#include <cmath>

#include "duct/observe_duct.h"
#include "fem/element_quadrature.h"
#include "laws/weak_form.h"

namespace rheocyte {

/// As in the tube: the polynomials that fit 2 D:D best at the quadrature points are looked at up to the faces.
double max_shear_rate(const DuctSpace& space, const TensorElement& element, const VectorXd& unknowns) {
  using Fields = LiquidFields<double, 3>;
  const ReferenceElement<3>& reference = space.reference();
  const VectorXd grid = VectorXd::LinSpaced(2 * reference.degree() + 1, 0, 1);
  const MatrixXd nodes_to_grid = reference.lagrange(grid), points_to_grid = nodes_to_grid * reference.points_to_nodes();
  const Contour contour = duct_contour(space, unknowns, Camera::side);
  const double front = contour.pieces.front()(0, 0), rear = contour.pieces.back()(contour.pieces.back().rows() - 1, 0);
  double greatest = 0;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const HexahedronUnknowns& self = space.elements()[e];
    if (!self.liquid || !self.moves) continue;
    VectorXd x = values_of(self.displacement, unknowns).head(reference.nodes());
    for (int k = 0; k < x.size(); ++k) x(k) += space.node_points()[space.nodes().of_element[e][k]](0);
    const MatrixXd numbers = numbers_at_points<Fields>(space, element, e, unknowns);
    VectorXd squares(reference.points());
    for (int q = 0; q < squares.size(); ++q) {
      const auto f = fields_at<Fields>(numbers, q);
      const Tensor<double> L = gradient(PointMap<double, 3>(f.map), f.w, f.w_xi);
      squares(q) = 0.5 * (L + L.transpose()).squaredNorm();
    }
    const Eigen::ArrayXXd place = apply_in_each_direction(nodes_to_grid, x),
                          rate = apply_in_each_direction(points_to_grid, squares);
    greatest = std::max(greatest, (place >= rear && place <= front).select(rate, 0).maxCoeff());
  }
  return std::sqrt(greatest);
}

}  // namespace rheocyte
