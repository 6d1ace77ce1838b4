#include "fem/surface_integrals.h"

#include <cmath>

namespace rheocyte {
namespace {

/// Of the interior penalty, times degree^2: four times what an inverse inequality asks on equal edges.
constexpr double penalty_factor = 4;

/// Values, slopes and second slopes of the nodes' functions at points in [0, 1].
struct EdgeTable {
  MatrixXd value, slope, second;
  EdgeTable(const ReferenceElement& reference, const VectorXd& at)
      : value(reference.lagrange(at)),
        slope(reference.lagrange_derivative(at)),
        second(slope * reference.lagrange_derivative(reference.nodes_1d)) {}
};

/// Dual numbers of local inputs.
template <int N>
std::array<ceres::Jet<double, N>, N> dual(const Eigen::Matrix<double, N, 1>& f) {
  std::array<ceres::Jet<double, N>, N> result;
  for (int i = 0; i < N; ++i) result[i] = ceres::Jet<double, N>(f(i), i);
  return result;
}

template <int N>
std::array<double, N> plain(const Eigen::Matrix<double, N, 1>& f) {
  std::array<double, N> result;
  for (int i = 0; i < N; ++i) result[i] = f(i);
  return result;
}

void append_nodes(const Discretisation& space, const BoundaryEdge& edge, SurfacePatch& patch) {
  const int n = int(edge.nodes.size()), first = int(patch.rest.size());
  patch.rest.conservativeResize(first + 2 * n);
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < n; ++k) {
      patch.unknowns.push_back(space.displacement(edge.nodes[k], c));
      patch.rest(first + c * n + k) = space.node_points()[edge.nodes[k]](c);
    }
  }
}

}  // namespace

SurfaceIntegrals::SurfaceIntegrals(const Discretisation& space) : space_(&space) {
  const auto& edges = space.surface();
  for (const BoundaryEdge& edge : edges) {
    SurfacePatch& patch = patches_.emplace_back();
    append_nodes(space, edge, patch);
    patch.unknowns.push_back(space.inner_pressure());
    patch.unknowns.push_back(space.cell_velocity());
    patch.rest.conservativeResize(patch.rest.size() + 2);
    patch.rest.tail(2).setZero();
  }
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    SurfacePatch& patch = patches_.emplace_back();
    append_nodes(space, edges[e], patch);
    append_nodes(space, edges[e + 1], patch);
  }
  tabulate();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    auto& reference = references_.emplace_back();
    for (const Table& table : edge_) {
      const VectorXd f = table.inputs * patches_[e].rest;
      reference.push_back({std::hypot(f(2), f(3)), f(1), -0.5 * f(1) * f(1) * f(2)});
    }
  }
}

void SurfaceIntegrals::tabulate() {
  const ReferenceElement& reference = space_->reference();
  const int n = reference.degree() + 1;
  const EdgeTable at_points(reference, reference.points_1d);
  for (int q = 0; q < reference.points_1d.size(); ++q) {
    const auto value = at_points.value.row(q), slope = at_points.slope.row(q), second = at_points.second.row(q);
    Table& table = edge_.emplace_back();
    table.inputs.setZero(SurfacePoint::inputs, 2 * n + 2);
    table.tests.setZero(SurfacePoint::outputs, 2 * n + 2);
    for (int c = 0; c < 2; ++c) {
      table.inputs.row(c).segment(c * n, n) = value;
      table.inputs.row(2 + c).segment(c * n, n) = slope;
      table.inputs.row(4 + c).segment(c * n, n) = second;
      table.tests.row(3 * c).segment(c * n, n) = value;
      table.tests.row(3 * c + 1).segment(c * n, n) = slope;
      table.tests.row(3 * c + 2).segment(c * n, n) = second;
    }
    table.inputs(6, 2 * n) = table.tests(6, 2 * n) = 1;
    table.tests(7, 2 * n + 1) = 1;
  }
  const EdgeTable at_ends(reference, Eigen::Vector2d(0, 1));
  kink_.setZero(SurfaceKink::inputs, 4 * n);
  for (int side = 0; side < 2; ++side) {
    for (int c = 0; c < 2; ++c) {
      kink_.row(4 * side + c).segment((2 * side + c) * n, n) = at_ends.slope.row(1 - side);
      kink_.row(4 * side + 2 + c).segment((2 * side + c) * n, n) = at_ends.second.row(1 - side);
    }
  }
  kink_.row(8).segment(3 * n, n) = at_ends.value.row(0);
}

void SurfaceIntegrals::integrate(int index, const Cortex& cortex, const VectorXd& unknowns, Want want,
                                 ElementSystem& system) const {
  const SurfacePatch& patch = patches_[index];
  VectorXd local = patch.rest;
  for (int i = 0; i < local.size(); ++i) {
    if (patch.unknowns[i] >= 0 && patch.unknowns[i] != space_->cell_velocity()) local(i) += unknowns(patch.unknowns[i]);
  }
  system.residual.setZero(local.size());
  if (want == Want::residual_and_tangent) system.tangent.setZero(local.size(), local.size());
  if (index < int(space_->surface().size())) {
    integrate_edge(index, cortex, local, want, system);
  } else {
    integrate_kink(cortex, local, want, system);
  }
}

int SurfaceIntegrals::active(const Cortex& cortex) const {
  return int(cortex.bending != 0 ? patches_.size() : space_->surface().size());
}

void SurfaceIntegrals::integrate_edge(int edge, const Cortex& cortex, const VectorXd& local, Want want,
                                      ElementSystem& system) const {
  constexpr int inputs = SurfacePoint::inputs, outputs = SurfacePoint::outputs;
  const double rest_pressure = 2 * cortex.tension / space_->mesh().geometry().radius();
  for (std::size_t q = 0; q < edge_.size(); ++q) {
    const SurfacePoint form{cortex, rest_pressure, references_[edge][q]};
    const double weight = space_->reference().weights_1d(int(q));
    const Eigen::Matrix<double, inputs, 1> f = edge_[q].inputs * local;
    Eigen::Matrix<double, outputs, 1> flux;
    if (want == Want::residual) {
      const auto value = form(plain<inputs>(f));
      for (int k = 0; k < outputs; ++k) flux(k) = weight * value[k];
    } else {
      const auto value = form(dual<inputs>(f));
      Eigen::Matrix<double, outputs, inputs> slope;
      for (int k = 0; k < outputs; ++k) {
        flux(k) = weight * value[k].a;
        slope.row(k) = weight * value[k].v.transpose();
      }
      system.tangent.noalias() += edge_[q].tests.transpose() * (slope * edge_[q].inputs);
    }
    system.residual.noalias() += edge_[q].tests.transpose() * flux;
  }
}

void SurfaceIntegrals::integrate_kink(const Cortex& cortex, const VectorXd& local, Want want,
                                      ElementSystem& system) const {
  constexpr int inputs = SurfaceKink::inputs;
  const int degree = space_->reference().degree();
  const SurfaceKink energy{cortex, penalty_factor * degree * degree};
  const Eigen::Matrix<double, inputs, 1> f = kink_ * local;
  Eigen::Matrix<double, inputs, 1> slope;
  if (want == Want::residual) {
    const auto [value, slopes] = value_and_slopes<inputs, double>(energy, plain<inputs>(f));
    for (int i = 0; i < inputs; ++i) slope(i) = slopes[i];
  } else {
    const auto [value, slopes] = value_and_slopes<inputs, ceres::Jet<double, inputs>>(energy, dual<inputs>(f));
    Eigen::Matrix<double, inputs, inputs> curvature;
    for (int i = 0; i < inputs; ++i) {
      slope(i) = slopes[i].a;
      curvature.row(i) = slopes[i].v.transpose();
    }
    system.tangent.noalias() += kink_.transpose() * (curvature * kink_);
  }
  system.residual.noalias() += kink_.transpose() * slope;
}

}  // namespace rheocyte
