// What Newton's method and the continuation know of a discretised problem, in whatever dimension it is.
#pragma once
#include <Eigen/Core>

#include "fem/work_meter.h"
#include "laws/media.h"

namespace rheocyte {

class NonlinearSystem {
 public:
  NonlinearSystem() = default;
  virtual ~NonlinearSystem() = default;
  NonlinearSystem(const NonlinearSystem&) = delete;
  NonlinearSystem& operator=(const NonlinearSystem&) = delete;

  /// The unstressed sphere in a liquid at rest, moving with the mean speed of the flow.
  virtual Eigen::VectorXd sphere() const = 0;

  /// Residual of all equations; `min_det` is set to the least relative det of the mesh.
  virtual Eigen::VectorXd residual(const Media&, const Eigen::VectorXd& unknowns, double& min_det) = 0;
  /// The same, and the tangent factorised. False in `factorised` if the tangent is singular or not finite.
  virtual Eigen::VectorXd linearise(const Media&, const Eigen::VectorXd& unknowns, double& min_det,
                                    bool& factorised) = 0;
  /// Solves with the tangent of the last `linearise`.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& rhs) = 0;

  /// Radius of the cell at rest.
  virtual double cell_radius() const = 0;
  /// Largest displacement component of the cell's nodes.
  virtual double largest_displacement(const Eigen::VectorXd& unknowns) const = 0;
  /// Multiplies the displacements alone.
  virtual void scale_displacement(double factor, Eigen::VectorXd& unknowns) const = 0;
  /// Greatest relative difference of the surface's stretch between two states.
  virtual double stretch_change(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const = 0;

  const WorkMeter& work() const { return work_; }

 protected:
  WorkMeter work_;
};

}  // namespace rheocyte
