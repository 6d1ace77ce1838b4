// The tube: axially symmetric cells, stationary or on their way.
#pragma once
#include <memory>

#include "fem/observe.h"
#include "fem/stationary_system.h"
#include "solve/discrete.h"
#include "solve/geometry.h"

namespace rheocyte {

/// The channel of a problem. Where its wall is not straight the mesh goes on beyond it.
inline ChannelGeometry geometry_of(const Problem& problem) {
  return ChannelGeometry(problem.radius_ratio, problem.channel_length, run_out(problem.wall));
}

class TubeDiscrete final : public Discrete {
 public:
  TubeDiscrete(const Problem&, const Resolution&);

  Discretisation& space() { return space_->of_mesh; }
  const Discretisation& space() const { return space_->of_mesh; }
  StationarySystem& system() override { return system_; }
  const StationarySystem& system() const { return system_; }
  double half_length() const override { return space().mesh().geometry().end(); }

  Contour contour(const Problem&, const VectorXd& unknowns) const override;
  double stability_margin(const Problem&, const VectorXd& unknowns) const override;
  bool is_wrinkled(const Problem&, const VectorXd& unknowns) const override;
  StateNumbers numbers(const Problem&, const VectorXd& unknowns) const override;
  void describe(const Problem&, const VectorXd& unknowns, StationaryState&) const override;
  VectorXd transfer_from(const Discrete& other, const VectorXd& unknowns) const override;
  VectorXd carry_from(const Discrete& other, const VectorXd& unknowns) const override;
  void move_to(const Problem&) override;

 private:
  struct Space {
    Space(const Problem&, const Resolution&, const SurfaceBreaks&);
    std::shared_ptr<const ChannelMesh> mesh;
    Discretisation of_mesh;
  };
  TubeDiscrete(const Problem&, const Resolution&, const SurfaceBreaks&);
  /// At the same resolution, cut so, with nodes of the liquid as those of another one.
  std::shared_ptr<TubeDiscrete> with(const SurfaceBreaks&, const Discretisation& points_as) const;
  double mesh_quality(const VectorXd& unknowns) const override;
  double surface_evenness(const VectorXd& unknowns) const override;
  std::shared_ptr<Discrete> made_as(const Discrete& other) const override;
  std::shared_ptr<Discrete> cut_again(const VectorXd& unknowns, double evenly) const override;
  void fit(const VectorXd& unknowns) override;
  void set_points(const std::vector<Point>&);

  Problem problem_;               ///< that it was made for
  std::shared_ptr<Space> space_;  ///< with those who write its fields later
  StationarySystem system_;
};

/// What numbers are read off: the unknowns of a problem.
struct StateView {
  const Problem& problem;
  const Discretisation& space;
  const VectorXd& unknowns;
};

/// All numbers of a state, with its contour and its surface as finely as requested.
StateNumbers numbers_of(const StateView&, const Contour&, const SurfaceState&);

/// Of the elements along the surface in a liquid.
Spacing spacing_for(const Liquid&);

/// Of a cell in a tube, and of its search.
Geometry tube_geometry(const Problem&);

}  // namespace rheocyte
