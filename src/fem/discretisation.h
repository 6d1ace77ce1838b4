// Unknowns of the stationary problem on one mesh at one degree, and where each element finds its own.
//
// Unknown: displacement (x, r) of the cell's nodes; velocity (x, r) of the liquid's nodes relative to the cell;
// discontinuous pressures everywhere; the cell's velocity v_cell. In a pure shell only the surface's nodes have
// displacements, and one pressure fills the cell. No unknown: the liquid's mesh (it follows the
// surface along spokes, docs/theory.md eq:spokes) and everything that a boundary condition fixes.
#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "case/problem.h"
#include "fem/channel_mesh.h"
#include "fem/reference_element.h"
#include "laws/axisymmetric.h"
#include "laws/liquid.h"

namespace rheocyte {

/// A local value of an element: constant + factor * unknown; no unknown: -1.
struct Slot {
  int unknown = -1;
  double factor = 1, constant = 0;

  double value(const VectorXd& unknowns) const { return constant + (unknown >= 0 ? factor * unknowns(unknown) : 0.0); }
};

/// What fills the cell: an elastic solid, a liquid at rest of which only the pressure matters (a pure shell), or one
/// that carries its mesh along.
enum class Interior { elastic, liquid, flowing };
inline Interior interior_of(const Problem& problem) {
  if (problem.bulk.law == BulkLaw::none) return Interior::liquid;
  return problem.bulk.shear_modulus > 0 ? Interior::elastic : Interior::flowing;
}

/// Quadrature points in each direction. No force holds the mesh of a flowing interior in place: it would follow a
/// volume that is wrong by the rule's error, and fold. The volume of an element, of degree 3 p - 1 in each direction,
/// is exact with 3 p / 2 points.
inline int points_for(int degree, Interior interior) {
  return interior == Interior::flowing ? std::max(degree + 2, (3 * degree + 1) / 2) : degree + 2;
}

/// What the x and r columns of positions do.
struct PositionShapes {
  std::array<ShapeTable<2>, 2> at_points;  ///< the quadrature's
  std::array<MatrixXd, 2> at_nodes;        ///< nodes x columns
};

/// What one element knows. Column slots: displacements x then r of `position_columns` functions, in the liquid
/// velocities x then r of the nodes, pressures. Row slots: x-tests, r-tests of the nodes, pressure tests.
struct ElementUnknowns {
  bool liquid = false;
  int position_columns = 0;
  std::shared_ptr<const PositionShapes> position;  ///< shared with copies and, in the cell, by all elements
  std::vector<PointMap<double, 2>> undeformed;     ///< map at the quadrature points
  std::vector<Slot> columns;
  std::vector<int> rows;  ///< unknown whose equation the row belongs to, or -1

  /// An element of a liquid interior: nothing to integrate.
  bool is_empty() const { return columns.empty(); }
};

/// Maps that take the place of those round the undeformed cell, to whose dets those of a deformed mesh are still
/// relative (min_relative_det).
template <int dim>
void replace_maps(std::vector<PointMap<double, dim>>& undeformed, std::vector<PointMap<double, dim>> others) {
  for (std::size_t q = 0; q < others.size(); ++q) others[q].det = undeformed[q].det;
  undeformed = std::move(others);
}

/// An edge of the mesh on the cell's surface, the inlet or the outlet.
struct BoundaryEdge {
  int element = 0;
  std::vector<int> nodes;  ///< p+1 nodes in order
};

class Discretisation {
 public:
  static constexpr int dim = 2;

  Discretisation(const ChannelMesh&, int degree, const Liquid&, Interior = Interior::elastic, Drive = Drive::rate);

  const ChannelMesh& mesh() const { return *mesh_; }
  const ReferenceElement<2>& reference() const { return reference_; }
  /// Whether the inlet has a given pressure, as the outlet, rather than given velocities.
  bool has_open_inlet() const { return open_inlet_; }
  const std::vector<ElementUnknowns>& elements() const { return elements_; }
  const NodeNumbers& nodes() const { return nodes_; }
  const std::vector<Point>& node_points() const { return points_; }

  /// How far the mesh's nodes have to move away from the axis such that the wall has the radius `wall(x)`: where the
  /// wall's points are with these unknowns. Nodes of the liquid follow along their spokes, the cell's stay. By nodes.
  VectorXd wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const;
  /// Moves the nodes from their places in a straight channel, and adapts the flow through the inlet.
  void move_nodes(const VectorXd& outward);
  /// Where the liquid's nodes are in a straight channel round the undeformed cell, from where they follow their spokes.
  void set_points(const std::vector<Point>&);

  int unknowns() const { return unknowns_; }
  int cell_velocity() const { return cell_velocity_; }
  bool is_motion(int unknown) const { return unknown == cell_velocity_; }
  /// Pressure of a liquid interior, above that of the sphere at rest; -1 in an elastic one.
  int inner_pressure() const { return inner_pressure_; }
  /// Unknown of component c (0: x, 1: r) of a node's displacement, -1 if fixed or not in the cell.
  int displacement(int node, int c) const { return displacement_[2 * node + c]; }
  const Slot& velocity(int node, int c) const { return velocity_[2 * node + c]; }
  int pressure(int element, int mode) const { return pressure_[element * reference_.pressures() + mode]; }

  /// Edges of the surface from the front pole to the rear pole.
  const std::vector<BoundaryEdge>& surface() const { return surface_; }
  const std::vector<BoundaryEdge>& inlet() const { return inlet_; }
  const std::vector<BoundaryEdge>& outlet() const { return outlet_; }

 private:
  struct NodeFlags {
    bool cell = false, liquid = false, surface = false, axis = false, wall = false, inlet = false, outlet = false;
  };
  std::vector<NodeFlags> flag_nodes() const;
  void number_unknowns(const std::vector<NodeFlags>&);
  void find_edges();
  void set_inflow();
  ElementUnknowns cell_element(int element, const std::shared_ptr<const PositionShapes>&) const;
  ElementUnknowns liquid_element(int element) const;
  void add_spokes(int element, ElementUnknowns&) const;
  std::vector<PointMap<double, 2>> undeformed_maps(int element) const;

  const ChannelMesh* mesh_;
  Liquid liquid_;
  Interior interior_;
  bool open_inlet_;
  ReferenceElement<2> reference_;
  NodeNumbers nodes_;
  std::vector<Point> points_, straight_points_;
  std::vector<int> displacement_, pressure_;
  std::vector<Slot> velocity_;
  int unknowns_ = 0, cell_velocity_ = -1, inner_pressure_ = -1;
  std::vector<BoundaryEdge> surface_, inlet_, outlet_;
  std::vector<ElementUnknowns> elements_;
};

}  // namespace rheocyte
