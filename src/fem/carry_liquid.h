// The liquid's fields from one mesh to another round the same cell: at the same places in space.
#pragma once
#include <utility>
#include <vector>

#include "fem/located_points.h"

namespace rheocyte {

/// Velocities and pressures of the liquid at any place. `Space` is that of a tube or of a duct.
template <class Space>
class LiquidInSpace {
 public:
  static constexpr int dim = Space::dim;
  using Place = typename LocatedPoints<dim>::Place;

  /// Both must outlive this object.
  LiquidInSpace(const Space& space, const VectorXd& unknowns)
      : space_(space), unknowns_(unknowns), points_(space.reference(), elements_of_liquid()) {}

  Place find(const Eigen::Matrix<double, dim, 1>& x) const { return points_.find(x); }
  double velocity(const Place& place, int component) const {
    const auto& nodes = space_.nodes().of_element[numbers_[std::size_t(place.element)]];
    VectorXd values(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      values(Eigen::Index(i)) = space_.velocity(nodes[i], component).value(unknowns_);
    return space_.reference().interpolate(values, place.xi);
  }
  double pressure(const Place& place) const {
    const VectorXd modes = space_.reference().pressure_modes(place.xi);
    double sum = 0;
    for (int k = 0; k < modes.size(); ++k)
      sum += modes(k) * unknowns_(space_.pressure(numbers_[std::size_t(place.element)], k));
    return sum;
  }

 private:
  std::vector<MatrixXd> elements_of_liquid() {
    std::vector<MatrixXd> places;
    for (int e = 0; e < int(space_.elements().size()); ++e) {
      if (!space_.elements()[e].liquid) continue;
      numbers_.push_back(e);
      places.push_back(points_of_nodes(space_, e, unknowns_));
    }
    return places;
  }

  const Space& space_;
  const VectorXd& unknowns_;
  std::vector<int> numbers_;  ///< of the liquid's elements
  LocatedPoints<dim> points_;
};

/// Sets them in the unknowns of a space in which the cell has the same shape.
template <class Space>
void carry_liquid(const Space& from, const VectorXd& of_from, const Space& to, VectorXd& unknowns) {
  const LiquidInSpace<Space> liquid(from, of_from);
  const auto& reference = to.reference();
  for (int e = 0; e < int(to.elements().size()); ++e) {
    if (!to.elements()[e].liquid) continue;
    const MatrixXd nodes = points_of_nodes(to, e, unknowns), points = reference.shape.value * nodes;
    for (int k = 0; k < int(nodes.rows()); ++k) {
      const auto place = liquid.find(nodes.row(k).transpose());
      for (int c = 0; c < Space::dim; ++c) {
        const int unknown = to.velocity(to.nodes().of_element[e][k], c).unknown;
        if (unknown >= 0 && !to.is_motion(unknown)) unknowns(unknown) = liquid.velocity(place, c);
      }
    }
    VectorXd pressures(points.rows());
    for (int q = 0; q < int(points.rows()); ++q) pressures(q) = liquid.pressure(liquid.find(points.row(q).transpose()));
    // The modes are orthonormal: projection is a product.
    const VectorXd modes = reference.pressure.value.transpose() * reference.weights.cwiseProduct(pressures);
    for (int k = 0; k < modes.size(); ++k) unknowns(to.pressure(e, k)) = modes(k);
  }
}

}  // namespace rheocyte
