// A cell on its way at one resolution, in whatever dimension: mesh, walls, and the system of one step in time. What
// distinguishes the tube from a duct for the steppers.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "fem/motion.h"
#include "solve/discrete.h"

namespace rheocyte {

/// The frame moves with v_cell; walls are seen from it.
class MovingDiscrete {
 public:
  MovingDiscrete() = default;
  virtual ~MovingDiscrete() = default;
  MovingDiscrete(const MovingDiscrete&) = delete;
  MovingDiscrete& operator=(const MovingDiscrete&) = delete;

  /// By which states are described, on the mesh where the walls are now.
  virtual const Discrete& discrete() const = 0;
  virtual NonlinearSystem& system() = 0;
  virtual const NonlinearSystem& system() const = 0;
  virtual int cell_velocity() const = 0;
  /// Velocity of a cell off the axis along its offset; -1: it is on the axis.
  virtual int drift() const { return -1; }
  /// How far it starts from its place in the mesh.
  virtual double first_aside() const { return 0; }
  /// Displacements of the surface, each once or more often.
  virtual std::vector<int> surface_unknowns() const = 0;

  virtual void set_motion(const Motion&) = 0;
  /// Velocities relative to the frame at the end of the step, where their change matters; else empty.
  virtual VectorXd node_velocities(const VectorXd& unknowns) const = 0;
  /// Of the branch in series (docs/theory-time.md, eq:branch) at the end of the step, and at rest.
  virtual VectorXd branch_metric(const Bulk&, const VectorXd& unknowns) const = 0;
  virtual VectorXd unstressed_branch() const = 0;

  /// How far the nodes have to move such that the wall is at `wall(x)`, in the units of WallTable, with these unknowns.
  virtual VectorXd wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const = 0;
  /// With the cell displaced along its offset by `aside` from its place in the mesh.
  virtual void move_nodes(const VectorXd& outward, double aside) = 0;

  /// Place of the cell's barycentre in the frame.
  virtual double barycentre(const VectorXd& unknowns) const = 0;
  /// Displaces the cell's nodes as an even stretch along the flow does that keeps the volume.
  virtual void stretch_sphere(double stretch, VectorXd& unknowns) const = 0;
};

std::unique_ptr<MovingDiscrete> moving_tube(const Problem&, const Resolution&);
/// Without inertia; `Section::tube` in three dimensions, to compare.
std::unique_ptr<MovingDiscrete> moving_duct(const Problem&, const Resolution&);
/// Of the section.
std::unique_ptr<MovingDiscrete> moving_discrete(const Problem&, const Resolution&);

}  // namespace rheocyte
