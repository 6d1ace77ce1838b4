#include <cmath>

#include "duct/moving_duct_system.h"
#include "solve/duct.h"
#include "solve/moving_discrete.h"

namespace rheocyte {
namespace {

/// A node near the cell's middle is held at its place.
class MovingDuct final : public MovingDiscrete {
 public:
  MovingDuct(const Problem& problem, const Resolution& resolution)
      : discrete_(problem, subdivision_of(problem), resolution.degree),
        system_(space(), discrete_.system().drop(), problem.cortex.bending > 0) {}

  const Discrete& discrete() const override { return discrete_; }
  NonlinearSystem& system() override { return system_; }
  const NonlinearSystem& system() const override { return system_; }
  int cell_velocity() const override { return space().cell_velocity(); }
  std::vector<int> surface_unknowns() const override {
    std::vector<int> unknowns;
    for (const SurfaceFace& face : surface_faces(space())) {
      for (const int node : face.nodes) {
        for (int c = 0; c < 3; ++c) {
          if (const int unknown = space().displacement(node, c); unknown >= 0) unknowns.push_back(unknown);
        }
      }
    }
    return unknowns;
  }

  void set_motion(const Motion& motion) override { system_.set_motion(motion); }
  VectorXd node_velocities(const VectorXd&) const override { return {}; }
  VectorXd branch_metric(const Bulk& bulk, const VectorXd& unknowns) const override {
    return system_.branch_metric(bulk, unknowns);
  }
  VectorXd unstressed_branch() const override { return system_.unstressed_branch(); }

  VectorXd wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const override {
    return space().wall_motion(wall, unknowns);
  }
  void move_nodes(const VectorXd& outward) override { discrete_.space().move_nodes(outward); }

  double barycentre(const VectorXd& unknowns) const override {
    return cell_volume(space(), system_.element(), unknowns).barycentre;
  }
  void stretch_sphere(double stretch, VectorXd& unknowns) const override {
    const double across = 1 / std::sqrt(stretch), factors[] = {stretch, across, across};
    const double held = space().node_points()[space().held_node()](0);
    for (int i = 0; i < 3 * space().nodes().count; ++i) {
      const int c = i % 3, u = space().displacement(i / 3, c);
      if (u >= 0) unknowns(u) = (factors[c] - 1) * (space().node_points()[i / 3](c) - (c == 0 ? held : 0));
    }
  }

 private:
  const DuctSpace& space() const { return discrete_.space(); }

  DuctDiscrete discrete_;
  MovingDuctSystem system_;
};

}  // namespace

std::unique_ptr<MovingDiscrete> moving_duct(const Problem& problem, const Resolution& resolution) {
  return std::make_unique<MovingDuct>(problem, resolution);
}

std::unique_ptr<MovingDiscrete> moving_discrete(const Problem& problem, const Resolution& resolution) {
  return is_duct(problem.section) ? moving_duct(problem, resolution) : moving_tube(problem, resolution);
}

}  // namespace rheocyte
