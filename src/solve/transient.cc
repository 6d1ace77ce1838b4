#include "solve/transient.h"

#include <algorithm>
#include <utility>

#include "solve/time_errors.h"
#include "solve/time_follower.h"
#include "solve/time_resolution.h"

namespace rheocyte {
namespace {

/// Deformations below this have errors relative to it: what steps resolve no better, and never one that cells have.
constexpr double max_deformation_floor = 0.01;

/// So many elements along the surface, and as large ones as fit to them elsewhere.
Subdivision fine_subdivision(int surface_elements) {
  const int front = (surface_elements + 3) / 4;
  return {front, 2 * front, std::max(1, front / 8), 4};
}

Resolution resolution_of(const Problem& problem, const TimeRun& run, const WorkLimits& limits) {
  Resolution resolution = usual_time_resolution_of(problem);
  if (run.degree > 0) resolution.degree = run.degree;
  if (run.scheme == TimeScheme::partitioned && run.surface_elements > 0)
    resolution.subdivision = fine_subdivision(run.surface_elements);
  return is_mesh_given(run) ? resolution : resolution_in_time(problem, run.mesh_accuracy, limits);
}

/// Notes what the observer sees, too.
TimeObserver noting(TimeWay& way, TimeObserver observer) {
  observer.frame = [&way, show = observer.frame](const TimeFrame& frame) {
    way.outputs.push_back({.time = frame.time, .position = frame.position, .state = frame.state});
    if (show) show(frame);
  };
  observer.step = [&way, show = observer.step](const TimePoint& point, const TimeState& state) {
    way.steps.push_back(point);
    if (show) show(point, state);
  };
  return observer;
}

}  // namespace

StationaryState transient(const Problem& problem, const TimeRun& run, const TimeObserver& observer,
                          const TimeStart* from, const WorkLimits& limits) {
  const Resolution resolution = from ? from->state.resolution : resolution_of(problem, run, limits);
  // What begins with the state of another case cannot be followed again.
  const bool estimates = run.estimates_error && !(from && from->units);
  TimeWay way = from ? from->before : TimeWay{};
  TimeFollower follower(problem, run, resolution, estimates ? noting(way, observer) : observer, limits);
  StationaryState result = follower.follow(from);
  if (!is_mesh_given(run)) result.deformation_floor = std::min(run.accuracy / run.mesh_accuracy, max_deformation_floor);
  if (!estimates || result.outcome.status != Status::converged) return result;
  const FollowedRun followed{problem, run, resolution, std::move(way), follower.has_settled(), follower.is_at_place()};
  const TimeWay errors = estimate_errors(followed, limits, result);
  if (observer.errors && !errors.steps.empty()) observer.errors(errors);
  return result;
}

}  // namespace rheocyte
