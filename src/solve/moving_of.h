// What tube and duct have in common when a cell moves along them.
#pragma once
#include <vector>

#include "solve/moving_discrete.h"

namespace rheocyte {

/// `DiscreteKind` describes the states, `System` is that of one step in time on its space.
template <class DiscreteKind, class System>
class MovingOf : public MovingDiscrete {
 public:
  const Discrete& discrete() const final { return discrete_; }
  NonlinearSystem& system() final { return system_; }
  const NonlinearSystem& system() const final { return system_; }
  int cell_velocity() const final { return space().cell_velocity(); }

  void set_motion(const Motion& motion) final { system_.set_motion(motion); }
  VectorXd branch_metric(const Bulk& bulk, const VectorXd& unknowns) const final {
    return system_.branch_metric(bulk, unknowns);
  }
  VectorXd unstressed_branch() const final { return system_.unstressed_branch(); }

  VectorXd wall_motion(const std::function<double(double)>& wall, const VectorXd& unknowns) const final {
    return space().wall_motion(wall, unknowns);
  }

 protected:
  template <class MakeDiscrete, class MakeSystem>
  MovingOf(const MakeDiscrete& make_discrete, const MakeSystem& make_system)
      : discrete_(make_discrete()), system_(make_system(discrete_)) {}

  const auto& space() const { return discrete_.space(); }
  const System& moving_system() const { return system_; }

  /// Displacements of the nodes of parts of the surface, in as many directions.
  template <class Parts>
  std::vector<int> displacements_of(const Parts& parts, int directions) const {
    std::vector<int> unknowns;
    for (const auto& part : parts) {
      for (const int node : part.nodes) {
        for (int c = 0; c < directions; ++c) {
          if (const int unknown = space().displacement(node, c); unknown >= 0) unknowns.push_back(unknown);
        }
      }
    }
    return unknowns;
  }

  DiscreteKind discrete_;

 private:
  System system_;
};

}  // namespace rheocyte
