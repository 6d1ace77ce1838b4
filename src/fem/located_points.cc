#include "fem/located_points.h"

#include <Eigen/LU>
#include <limits>
#include <utility>

namespace rheocyte {
namespace {

/// Curved elements reach beyond their nodes, by at most so much of their extent.
constexpr double beyond_nodes = 0.05;
constexpr int max_iterations = 20;
/// Relative to the extent of the element.
constexpr double same_place = 1e-12, inside = 1e-8;

/// Values of the functions at a point (column 0), and their derivatives.
template <int dim>
Eigen::Matrix<double, Eigen::Dynamic, dim + 1> functions_at(const ReferenceElement<dim>& reference,
                                                            const Eigen::Matrix<double, dim, 1>& xi) {
  const MatrixXd value = reference.lagrange(xi), slope = reference.lagrange_derivative(xi);
  const Eigen::Index n = value.cols();
  Eigen::Matrix<double, Eigen::Dynamic, dim + 1> functions(reference.nodes(), dim + 1);
  for (int part = 0; part <= dim; ++part) {
    for (Eigen::Index k = 0; k < functions.rows(); ++k) {
      double product = 1;
      for (Eigen::Index c = 0, rest = k; c < dim; ++c, rest /= n)
        product *= (part == c + 1 ? slope : value)(c, rest % n);
      functions(k, part) = product;
    }
  }
  return functions;
}

}  // namespace

template <int dim>
LocatedPoints<dim>::LocatedPoints(const ReferenceElement<dim>& reference, std::vector<MatrixXd> elements)
    : reference_(reference), elements_(std::move(elements)) {
  for (const MatrixXd& nodes : elements_) {
    auto& box = boxes_.emplace_back();
    for (const auto& node : nodes.rowwise()) box.extend(Point(node.transpose()));
    const Point margin = Point::Constant(beyond_nodes * box.diagonal().norm());
    box.min() -= margin;
    box.max() += margin;
  }
}

/// Newton's method from the middle; steps are cut where they would leave the element.
template <int dim>
LocatedPoints<dim>::Found LocatedPoints<dim>::find_in(int element, const Point& point) const {
  const MatrixXd& nodes = elements_[std::size_t(element)];
  const double extent = boxes_[std::size_t(element)].diagonal().norm();
  Found found{{element, Point::Constant(0.5)}, 0};
  Point& xi = found.place.xi;
  for (int i = 0;; ++i) {
    const auto functions = functions_at(reference_, xi);
    const Eigen::Matrix<double, dim, dim + 1> map = nodes.transpose() * functions;
    const Point off = point - map.col(0);
    found.distance = off.norm();
    if (found.distance < same_place * extent || i == max_iterations) return found;
    const Point next = (xi + map.template rightCols<dim>().fullPivLu().solve(off)).cwiseMax(0).cwiseMin(1);
    if ((next - xi).norm() < same_place) return found;
    xi = next;
  }
}

template <int dim>
LocatedPoints<dim>::Place LocatedPoints<dim>::find(const Point& point) const {
  Found nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  const auto look = [&](bool in_box) {
    for (int e = 0; e < int(elements_.size()); ++e) {
      if (boxes_[std::size_t(e)].contains(point) != in_box) continue;
      const Found here = find_in(e, point);
      if (here.distance < nearest.distance) nearest = here;
      if (nearest.distance < inside * boxes_[std::size_t(e)].diagonal().norm()) return;
    }
  };
  look(true);
  if (std::isinf(nearest.distance)) look(false);
  return nearest.place;
}

template class LocatedPoints<2>;
template class LocatedPoints<3>;

}  // namespace rheocyte
