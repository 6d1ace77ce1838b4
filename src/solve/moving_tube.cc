#include <cmath>

#include "fem/moving_system.h"
#include "solve/moving_of.h"
#include "solve/tube.h"

namespace rheocyte {
namespace {

/// The barycentre is held at x = 0.
class MovingTube final : public MovingOf<TubeDiscrete, MovingSystem> {
 public:
  MovingTube(const Problem& problem, const Resolution& resolution)
      : MovingOf([&] { return TubeDiscrete(problem, resolution); },
                 [](const TubeDiscrete& discrete) { return MovingSystem(discrete.space()); }) {}

  std::vector<int> surface_unknowns() const override { return displacements_of(space().surface(), 2); }
  VectorXd node_velocities(const VectorXd& unknowns) const override {
    return moving_system().node_velocities(unknowns);
  }

  double barycentre(const VectorXd&) const override { return 0; }
  void move_nodes(const VectorXd& outward, double) override { discrete_.space().move_nodes(outward); }
  void stretch_sphere(double stretch, VectorXd& unknowns) const override {
    const double factors[] = {stretch, 1 / std::sqrt(stretch)};
    for (int i = 0; i < 2 * space().nodes().count; ++i) {
      const int u = space().displacement(i / 2, i % 2);
      if (u >= 0) unknowns(u) = (factors[i % 2] - 1) * space().node_points()[i / 2](i % 2);
    }
  }
};

}  // namespace

std::unique_ptr<MovingDiscrete> moving_tube(const Problem& problem, const Resolution& resolution) {
  return std::make_unique<MovingTube>(problem, resolution);
}

}  // namespace rheocyte
