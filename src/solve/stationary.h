// The stationary shape of one cell: from the sphere to the requested state by itself (docs/theory.md, sec. 4).
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/problem.h"
#include "fem/sampled_fields.h"
#include "fem/work_limits.h"
#include "fem/work_meter.h"
#include "shape/contour.h"
#include "solve/number_errors.h"
#include "state/outcome.h"

namespace rheocyte {

/// Where the time went and how large the systems were.
struct SolveStatistics : WorkMeter {
  int unknowns = 0;           ///< of the finest system
  int newton_iterations = 0;  ///< over all continuation steps and meshes
  int continuation_steps = 0;
  int degree = 0;  ///< polynomial degree of the finest system
  int elements = 0;
  double total_s = 0;  ///< wall time, set-up included

  using WorkMeter::operator+=;
  /// Adds the work of a later solution, whose system becomes the finest one.
  SolveStatistics& operator+=(const SolveStatistics& later) {
    WorkMeter::operator+=(later);
    newton_iterations += later.newton_iterations;
    continuation_steps += later.continuation_steps;
    total_s += later.total_s;
    unknowns = later.unknowns, degree = later.degree, elements = later.elements;
    return *this;
  }
};

/// One step along the branch, for progress and for later use.
struct BranchStep {
  double compliance;  ///< requested modulus / modulus of this step: 0 = rigid, 1 = the requested state
  double deformation;
  int newton_iterations;
  int degree;  ///< polynomial degree at which it was found
};

/// The surface at equidistant parameters of each piece of the contour, both ends included, front pole first. Columns:
/// meridional, hoop.
struct SurfaceProfile {
  static constexpr int points_per_piece = 33;
  Eigen::VectorXd rest_angle;  ///< where the point was on the unstressed sphere, from the flow direction, in radians
  Eigen::MatrixX2d point;      ///< (x, r), in R
  Eigen::MatrixX2d stretch;
  Eigen::MatrixX2d tension;    ///< principal Cauchy tensions of the cortex, surface tension included, in S R
  Eigen::MatrixX2d curvature;  ///< in 1/R; both 1/a for a sphere of radius a

  /// Of its points, each once: the first one of a piece is the last one of the piece before.
  std::vector<Eigen::Index> distinct_rows() const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < point.rows(); ++i)
      if (i == 0 || i % points_per_piece != 0) rows.push_back(i);
    return rows;
  }
};

/// What one sees of a cell in a duct from one of the directions of its symmetry.
struct DuctView {
  std::string_view name;  ///< "side", "diagonal", "across"
  SurfaceProfile surface;
};

/// Everything that is known of a stationary state; dimensionless, in the units of case/problem.h.
struct StationaryState : StateNumbers {
  Outcome outcome;
  Contour contour;  ///< barycentre at x = 0; in a duct the silhouette that the camera sees
  /// In a duct, between its pieces: places on the undeformed cell (DuctMesh::surface_places).
  std::vector<double> contour_places;
  SurfaceProfile surface;
  Eigen::MatrixX2d offset_outline;    ///< of a cell off the axis, in the plane of its offset; else empty
  std::vector<DuctView> views;        ///< along the height, and along diagonal (square channel) or width
  double residual = no_value;         ///< of the last Newton iteration, relative to the driving forces
  double estimated_error = no_value;  ///< of the deformation, relative to it or to the floor below which it is
  double step_error = no_value;       ///< that of the steps in time in it
  double deformation_floor = 0;
  StateNumbers errors = unknown_numbers();  ///< of the numbers, each in its unit; not a number: not known
  /// In time, how the same run with other steps or on another mesh ended, which gives the error; not_started: there
  /// was none.
  Status comparison = Status::not_started;
  SolveStatistics statistics;
  std::vector<BranchStep> branch;
  /// Writes fields.vtu (velocity, pressure, stress, displacement on the deformed mesh, high-order cells) in
  /// physical units (um, m/s, Pa); false if that failed.
  std::function<bool(const std::string& path, const Scales&)> write_fields;
  /// The same for a picture, in about so many points; places as in the contour.
  std::function<SampledFields(const Scales&, int points)> sample_fields;
};

/// A problem one parameter away from another one.
struct LinePoint {
  double change = 0;  ///< of the parameter
  double weight = 0;  ///< derivative = sum of weight * value, over the points
  Problem problem = {};
  StationaryState state = {};  ///< to first order in the parameter
};

/// Around a problem, one parameter changed: the points of a formula of finite differences of second order.
using ProblemLine = std::vector<LinePoint>;

/// Called after each continuation step.
using ProgressCallback = std::function<void(const BranchStep&)>;

/// Solves the problem from the unstressed sphere. Never throws for a numerical failure: the state then holds the
/// last converged shape on the branch and the outcome says why it stopped. A stop is looked for once an iteration.
/// Lines around the problem are followed from a converged state of a cell whose place is given; those that cannot be
/// are empty afterwards.
StationaryState solve_stationary(const Problem&, const ProgressCallback& = {}, const WorkLimits& limits = {},
                                 std::span<ProblemLine> = {});

}  // namespace rheocyte
