// A solver for tests of the program around it: it "converges" at once, or fails in the way that the environment's
// RHEOCYTE_TEST_SOLVER names. It solves nothing.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "shape/curve.h"
#include "solve/stationary.h"
#include "solve/transient.h"

namespace rheocyte {

namespace {

std::string wanted_failure() {
  const char* name = std::getenv("RHEOCYTE_TEST_SOLVER");
  return name ? name : "";
}

// A half circle as four pieces of degree 4.
Contour sphere(double radius) {
  Contour contour;
  const auto& nodes = lobatto_nodes(4);
  for (int piece = 0; piece < 4; ++piece) {
    CurvePiece points(nodes.size(), 2);
    for (Eigen::Index i = 0; i < nodes.size(); ++i) {
      const double angle = (piece + nodes(i)) * std::acos(-1.0) / 4;
      points.row(i) << radius * std::cos(angle), radius * std::sin(angle);
    }
    contour.pieces.push_back(points);
  }
  return contour;
}

SurfaceProfile surface_of_sphere(double radius) {
  const Eigen::Index points = 4 * SurfaceProfile::points_per_piece;
  SurfaceProfile surface{Eigen::VectorXd::LinSpaced(points, 0, std::acos(-1.0)), Eigen::MatrixX2d(points, 2),
                         Eigen::MatrixX2d::Ones(points, 2), Eigen::MatrixX2d::Zero(points, 2),
                         Eigen::MatrixX2d::Constant(points, 2, 1 / radius)};
  surface.point << radius * surface.rest_angle.array().cos(), radius * surface.rest_angle.array().sin();
  return surface;
}

bool write_some_fields(const std::string& path, const Scales&) {
  const auto failure = wanted_failure();
  if (failure == "fields-throw") throw std::runtime_error("the writer\nhas failed");
  std::ofstream file(path);
  file << "<VTKFile>\n" << std::string(20000, ' ');
  if (failure != "fields-cut") file << "</VTKFile>\n";
  return failure != "fields-false";
}

Outcome outcome_of(const std::string& failure) {
  for (const Status status :
       {Status::iteration_limit, Status::mesh_folded, Status::surface_unstable, Status::branch_ended,
        Status::singular_matrix, Status::not_finite, Status::accuracy_not_reached, Status::stopped})
    if (failure == name(status)) return {status, "It failed at E = 1.2 kPa; try a larger modulus.", 0.5};
  return {Status::converged, "Converged.", 1};
}

// As the true solver does: polls, and keeps the last state.
Outcome wait_for_stop(const WorkLimits& limits) {
  for (int i = 0; i < 2000 && !limits.is_stopped(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return {Status::stopped, "Stopped by a signal.", 0.5};
}

}  // namespace

StationaryState solve_stationary(const Problem& problem, const ProgressCallback& progress, const WorkLimits& limits,
                                 std::span<ProblemLine>) {
  const auto failure = wanted_failure();
  if (failure == "throw") throw std::logic_error("a bug\nof the solver");
  StationaryState state;
  state.branch = {{0, 0, 3, 4}, {0.5, 0.01, 4, 4}};
  if (progress)
    for (const auto& point : state.branch) progress(point);
  state.outcome = failure == "slow" ? wait_for_stop(limits) : outcome_of(failure);
  state.contour = sphere(problem.radius_ratio);
  state.surface = surface_of_sphere(problem.radius_ratio);
  state.shape = measure(state.contour);
  state.cell_velocity = 1.5;
  state.volume_of_revolution = state.shape.volume;
  state.flow_rate = 1;
  state.volume_flow = 3;
  state.reynolds = state.stability_margin = state.min_tension = state.shear_rate_max = 0;
  state.pressure_drop = 30;
  state.additional_pressure_drop = 1;
  state.channel_length = 3.5;
  state.relative_volume_change = 0;
  state.min_meridional_stretch = state.biot_ratio = 1;
  state.residual = state.estimated_error = 1e-12;
  if (failure == "nan") state.pressure_drop = std::numeric_limits<double>::quiet_NaN();
  state.write_fields = write_some_fields;
  return state;
}

/// In time nothing fails on demand: one state, no step.
StationaryState transient(const Problem& problem, const TimeRun&, const TimeObserver&, const TimeStart*,
                          const WorkLimits& limits) {
  return solve_stationary(problem, {}, limits);
}

}  // namespace rheocyte
