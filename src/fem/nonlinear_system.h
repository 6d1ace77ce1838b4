// What Newton's method and the continuation know of a discretised problem, in whatever dimension it is.
#pragma once
#include <Eigen/Core>
#include <cstddef>

#include "fem/work_limits.h"
#include "fem/work_meter.h"
#include "laws/media.h"

namespace rheocyte {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Residual of all equations.
struct Residual {
  VectorXd value;
  double min_det = 0;  ///< least relative det of the mesh; <= 0: folded
};

class NonlinearSystem {
 public:
  NonlinearSystem() = default;
  virtual ~NonlinearSystem() = default;
  NonlinearSystem(const NonlinearSystem&) = delete;
  NonlinearSystem& operator=(const NonlinearSystem&) = delete;

  /// The unstressed sphere in a liquid at rest, moving with the mean speed of the flow.
  virtual VectorXd sphere() const = 0;

  virtual Residual residual(const Media&, const VectorXd& unknowns) = 0;
  /// The same, and the tangent factorised; without factors afterwards if it is singular or not finite.
  virtual Residual linearise(const Media&, const VectorXd& unknowns) = 0;
  /// With its factors.
  virtual VectorXd solve(const VectorXd& rhs) = 0;
  /// Of several right-hand sides.
  virtual MatrixXd solve_columns(const MatrixXd& rhs) = 0;

  /// Radius of the cell at rest.
  virtual double cell_radius() const = 0;
  /// Largest displacement component of the cell's nodes.
  virtual double largest_displacement(const VectorXd& unknowns) const = 0;
  /// Multiplies the displacements alone.
  virtual void scale_displacement(double factor, VectorXd& unknowns) const = 0;
  /// Greatest relative difference of the surface's stretch between two states.
  virtual double stretch_change(const VectorXd& from, const VectorXd& to) const = 0;

  /// Of the factors and tables that it holds, about.
  virtual std::size_t memory_bytes() const = 0;
  /// Whether it can solve, with the tangent of the last `linearise`.
  bool has_factors() const { return has_factors_; }
  /// Frees their memory.
  virtual void drop_factors() = 0;
  /// From now on: once it is to stop `linearise` may give up, with numbers that are not finite; `residual` and
  /// `linearise` take as many threads as are allowed and as their work pays for.
  void obey(const WorkLimits& limits) { limits_ = limits; }

  const WorkMeter& work() const { return work_; }

 protected:
  WorkMeter work_;
  bool has_factors_ = false;
  WorkLimits limits_;
};

}  // namespace rheocyte
