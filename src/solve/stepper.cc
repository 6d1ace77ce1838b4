#include "solve/stepper.h"

#include <algorithm>
#include <cmath>

#include "numeric/roots.h"
#include "solve/rigid_start.h"

namespace rheocyte {

Stepper::Stepper(const Problem& problem, const Resolution& resolution)
    : problem_(with_elastic_interior(problem)), resolution_(resolution), media_(problem_) {}

bool Stepper::has_passed_walls(const TimeLevel& level) const {
  const WallTable& wall = problem_.wall;
  return wall.is_straight() || level.position - discrete().half_length() >= last_change(wall);
}

double Stepper::time_at(double position) const {
  const double time = now().time, next = time + state_.next_step;
  if (position > now().place()) {
    if (!(next_position(next) > position)) return HUGE_VAL;
    return bracketed_root([&](double t) { return next_position(t) - position; }, time, next);
  }
  if (state_.levels.size() < 2) return time;
  const double before = std::min(state_.levels[1].time, time);
  return bracketed_root([&](double t) { return level_at(t).place() - position; }, before, time);
}

}  // namespace rheocyte
