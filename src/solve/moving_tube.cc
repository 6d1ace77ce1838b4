#include <cmath>

#include "fem/moving_system.h"
#include "solve/moving_discrete.h"
#include "solve/tube.h"

namespace rheocyte {
namespace {

/// The barycentre is held at x = 0.
class MovingTube final : public MovingDiscrete {
 public:
  MovingTube(const Problem& problem, const Resolution& resolution)
      : discrete_(problem, resolution), system_(discrete_.space()) {}

  const Discrete& discrete() const override { return discrete_; }
  NonlinearSystem& system() override { return system_; }
  const NonlinearSystem& system() const override { return system_; }
  int cell_velocity() const override { return space().cell_velocity(); }
  std::vector<int> surface_unknowns() const override {
    std::vector<int> unknowns;
    for (const BoundaryEdge& edge : space().surface()) {
      for (const int node : edge.nodes) {
        for (int c = 0; c < 2; ++c) {
          if (const int unknown = space().displacement(node, c); unknown >= 0) unknowns.push_back(unknown);
        }
      }
    }
    return unknowns;
  }

  void set_motion(const Motion& motion) override { system_.set_motion(motion); }
  VectorXd node_velocities(const VectorXd& unknowns) const override { return system_.node_velocities(unknowns); }
  VectorXd branch_metric(const Bulk& bulk, const VectorXd& unknowns) const override {
    return system_.branch_metric(bulk, unknowns);
  }
  VectorXd unstressed_branch() const override { return system_.unstressed_branch(); }

  VectorXd wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const override {
    return space().wall_motion(wall, unknowns);
  }
  void move_nodes(const VectorXd& outward) override { discrete_.space().move_nodes(outward); }

  double barycentre(const VectorXd&) const override { return 0; }
  void stretch_sphere(double stretch, VectorXd& unknowns) const override {
    const double factors[] = {stretch, 1 / std::sqrt(stretch)};
    for (int i = 0; i < 2 * space().nodes().count; ++i) {
      const int u = space().displacement(i / 2, i % 2);
      if (u >= 0) unknowns(u) = (factors[i % 2] - 1) * space().node_points()[i / 2](i % 2);
    }
  }

 private:
  const Discretisation& space() const { return discrete_.space(); }

  TubeDiscrete discrete_;
  MovingSystem system_;
};

}  // namespace

std::unique_ptr<MovingDiscrete> moving_tube(const Problem& problem, const Resolution& resolution) {
  return std::make_unique<MovingTube>(problem, resolution);
}

}  // namespace rheocyte
