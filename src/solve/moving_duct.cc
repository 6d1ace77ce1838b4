#include <cmath>

#include "duct/moving_duct_system.h"
#include "solve/duct.h"
#include "solve/moving_of.h"

namespace rheocyte {
namespace {

/// A node near the cell's middle is held at its place; off the axis the frame moves along the offset, too.
class MovingDuct final : public MovingOf<DuctDiscrete, MovingDuctSystem> {
 public:
  MovingDuct(const Problem& problem, const Resolution& resolution)
      : MovingOf([&] { return DuctDiscrete(problem, subdivision_of(problem), resolution.degree); },
                 [&](const DuctDiscrete& discrete) {
                   return MovingDuctSystem(discrete.space(), discrete.system().drop(), problem.cortex.bending > 0);
                 }),
        first_aside_(problem.offset - space().mesh().geometry().shape().offset) {}

  int drift() const override { return space().drift(); }
  double first_aside() const override { return first_aside_; }
  void move_nodes(const VectorXd& outward, double aside) override { discrete_.space().move_nodes(outward, aside); }
  std::vector<int> surface_unknowns() const override { return displacements_of(surface_faces(space()), 3); }
  VectorXd node_velocities(const VectorXd&) const override { return {}; }

  double barycentre(const VectorXd& unknowns) const override {
    return cell_volume(space(), moving_system().element(), unknowns).barycentre;
  }
  void stretch_sphere(double stretch, VectorXd& unknowns) const override {
    const double across = 1 / std::sqrt(stretch), factors[] = {stretch, across, across};
    const double held = space().node_points()[space().fixed_node()](0);
    for (int i = 0; i < 3 * space().nodes().count; ++i) {
      const int c = i % 3, u = space().displacement(i / 3, c);
      if (u >= 0) unknowns(u) = (factors[c] - 1) * (space().node_points()[i / 3](c) - (c == 0 ? held : 0));
    }
  }

 private:
  double first_aside_;
};

}  // namespace

std::unique_ptr<MovingDiscrete> moving_duct(const Problem& problem, const Resolution& resolution) {
  return std::make_unique<MovingDuct>(problem, resolution);
}

std::unique_ptr<MovingDiscrete> moving_discrete(const Problem& problem, const Resolution& resolution) {
  return is_duct(problem.section) ? moving_duct(problem, resolution) : moving_tube(problem, resolution);
}

}  // namespace rheocyte
