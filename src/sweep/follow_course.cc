#include "sweep/follow_course.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "case/scales.h"
#include "solve/transient.h"

namespace rheocyte {

namespace {

/// Of the surface's positions in each step: a tenth of what the table's mesh is asked for.
constexpr double time_accuracy_of_mesh = 0.1;

struct Seen {
  double position;
  Eigen::RowVectorXd value;
};

Eigen::RowVectorXd row_of(const TimeFrame& frame, double sphere_area) {
  Eigen::RowVectorXd row(course_measures);
  const ShapeMeasures& shape = frame.state.shape;
  row << shape.deformation, shape.area / sphere_area, shape.inertia_ratio, shape.modes[0], shape.modes[1],
      shape.modes[2], shape.modes[3], shape.modes[4], shape.modes[5], frame.state.cell_velocity, frame.time;
  return row;
}

TimeRun run_of(const DynamicSpec& spec, const Case& c, double unit_um) {
  TimeRun run;
  run.end = HUGE_VAL;
  run.end_position = *c.time.end_um / unit_um;
  run.outputs_by_place = true;
  run.output_every = *c.time.output_every_um / unit_um;
  run.first_output = (end_of_contraction_um(c) + spec.first_um) / unit_um;
  run.mesh_accuracy = c.time.mesh_accuracy.value_or(1e-3);
  run.accuracy = c.time.accuracy.value_or(time_accuracy_of_mesh * run.mesh_accuracy);
  run.degree = int(c.time.degree.value_or(0));
  return run;
}

/// The outputs at the table's places; behind the place at which a cell has settled its shape stays.
Eigen::MatrixXd at_places(const std::vector<Seen>& seen, const TimeRun& run, int places) {
  Eigen::MatrixXd value(places, course_measures);
  constexpr int velocity = int(CourseMeasure::velocity), time = int(CourseMeasure::time);
  for (int i = 0; i < places; ++i) {
    const double wanted = run.first_output + i * run.output_every;
    const auto found = std::ranges::find_if(
        seen, [&](const Seen& s) { return std::abs(s.position - wanted) < 1e-3 * run.output_every; });
    const Seen& from = found == seen.end() ? seen.back() : *found;
    value.row(i) = from.value;
    value(i, time) += (wanted - from.position) / from.value(velocity);
  }
  return value;
}

std::string told_of_margin(double margin, const Problem& problem) {
  return fmt::format(
      " Downstream of the contraction its {} (stability_margin {:.2g}), which the model does not follow; {}",
      surface_kind(problem) == SurfaceKind::held ? "cortex has lost its resistance to compression"
                                                 : "surface is beyond the limit against short wrinkles",
      margin, ways_to_stability(surface_kind(problem), true));
}

}  // namespace

CellCourse follow_course(const DynamicSpec& spec, const DynamicCell& cell, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  const Case c = case_of(spec, cell);
  const Problem problem = problem_of(c);
  const TimeRun run = run_of(spec, c, unit_length_um(c));
  const double sphere_area = std::numbers::pi * problem.radius_ratio * problem.radius_ratio;
  std::vector<Seen> seen;
  double least_margin = 1;
  const auto note = [&](const TimeFrame& frame) {
    if (frame.position <= 0) return;
    seen.push_back({frame.position, row_of(frame, sphere_area)});
    least_margin = std::min(least_margin, frame.state.stability_margin);
  };
  const StationaryState end = transient(problem, run, {.frame = note, .step = {}}, nullptr, stop);
  CellCourse course{cell, judged(end.outcome.status, {.stability_margin = least_margin}), end.outcome.message, {}};
  if (course.status != end.outcome.status) course.message += told_of_margin(least_margin, problem);
  if (course.status == Status::converged) course.value = at_places(seen, run, spec.places);
  course.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return course;
}

}  // namespace rheocyte
