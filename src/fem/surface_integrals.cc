#include "fem/surface_integrals.h"

#include <array>
#include <cmath>

#include "fem/surface_tables.h"

namespace rheocyte {
namespace {

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
      const VectorXd rest = table.inputs * patches_[e].rest;
      const Meridian<double> X = read_fields<SurfaceFields<double>>([&](int i) { return rest(i); }).meridian();
      reference.push_back({X.x_t, X.r_t, X.r});
    }
  }
}

void SurfaceIntegrals::tabulate() {
  const ReferenceElement<2>& reference = space_->reference();
  const int n = reference.degree() + 1;
  const auto at_points = edge_tables(reference, reference.points_1d);
  for (int q = 0; q < reference.points_1d.size(); ++q) {
    const auto rows = [&](const std::vector<Input>& list) {
      MatrixXd table = MatrixXd::Zero(list.size(), 2 * n + 2);
      for (int i = 0; i < int(list.size()); ++i) {
        const auto& [source, component, part] = list[i];
        if (source == Source::position) table.row(i).segment(component * n, n) = at_points[part].row(q);
        if (source == Source::pressure) table(i, 2 * n) = 1;
        if (source == Source::frame) table(i, 2 * n + 1) = 1;
      }
      return table;
    };
    edge_.push_back({rows(inputs_of<SurfaceFields<double>>()), rows(inputs_of<SurfaceFlux<double>>())});
  }
  const auto at_ends = edge_tables(reference, Eigen::Vector2d(0, 1));
  const std::vector<Input> list = inputs_of<KinkFields<double>>();
  kink_.setZero(list.size(), 4 * n);
  for (int i = 0; i < int(list.size()); ++i) {
    const auto& [source, component, part] = list[i];
    const int end = component < 2 ? 1 : 0;  // of the piece before, start of the piece after
    kink_.row(i).segment(component * n, n) = at_ends[part].row(end);
  }
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
  constexpr int inputs = SurfaceFields<double>::count, outputs = SurfaceFlux<double>::count;
  using Number = Dual<double, inputs>;
  const double at_rest = rest_pressure(cortex, space_->mesh().geometry().radius());
  for (std::size_t q = 0; q < edge_.size(); ++q) {
    const SurfacePoint form{cortex, at_rest, references_[edge][q]};
    const double weight = space_->reference().weights_1d(int(q));
    const Eigen::Matrix<double, inputs, 1> f = edge_[q].inputs * local;
    Eigen::Matrix<double, outputs, 1> flux;
    int k = 0;
    if (want == Want::residual) {
      form(read_fields<SurfaceFields<double>>([&](int i) { return f(i); })).visit([&](const Input&, double value) {
        flux(k++) = weight * value;
      });
    } else {
      Eigen::Matrix<double, outputs, inputs> slope;
      form(read_fields<SurfaceFields<Number>>([&](int i) {
        return Number(f(i), i);
      })).visit([&](const Input&, const Number& value) {
        flux(k) = weight * value.value;
        for (int i = 0; i < inputs; ++i) slope(k, i) = weight * value.slope(i);
        ++k;
      });
      system.tangent.noalias() += edge_[q].tests.transpose() * (slope * edge_[q].inputs);
    }
    system.residual.noalias() += edge_[q].tests.transpose() * flux;
  }
}

void SurfaceIntegrals::integrate_kink(const Cortex& cortex, const VectorXd& local, Want want,
                                      ElementSystem& system) const {
  constexpr int inputs = KinkFields<double>::count;
  const SurfaceKink energy{cortex, bending_penalty(space_->reference())};
  std::array<double, inputs> f;
  Eigen::Map<Eigen::Matrix<double, inputs, 1>>(f.data()) = kink_ * local;
  Eigen::Matrix<double, inputs, 1> slope;
  if (want == Want::residual) {
    const auto [value, slopes] = value_and_slopes(energy, f);
    for (int i = 0; i < inputs; ++i) slope(i) = slopes[i];
  } else {
    const auto [value, slopes] = value_and_slopes(energy, independent(f));
    Eigen::Matrix<double, inputs, inputs> curvature;
    for (int i = 0; i < inputs; ++i) {
      slope(i) = slopes[i].value;
      for (int j = 0; j < inputs; ++j) curvature(i, j) = slopes[i].slope(j);
    }
    system.tangent.noalias() += kink_.transpose() * (curvature * kink_);
  }
  system.residual.noalias() += kink_.transpose() * slope;
}

}  // namespace rheocyte
