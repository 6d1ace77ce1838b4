#include "duct/cell_moments.h"

#include <Eigen/LU>

#include "duct/duct_surface.h"

namespace rheocyte {

CellMoments cell_moments(const DuctSpace& space, const TensorElement& element, const VectorXd& unknowns) {
  CellMoments sum;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.elements()[e].liquid) continue;
    const MatrixXd G = numbers_at_points<MapFields<double, 3>>(space, element, e, unknowns);
    const MatrixXd at = element.at_points(0, points_of_nodes(space, e, unknowns));
    for (int q = 0; q < G.rows(); ++q) {
      const Eigen::Map<const Eigen::Matrix3d, 0, Eigen::InnerStride<>> map(&G(q, 0), Eigen::InnerStride<>(G.rows()));
      const double volume = space.reference().weights(q) * map.determinant();
      sum.volume += volume;
      sum.barycentre += volume * at.row(q).transpose();
      sum.second += volume * at.row(q).transpose() * at.row(q);
    }
  }
  // The other half is the mirror image: what is odd in z cancels.
  sum.barycentre(2) = 0;
  for (int c = 0; c < 2; ++c) sum.second(c, 2) = sum.second(2, c) = 0;
  sum.barycentre /= sum.volume;
  sum.second = sum.second / sum.volume - sum.barycentre * sum.barycentre.transpose();
  sum.volume *= double(copies_of(space.mesh().symmetry()).size());
  return sum;
}

}  // namespace rheocyte
