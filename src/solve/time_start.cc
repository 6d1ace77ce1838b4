#include "solve/time_start.h"

#include "duct/duct_space.h"

namespace rheocyte {

template <class Space>
TimeState at_time_zero(const Space& space, int directions, const TimeState& state, const UnitChange& change) {
  TimeLevel level = state.levels.front();
  level.time = level.frame_acceleration = 0;
  level.position = 0 - level.barycentre;  // the cell's place is 0
  level.velocities *= change.velocity;
  level.unknowns *= change.stress;  // pressures; the others follow
  const VectorXd& old = state.levels.front().unknowns;
  for (int i = 0; i < directions * space.nodes().count; ++i) {
    const int node = i / directions, c = i % directions;
    if (const int u = space.displacement(node, c); u >= 0) level.unknowns(u) = old(u);
    if (const int u = space.velocity(node, c).unknown; u >= 0) level.unknowns(u) = change.velocity * old(u);
  }
  if constexpr (requires { space.spin(); })
    if (const int u = space.spin(); u >= 0) level.unknowns(u) = change.velocity * old(u);
  TimeState start;
  start.levels = {level};
  start.resolution = state.resolution;
  return start;
}

template TimeState at_time_zero(const Discretisation&, int, const TimeState&, const UnitChange&);
template TimeState at_time_zero(const DuctSpace&, int, const TimeState&, const UnitChange&);

}  // namespace rheocyte
