#include "duct/duct_cortex.h"

#include <Eigen/Geometry>
#include <map>

#include "duct/cortex_points.h"
#include "fem/surface_tables.h"

namespace rheocyte {
namespace {

/// Derivatives with respect to s, t, and both twice, of the nodes' functions at some points: points x nodes.
struct FaceTables {
  MatrixXd s, t, ss, st, tt;
};

/// At all pairs of these coordinates, s fastest.
FaceTables face_tables(const ReferenceElement<2>& reference, const VectorXd& at_s, const VectorXd& at_t) {
  const auto u = edge_tables(reference, at_s), v = edge_tables(reference, at_t);
  const auto product = [&](int a, int b) {
    const Eigen::Index points = at_s.size(), nodes = u[a].cols();
    MatrixXd result(points * at_t.size(), nodes * nodes);
    for (Eigen::Index q = 0; q < at_t.size(); ++q) {
      for (Eigen::Index k = 0; k < nodes; ++k) result.block(q * points, k * nodes, points, nodes) = v[b](q, k) * u[a];
    }
    return result;
  };
  return {product(1, 0), product(0, 1), product(2, 0), product(1, 1), product(0, 2)};
}

}  // namespace

/// A side of a layer's element's face, seen by coordinates a along it and b outward, so that a x b points out of the
/// cell as s x t does.
struct DuctCortex::Edge {
  int element = 0, side = 0;    ///< side: s = 1, s = 0, t = 1, t = 0
  std::vector<int> nodes = {};  ///< by a

  /// The derivatives by a, b, both twice, at points of the edge.
  FaceTables tables(const ReferenceElement<2>& reference) const {
    const VectorXd one = VectorXd::Constant(1, side % 2 == 0 ? 1 : 0), &points = reference.points_1d;
    const double outward = side % 2 == 0 ? 1 : -1;
    if (side < 2) {  // b is s or -s, a is -t or t
      const VectorXd a = side == 0 ? VectorXd(1 - points.array()) : points;
      const FaceTables f = face_tables(reference, one, a);
      return {-outward * f.t, outward * f.s, f.tt, -f.st, f.ss};
    }
    const VectorXd a = side == 2 ? points : VectorXd(1 - points.array());
    const FaceTables f = face_tables(reference, a, one);
    return {outward * f.s, outward * f.t, f.ss, f.st, f.tt};
  }
};

DuctCortex::DuctCortex(const DuctSpace& space, bool bends)
    : space_(space),
      reference_(space.reference().degree()),
      bends_(bends),
      patches_of_element_(space.elements().size()) {
  const FaceTables tables = face_tables(reference_, reference_.points_1d, reference_.points_1d);
  std::vector<MatrixXd> parts{tables.s, tables.t};
  if (bends) parts.insert(parts.end(), {tables.ss, tables.st, tables.tt});
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.mesh().elements()[e].foot != e) continue;
    patches_of_element_[e].push_back(int(patches_.size()));
    patches_.push_back(face_patch(e, parts));
    if (space.inner_pressure() < 0) continue;
    patches_of_element_[e].push_back(int(patches_.size()));
    patches_.push_back(inflated_patch(patches_.back()));
  }
  if (bends_) find_edges();
}

DuctCortex::Patch DuctCortex::face_patch(int element, const std::vector<MatrixXd>& parts) const {
  Patch patch;
  append_nodes(element, {}, patch);
  patch.weights = reference_.weights;
  patch.parts = parts;
  const MatrixXd s = parts[0] * patch.rest, t = parts[1] * patch.rest;
  for (int q = 0; q < reference_.points(); ++q) {
    const Eigen::RowVector3d a = s.row(q), b = t.row(q);
    const auto across = [](const auto& u, const auto& v) { return u(1) * v(1) + u(2) * v(2); };
    patch.rest_metric.push_back({{a(0) * a(0), a(0) * b(0), b(0) * b(0)}, {across(a, a), across(a, b), across(b, b)}});
  }
  return patch;
}

DuctCortex::Patch DuctCortex::inflated_patch(const Patch& face) const {
  const Eigen::Index n = face.rest.rows(), points = face.weights.size();
  const auto with_row = [](const auto& rows, const auto& last) {
    auto longer = rows;
    longer.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    longer.bottomRows(1) = last;
    return longer;
  };
  const Eigen::RowVector3i pressure(space_.inner_pressure(), -1, -1);
  Patch patch{.rest = with_row(face.rest, Eigen::RowVector3d::Zero()),
              .unknowns = with_row(face.unknowns, pressure),
              .equations = with_row(face.equations, pressure),
              .signs = with_row(face.signs, Eigen::RowVector3d::Ones()),
              .weights = face.weights,
              .parts = {},
              .rest_metric = {},
              .rest_volume = VectorXd(points)};
  for (const MatrixXd* table : {&reference_.shape.value, &face.parts[0], &face.parts[1]}) {
    MatrixXd& part = patch.parts.emplace_back(MatrixXd::Zero(points, n + 1));
    part.leftCols(n) = *table;
  }
  patch.parts.emplace_back(MatrixXd::Zero(points, n + 1)).col(n).setOnes();
  const Eigen::MatrixX3d x = patch.parts[0] * patch.rest, s = patch.parts[1] * patch.rest,
                         t = patch.parts[2] * patch.rest;
  for (Eigen::Index q = 0; q < points; ++q) patch.rest_volume(q) = x.row(q).dot(s.row(q).cross(t.row(q))) / 3;
  return patch;
}

// Behind the edge a and b go on, against those of the other face's own edge. An image has the same a.
DuctCortex::Patch DuctCortex::edge_patch(const Edge& before, const Edge* behind) const {
  Patch patch;
  append_nodes(before.element, {}, patch);
  append_nodes(behind ? behind->element : before.element, behind ? Image{} : mirror_at(before), patch);
  patch.weights = behind ? reference_.weights_1d : VectorXd(reference_.weights_1d / 2);
  const FaceTables here = before.tables(reference_), there = (behind ? *behind : before).tables(reference_);
  const auto place = [&](const MatrixXd& table, bool second) {
    MatrixXd both = MatrixXd::Zero(table.rows(), patch.rest.rows());
    (second ? both.rightCols(table.cols()) : both.leftCols(table.cols())) = table;
    return both;
  };
  const auto same_points = [&](const MatrixXd& table) { return behind ? MatrixXd(table.colwise().reverse()) : table; };
  patch.parts = {place(here.s, false),
                 place(here.ss, false),
                 place(here.t, false),
                 place(here.st, false),
                 place(here.tt, false),
                 place(same_points(-there.t), true),
                 place(same_points(behind ? there.st : MatrixXd(-there.st)), true),
                 place(same_points(there.tt), true)};
  return patch;
}

void DuctCortex::append_nodes(int element, const Image& image, Patch& patch) const {
  const auto& nodes = space_.nodes().of_element[element];
  const Eigen::Index first = patch.rest.rows(), all = first + reference_.nodes();
  const DuctPoint sign = image({1, 1, 1});
  patch.rest.conservativeResize(all, 3);
  patch.unknowns.conservativeResize(all, 3);
  patch.equations.conservativeResize(all, 3);
  patch.signs.conservativeResize(all, 3);
  for (Eigen::Index k = first; k < all; ++k) {
    const int node = nodes[k - first];
    patch.rest.row(k) = image(space_.node_points()[node]).transpose();
    for (int c = 0; c < 3; ++c) {
      const int of_node = image.swaps && c > 0 ? 3 - c : c;
      patch.unknowns(k, c) = space_.displacement(node, of_node);
      patch.equations(k, c) = space_.momentum_row(node, of_node);
    }
    patch.signs.row(k) = sign.transpose();
  }
}

std::vector<DuctCortex::Edge> DuctCortex::edges_of(int element) const {
  const auto& nodes = space_.nodes().of_element[element];
  const int n = reference_.degree() + 1;
  std::vector<Edge> edges;
  for (int side = 0; side < 4; ++side) {
    Edge& edge = edges.emplace_back(Edge{element, side});
    for (int i = 0; i < n; ++i) {
      const int across = side % 2 == 0 ? n - 1 : 0, along = side == 0 || side == 3 ? n - 1 - i : i;
      edge.nodes.push_back(nodes[side < 2 ? across + n * along : along + n * across]);
    }
  }
  return edges;
}

/// The mirror plane through an edge at the border of the part that is computed.
Image DuctCortex::mirror_at(const Edge& edge) const {
  const DuctPoint& inside = space_.node_points()[edge.nodes[1]];
  const Across across = across_at(space_.mesh().symmetry(), inside);
  if (across.ties) return {.swaps = true};
  return across.holds_z ? Image{false, 1, -1} : Image{false, -1, 1};
}

void DuctCortex::find_edges() {
  std::map<std::pair<int, int>, Edge> open;  // by first and last node
  const auto add = [this](const Edge& before, const Edge* behind) {
    patches_of_element_[before.element].push_back(int(patches_.size()));
    patches_.push_back(edge_patch(before, behind));
  };
  for (int e = 0; e < int(patches_of_element_.size()); ++e) {
    if (patches_of_element_[e].empty()) continue;
    for (const Edge& edge : edges_of(e)) {
      const auto found = open.find({edge.nodes.back(), edge.nodes.front()});
      if (found == open.end()) {
        open.emplace(std::pair{edge.nodes.front(), edge.nodes.back()}, edge);
        continue;
      }
      add(found->second, &edge);
      open.erase(found);
    }
  }
  for (const auto& [ends, edge] : open) add(edge, nullptr);
}

void DuctCortex::integrate(int index, const Cortex& law, const VectorXd& unknowns, Want want,
                           ElementSystem& system) const {
  const Patch& patch = patches_[index];
  if (patch.rest_volume.size() > 0) {
    const double at_rest = rest_pressure(law, space_.mesh().geometry().radius());
    integrate<12>(
        patch,
        [&](int q) {
          return InflationPoint{at_rest, patch.rest_volume(q), law.axial_tension};
        },
        unknowns, want, system);
  } else if (patch.rest_metric.empty()) {
    const BendingEdge edge{law, bending_penalty(reference_)};
    integrate<24>(
        patch, [&](int) { return BentEdgeAtPoint{edge}; }, unknowns, want, system);
  } else if (bends_) {
    integrate<15>(
        patch,
        [&](int q) {
          return BentShellAtPoint{{law, patch.rest_metric[q].at_rest(law.rest_stretch)}};
        },
        unknowns, want, system);
  } else {
    integrate<6>(
        patch,
        [&](int q) {
          return MembranePoint{law, patch.rest_metric[q].at_rest(law.rest_stretch)};
        },
        unknowns, want, system);
  }
}

template <int numbers, class Energy>
void DuctCortex::integrate(const Patch& patch, const Energy& energy_at, const VectorXd& unknowns, Want want,
                           ElementSystem& system) const {
  const int points = int(patch.weights.size()), n = int(patch.rest.rows()), parts = numbers / 3;
  MatrixXd x = patch.rest;
  for (int i = 0; i < 3 * n; ++i) {
    if (patch.unknowns(i) >= 0) x(i) += patch.signs(i) * unknowns(patch.unknowns(i));
  }
  std::vector<MatrixXd> slopes;
  for (const MatrixXd& table : patch.parts) slopes.push_back(table * x);
  MatrixXd flux(points, numbers), flux_slopes(points, numbers * numbers);
  for (int q = 0; q < points; ++q) {
    std::array<double, numbers> values;
    for (int i = 0; i < numbers; ++i) values[i] = slopes[i / 3](q, i % 3);
    const auto energy = energy_at(q);
    if (want == Want::residual) {
      const auto work = work_of(energy, values);
      for (int i = 0; i < numbers; ++i) flux(q, i) = patch.weights(q) * work[i];
      continue;
    }
    const auto work = work_of(energy, independent(values));
    for (int i = 0; i < numbers; ++i) {
      flux(q, i) = patch.weights(q) * work[i].value;
      for (int j = 0; j < numbers; ++j) flux_slopes(q, i * numbers + j) = patch.weights(q) * work[i].slope(j);
    }
  }
  system.residual.setZero(3 * n);
  for (int i = 0; i < numbers; ++i)
    system.residual.segment(i % 3 * n, n) += patch.parts[i / 3].transpose() * flux.col(i);
  const VectorXd signs = patch.signs.reshaped();
  system.residual.array() *= signs.array();
  if (want == Want::residual) return;
  system.tangent.setZero(3 * n, 3 * n);
  for (int i = 0; i < numbers; ++i) {
    for (int c = 0; c < 3; ++c) {
      MatrixXd weighted = MatrixXd::Zero(points, n);
      for (int b = 0; b < parts; ++b)
        weighted += flux_slopes.col(i * numbers + 3 * b + c).asDiagonal() * patch.parts[b];
      system.tangent.block(i % 3 * n, c * n, n, n).noalias() += patch.parts[i / 3].transpose() * weighted;
    }
  }
  system.tangent = signs.asDiagonal() * system.tangent * signs.asDiagonal();
}

}  // namespace rheocyte
