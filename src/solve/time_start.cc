#include "solve/time_start.h"

namespace rheocyte {

TimeState at_time_zero(const Discretisation& space, const TimeState& state, const UnitChange& units) {
  TimeLevel level = state.levels.front();
  level.time = level.position = level.frame_acceleration = 0;
  level.velocities *= units.velocity;
  level.unknowns *= units.stress;  // pressures; the others follow
  const VectorXd& old = state.levels.front().unknowns;
  for (int i = 0; i < 2 * space.nodes().count; ++i) {
    if (const int u = space.displacement(i / 2, i % 2); u >= 0) level.unknowns(u) = old(u);
    if (const int u = space.velocity(i / 2, i % 2).unknown; u >= 0) level.unknowns(u) = units.velocity * old(u);
  }
  TimeState start;
  start.levels = {level};
  start.resolution = state.resolution;
  return start;
}

}  // namespace rheocyte
