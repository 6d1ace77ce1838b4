// Unknowns of the stationary problem in a duct, or in one part of it by symmetry, and where each hexahedron finds its
// own.
//
// As in the tube (fem/discretisation.h): displacements of the cell's nodes, velocities of the liquid's nodes relative
// to the cell, discontinuous pressures, the cell's velocity v_cell. The planes of symmetry are known to the table of
// slots alone: across a mirror plane components vanish, and in y = z the components y and z of a node are one unknown,
// to whose equation the tests of both belong (docs/theory-square.md, eq:tie).
#pragma once
#include <functional>
#include <utility>

#include "duct/duct_flow.h"
#include "fem/discretisation.h"
#include "laws/cartesian.h"
#include "laws/moving_form.h"

namespace rheocyte {

/// What one hexahedron knows. Columns: displacements x, y, z of its nodes (none where the mesh rests), in the liquid
/// velocities, pressures. Rows: tests of the momentum x, y, z, of the pressures.
struct HexahedronUnknowns {
  bool liquid = false;
  bool moves = false;                           ///< whether there are displacements
  std::vector<PointMap<double, 3>> undeformed;  ///< map at the quadrature points
  std::vector<Slot> displacement, velocity, pressure;
  std::vector<int> rows;  ///< unknown whose equation the row belongs to, or -1
  bool is_empty = false;  ///< of a liquid interior: nothing to integrate, its mesh follows the surface
  /// Of a cell on its way: how velocities follow from displacements (docs/theory-time.md, eq:bdf), at the quadrature
  /// points; else empty.
  double rate = 0;
  std::vector<CellHistory<3>> history = {};
  int spin = -1;  ///< unknown with which the material turns through the shape; -1: it does not
};

/// A velocity along x, of (y, z).
struct GivenFlow {
  explicit GivenFlow(std::function<double(const Eigen::Vector2d&)> given) : velocity(std::move(given)) {}
  std::function<double(const Eigen::Vector2d&)> velocity;
};

class DuctSpace {
 public:
  static constexpr int dim = 3;

  /// The liquid's undisturbed flow enters, or, where the pressure drop is given, what flows through an open inlet.
  DuctSpace(const DuctMesh&, int degree, const Liquid&, Drive = Drive::rate, Interior = Interior::elastic);
  /// A given velocity along x enters, and the walls move with it.
  DuctSpace(const DuctMesh&, int degree, const GivenFlow&);

  const DuctMesh& mesh() const { return mesh_; }
  const ReferenceElement<3>& reference() const { return reference_; }
  const std::vector<HexahedronUnknowns>& elements() const { return elements_; }
  const NodeNumbers& nodes() const { return nodes_; }
  const std::vector<DuctPoint>& node_points() const { return points_; }
  const CrossSection& section() const { return section_; }
  bool has_open_inlet() const { return open_inlet_; }
  bool has_given_flow() const { return given_flow_; }

  /// Where the wall is not straight: its half width over that of the straight one, less 1, where the nodes are with
  /// these unknowns. By nodes.
  VectorXd wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const;
  /// Moves the liquid's nodes from their places in the straight duct so far that the wall is there, with the cell
  /// displaced along y by `aside`, and adapts the flow through the inlet.
  void move_nodes(const VectorXd& outward, double aside = 0);
  double aside() const { return aside_; }
  /// Where the liquid's nodes are in a straight duct round the undeformed cell, from where they follow their spokes.
  void set_points(const std::vector<DuctPoint>&);

  int unknowns() const { return unknowns_; }
  int cell_velocity() const { return cell_velocity_; }
  /// Pressure of a liquid interior, above that of the sphere at rest; -1 in an elastic one.
  int inner_pressure() const { return inner_pressure_; }
  /// Of a cell off the axis: its velocity along y, and the rate at which its material turns about z; else -1.
  int drift() const { return drift_; }
  int spin() const { return spin_; }
  bool turns() const { return mesh_.symmetry() == Symmetry::half; }
  /// Whether an unknown is one of these velocities of the whole cell.
  bool is_motion(int unknown) const {
    return unknown >= 0 && (unknown == cell_velocity_ || unknown == drift_ || unknown == spin_);
  }
  /// Unknown of a component of a node's displacement, -1 if fixed or not in the cell.
  int displacement(int node, int c) const { return displacement_[3 * node + c]; }
  /// Unknown to whose equation the momentum of a node of the cell belongs: where a displacement is held, a velocity of
  /// the whole cell.
  int momentum_row(int node, int c) const;
  const Slot& velocity(int node, int c) const { return velocity_[3 * node + c]; }
  int pressure(int element, int mode) const { return pressure_[element * reference_.pressures() + mode]; }
  /// The node whose axial displacement is held, which fixes the cell's place: on the axis, or, round a liquid interior,
  /// on the surface.
  int fixed_node() const { return fixed_node_; }

 private:
  struct NodeFlags {
    bool cell = false, liquid = false, wall = false, inlet = false, outlet = false;
    Across across;
  };
  std::vector<NodeFlags> flag_nodes() const;
  DuctSpace(const DuctMesh&, Interior, int degree);
  void number_unknowns(const std::function<double(const Eigen::Vector2d&)>& inflow);
  void find_fixed_nodes();
  /// The undisturbed flow through the inlet's section where the wall is so much wider, at the nodes of the section.
  VectorXd inflow_at(double stretch) const;
  void set_inflow(const VectorXd& outward);
  /// Slope of the wall, over the straight half width, at the inlet.
  double inlet_slope(const VectorXd& outward) const;
  HexahedronUnknowns unknowns_of(int element) const;
  void add_displacements(int element, HexahedronUnknowns&) const;
  std::vector<PointMap<double, 3>> undeformed_maps(int element) const;

  DuctMesh mesh_;
  Interior interior_;
  Liquid liquid_;  ///< that flows in
  bool open_inlet_ = false, given_flow_ = false;
  ReferenceElement<3> reference_;
  CrossSection section_;
  NodeNumbers nodes_;
  std::vector<DuctPoint> points_, straight_points_;
  /// Of the nodes of the liquid, where DuctGeometry has them.
  struct LiquidPlace {
    Part part = Part::core;
    DuctPoint cube = DuctPoint::Zero();
    double outward = 0;
  };
  std::vector<LiquidPlace> places_;
  double aside_ = 0;
  std::vector<int> displacement_, pressure_;
  std::vector<Slot> velocity_;
  int unknowns_ = 0, cell_velocity_ = -1, inner_pressure_ = -1, drift_ = -1, spin_ = -1, fixed_node_ = -1,
      fixed_pole_ = -1;
  std::vector<HexahedronUnknowns> elements_;
};

}  // namespace rheocyte
