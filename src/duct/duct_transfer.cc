#include "duct/duct_transfer.h"

#include <algorithm>
#include <cmath>

#include "duct/duct_surface.h"
#include "fem/tensor_tangent.h"

namespace rheocyte {
namespace {

/// Whether two elements of meshes of the same faces differ in their places along the side and outward alone.
bool are_in_one_row(const DuctElement& a, const DuctElement& b) {
  if (a.part != b.part || a.face != b.face || a.image != b.image) return false;
  if (a.part == Part::core || a.face != Face::side) return a.corners == b.corners;
  return std::ranges::equal(
      a.corners, b.corners, {}, [](const FacePoint& p) { return p(0); }, [](const FacePoint& p) { return p(0); });
}

/// Whether elements of the same number are at the same place.
bool are_alike(const DuctMesh& a, const DuctMesh& b) {
  return a.side_breaks() == b.side_breaks() && a.elements().size() == b.elements().size();
}

/// Products of coordinates in an element, the first direction fastest.
struct Grid {
  std::array<VectorXd, 3> at;

  Eigen::Vector3d operator()(int k) const {
    const int n = int(at[0].size());
    return {at[0](k % n), at[1](k / n % n), at[2](k / (n * n))};
  }
  bool holds(int k) const {
    constexpr double edge = 1e-10;
    return ((*this)(k).array() - 0.5).abs().maxCoeff() < 0.5 + edge;
  }
};

/// Calls visit(f, grid) for each element f of one mesh that may hold points of element e of another, with the
/// coordinates there of all products of `at` in e.
template <class Visit>
void locate(const DuctMesh& from, const DuctMesh& to, int e, const VectorXd& at, const Visit& visit) {
  const DuctElement& self = to.elements()[e];
  const int along = self.direction_along();
  Grid grid{{at, at, at}};
  if (are_alike(from, to)) return visit(e, grid);
  for (int f = 0; f < int(from.elements().size()); ++f) {
    const DuctElement& other = from.elements()[f];
    if (!are_in_one_row(self, other)) continue;
    const auto in_other = [&](const std::array<double, 2>& mine, const std::array<double, 2>& theirs) {
      return VectorXd((mine[0] - theirs[0] + at.array() * (mine[1] - mine[0])) / (theirs[1] - theirs[0]));
    };
    grid.at[2] = in_other(self.outward, other.outward);
    if (along >= 0) grid.at[along] = in_other(self.along(), other.along());
    visit(f, grid);
  }
}

/// Values of functions on an element, one per column, from those at its nodes.
MatrixXd values_at(const ReferenceElement<3>& reference, const Grid& grid, const MatrixXd& nodal) {
  return apply_in_directions(
      {reference.lagrange(grid.at[0]), reference.lagrange(grid.at[1]), reference.lagrange(grid.at[2])}, nodal);
}

/// Velocities in the liquid, displacements in the cell, at an element's nodes.
MatrixXd nodal_fields(const DuctSpace& space, const VectorXd& unknowns, int e) {
  const auto& nodes = space.nodes().of_element[e];
  MatrixXd field(nodes.size(), 3);
  for (int k = 0; k < field.rows(); ++k) {
    for (int c = 0; c < 3; ++c) {
      field(k, c) = space.elements()[e].liquid
                        ? space.velocity(nodes[k], c).value(unknowns)
                        : duct_point(space, unknowns, nodes[k])(c) - space.node_points()[nodes[k]](c);
    }
  }
  return field;
}

VectorXd pressure_modes(const DuctSpace& space, const VectorXd& unknowns, int e) {
  VectorXd modes(space.reference().pressures());
  for (int k = 0; k < modes.size(); ++k) modes(k) = unknowns(space.pressure(e, k));
  return modes;
}

void transfer_pressure(const DuctSpace& from, const VectorXd& unknowns, const DuctSpace& to, int e, VectorXd& result) {
  const ReferenceElement<3>&source = from.reference(), &target = to.reference();
  VectorXd at_points(target.points()), modes;
  locate(from.mesh(), to.mesh(), e, target.points_1d, [&](int f, const Grid& grid) {
    const VectorXd there = pressure_modes(from, unknowns, f);
    if (are_alike(from.mesh(), to.mesh())) return void(modes = there);
    for (int q = 0; q < target.points(); ++q)
      if (grid.holds(q)) at_points(q) = source.pressure_modes(grid(q)).dot(there);
  });
  // The modes are orthonormal, and those of a degree begin with those of lower ones: projection is a product.
  if (modes.size() == 0) modes = target.pressure.value.transpose() * target.weights.cwiseProduct(at_points);
  for (int k = 0; k < std::min<int>(int(modes.size()), target.pressures()); ++k) result(to.pressure(e, k)) = modes(k);
}

}  // namespace

VectorXd transfer(const DuctSpace& from, const VectorXd& unknowns, const DuctSpace& to) {
  VectorXd result = VectorXd::Zero(to.unknowns());
  result(to.cell_velocity()) = unknowns(from.cell_velocity());
  if (to.turns()) {
    result(to.drift()) = unknowns(from.drift());
    result(to.spin()) = unknowns(from.spin());
  }
  double shift = 0;  // of the node that is held there
  for (int e = 0; e < int(to.elements().size()); ++e) {
    const auto& nodes = to.nodes().of_element[e];
    const bool liquid = to.elements()[e].liquid;
    locate(from.mesh(), to.mesh(), e, to.reference().nodes_1d, [&](int f, const Grid& grid) {
      const MatrixXd values = values_at(from.reference(), grid, nodal_fields(from, unknowns, f));
      for (int k = 0; k < values.rows(); ++k) {
        if (!grid.holds(k)) continue;
        if (!liquid && nodes[k] == to.fixed_node()) shift = values(k, 0);
        for (int c = 0; c < 3; ++c) {
          const int unknown = liquid ? to.velocity(nodes[k], c).unknown : to.displacement(nodes[k], c);
          if (unknown >= 0 && !to.is_motion(unknown)) result(unknown) = values(k, c);
        }
      }
    });
    if (!to.elements()[e].is_empty) transfer_pressure(from, unknowns, to, e, result);
  }
  if (to.inner_pressure() >= 0) result(to.inner_pressure()) = unknowns(from.inner_pressure());
  for (int i = 0; i < to.nodes().count; ++i) {
    if (const int unknown = to.displacement(i, 0); unknown >= 0) result(unknown) -= shift;
  }
  return result;
}

std::vector<DuctPoint> transferred_points(const DuctSpace& from, const DuctSpace& to) {
  const VectorXd &own = to.reference().nodes_1d, &there = from.reference().nodes_1d;
  const double scale = to.mesh().geometry().radius() / from.mesh().geometry().radius();
  std::vector<DuctPoint> points = to.node_points();
  for (int e = 0; e < int(to.elements().size()); ++e) {
    if (!to.elements()[e].liquid) continue;
    const auto& nodes = to.nodes().of_element[e];
    const MatrixXd rest = to.mesh().points(e, own);
    locate(from.mesh(), to.mesh(), e, own, [&](int f, const Grid& grid) {
      MatrixXd moves = -from.mesh().points(f, there);
      for (int k = 0; k < moves.rows(); ++k)
        moves.row(k) += from.node_points()[from.nodes().of_element[f][k]].transpose();
      const MatrixXd places = rest + scale * values_at(from.reference(), grid, moves);
      for (int k = 0; k < places.rows(); ++k) {
        const bool is_of_cell = to.displacement(nodes[k], 0) >= 0 || nodes[k] == to.fixed_node();
        if (!is_of_cell && grid.holds(k)) points[nodes[k]] = places.row(k).transpose();
      }
    });
  }
  return points;
}

}  // namespace rheocyte
