#include "duct/moving_duct_system.h"

#include <Eigen/LU>
#include <array>
#include <cassert>

#include "duct/duct_surface.h"
#include "fem/element_quadrature.h"

namespace rheocyte {
namespace {

using Components6 = Eigen::Matrix<double, 6, 1>;

/// The numbers of a symmetric tensor.
Components6 components(const Tensor<double>& A) {
  Components6 a;
  a << A(0, 0), A(0, 1), A(0, 2), A(1, 1), A(1, 2), A(2, 2);
  return a;
}

Tensor<double> from_components(const Components6& a) { return {a(0), a(1), a(2), a(1), a(3), a(4), a(2), a(4), a(5)}; }

}  // namespace

MovingDuctSystem::MovingDuctSystem(const DuctSpace& space, double drop, bool bends)
    : DuctSystem(space, drop, bends), elements_(space.elements()) {
  assert(space.inner_pressure() < 0);
  set_motion({0, VectorXd::Zero(space.unknowns()), {}});
}

void MovingDuctSystem::set_motion(const Motion& motion) {
  motion_ = motion;
  if (motion.outward.size() > 0) renew_end_loads();
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (elements_[e].liquid) {
      if (motion.outward.size() > 0) elements_[e].undeformed = space().elements()[e].undeformed;
      move_surface(e);
    } else {
      set_history(e);
    }
  }
  if (space().turns()) set_motion_of_surface(motion);
  if (motion_.branch.size() > 0) set_branch_history();
}

/// The liquid's velocity on the surface is the rate of the displacement; elsewhere, and on a surface that turns, it is
/// as the space has it.
void MovingDuctSystem::move_surface(int e) {
  HexahedronUnknowns& self = elements_[e];
  self.velocity = space().elements()[e].velocity;
  if (space().turns()) return;
  const auto& nodes = space().nodes().of_element[e];
  const int n = space().reference().nodes();
  for (int i = 0; i < 3 * n; ++i) {
    const int unknown = space().displacement(nodes[i % n], i / n);
    if (unknown >= 0) self.velocity[i] = {unknown, motion_.rate, motion_.unknowns(unknown)};
  }
}

Eigen::MatrixX3d MovingDuctSystem::places_in_ball(int e) const {
  const DuctPoint centre(0, space().mesh().geometry().shape().offset, 0);
  const auto& nodes = space().nodes().of_element[e];
  Eigen::MatrixX3d places(nodes.size(), 3);
  for (int i = 0; i < places.rows(); ++i) places.row(i) = (space().node_points()[nodes[i]] - centre).transpose();
  return places;
}

/// Along the rotation of the undeformed ball.
Eigen::MatrixX3d MovingDuctSystem::turning_velocity(int e) const {
  const int n = space().reference().degree() + 1, all = n * n * n;
  const MatrixXd slopes_1d = space().reference().lagrange_derivative(space().reference().nodes_1d);
  const Eigen::MatrixX3d X = places_in_ball(e);
  const auto& nodes = space().nodes().of_element[e];
  Eigen::MatrixX3d x(all, 3), velocity(all, 3);
  for (int i = 0; i < all; ++i) x.row(i) = duct_point(space(), motion_.turning, nodes[i]).transpose();
  for (int i = 0; i < all; ++i) {
    Eigen::Matrix3d rest = Eigen::Matrix3d::Zero(), now = Eigen::Matrix3d::Zero();  // by the element's coordinates
    for (int k = 0, stride = 1; k < 3; ++k, stride *= n) {
      const int place = i / stride % n, first = i - place * stride;
      for (int j = 0; j < n; ++j) {
        rest.col(k) += slopes_1d(place, j) * X.row(first + j * stride).transpose();
        now.col(k) += slopes_1d(place, j) * x.row(first + j * stride).transpose();
      }
    }
    velocity.row(i) = (now * rest.inverse() * DuctPoint(-X(i, 1), X(i, 0), 0)).transpose();
  }
  return velocity;
}

void MovingDuctSystem::set_history(int e) {
  HexahedronUnknowns& self = elements_[e];
  const int n = space().reference().nodes();
  MatrixXd displacement(n, 3);
  for (int i = 0; i < 3 * n; ++i) {
    const int unknown = self.displacement[i].unknown;
    displacement(i % n, i / n) = unknown < 0 ? 0 : motion_.unknowns(unknown);
  }
  self.rate = motion_.rate;
  self.history.assign(space().reference().points(), {});
  self.spin = motion_.turning.size() > 0 ? space().spin() : -1;
  for (int k = 0; k < 3; ++k) {
    const MatrixXd slopes = element().at_points(k + 1, displacement);
    // The form knows the place, not the displacement.
    for (int q = 0; q < slopes.rows(); ++q)
      for (int c = 0; c < 3; ++c)
        self.history[q].velocity_slope(c, k) = slopes(q, c) - motion_.rate * self.undeformed[q].G(c, k);
  }
  if (self.spin < 0) return;
  const MatrixXd turning = turning_velocity(e);
  for (int k = 0; k < 3; ++k) {
    const MatrixXd slopes = element().at_points(k + 1, turning);
    for (int q = 0; q < slopes.rows(); ++q)
      for (int c = 0; c < 3; ++c) self.history[q].turning(c, k) = slopes(q, c);
  }
}

void MovingDuctSystem::set_branch_history() {
  Eigen::Index i = 0;
  for (HexahedronUnknowns& self : elements_) {
    for (CellHistory<3>& history : self.history) {
      history.branch = from_components(motion_.branch.segment<6>(i));
      i += 6;
    }
  }
  if (motion_.turning_branch.size() > 0) turn_branch(motion_.turning_branch);
}

// The mean of the polynomials of the elements that share a node: what one of them has at its border comes from its
// neighbour, out of which the material turns.
MatrixXd MovingDuctSystem::branch_at_nodes(const VectorXd& metric) const {
  const MatrixXd to_nodes = space().reference().points_to_nodes();
  const Eigen::Index points = space().reference().points();
  MatrixXd sum = MatrixXd::Zero(space().nodes().count, 6);
  VectorXd elements = VectorXd::Zero(sum.rows());
  Eigen::Index i = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (elements_[e].liquid) continue;
    const MatrixXd nodal =
        apply_in_each_direction(to_nodes, metric.segment(i, 6 * points).reshaped(6, points).transpose());
    i += 6 * points;
    const auto& nodes = space().nodes().of_element[e];
    for (Eigen::Index k = 0; k < nodal.rows(); ++k) {
      sum.row(nodes[std::size_t(k)]) += nodal.row(k);
      ++elements(nodes[std::size_t(k)]);
    }
  }
  return elements.cwiseMax(1).cwiseInverse().asDiagonal() * sum;
}

void MovingDuctSystem::turn_branch(const VectorXd& metric) {
  const Tensor<double> spin_1{0, -1, 0, 1, 0, 0, 0, 0, 0};
  const MatrixXd at_nodes = branch_at_nodes(metric);
  Eigen::Index i = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    HexahedronUnknowns& self = elements_[e];
    if (self.liquid) continue;
    const MatrixXd nodal = at_nodes(space().nodes().of_element[e], Eigen::all);
    const MatrixXd X = element().at_points(0, places_in_ball(int(e)));
    const std::array slopes{element().at_points(1, nodal), element().at_points(2, nodal),
                            element().at_points(3, nodal)};
    for (std::size_t q = 0; q < self.history.size(); ++q, i += 6) {
      const auto point = Eigen::Index(q);
      const DuctPoint passing = self.undeformed[q].inverse.eigen() * DuctPoint(-X(point, 1), X(point, 0), 0);
      Components6 carried = Components6::Zero();
      for (int k = 0; k < 3; ++k) carried += passing(k) * slopes[std::size_t(k)].row(point).transpose();
      const Tensor<double> G = from_components(metric.segment<6>(i));
      self.history[q].branch_turning = from_components(carried) - (spin_1 * G - G * spin_1);
    }
  }
}

VectorXd MovingDuctSystem::branch_metric(const Bulk& bulk, const VectorXd& unknowns) const {
  VectorXd metric(unstressed_branch().size());
  Eigen::Index i = 0;
  for (int e = 0; e < int(elements_.size()); ++e) {
    const HexahedronUnknowns& self = elements_[e];
    if (self.liquid) continue;
    const double spin = self.spin < 0 ? 0 : unknowns(self.spin);
    const MatrixXd numbers = numbers_at_points<MapFields<double, 3>>(space(), element(), e, unknowns);
    for (int q = 0; q < numbers.rows(); ++q) {
      const PointMap<double, 3> map(fields_at<MapFields<double, 3>>(numbers, q));
      const Tensor<double> F = deformation_gradient(map, self.undeformed[q]);
      const Tensor<double> inverse_C = inverse(Tensor<double>(F.transpose() * F));
      const Tensor<double> history = self.history[q].at_spin(spin).branch;
      metric.segment<6>(i) = components(rheocyte::branch_metric(bulk, inverse_C, motion_.rate, history));
      i += 6;
    }
  }
  return metric;
}

VectorXd MovingDuctSystem::unstressed_branch() const {
  Eigen::Index points = 0;
  for (const HexahedronUnknowns& self : elements_) points += Eigen::Index(self.history.size());
  return components(Tensor<double>::Identity()).replicate(points, 1);
}

}  // namespace rheocyte
