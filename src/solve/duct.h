// Ducts in three dimensions: what is reported of a state, and the numbers of its search (docs/theory-square.md).
#pragma once
#include <memory>

#include "duct/duct_system.h"
#include "duct/observe_duct.h"
#include "solve/discrete.h"
#include "solve/geometry.h"

namespace rheocyte {

/// The duct as the mesh has it: a cell off the axis is so along y, which the camera's direction becomes.
DuctShape shape_of(const Problem&);
Symmetry symmetry_of(const Problem&);
DuctSubdivision subdivision_of(const Problem&);

/// Factors of high degrees are large.
class DuctDiscrete final : public Discrete {
 public:
  DuctDiscrete(const Problem& problem, const DuctSubdivision& subdivision, int degree)
      : DuctDiscrete(problem, subdivision, degree, symmetry_of(problem)) {}
  DuctDiscrete(const Problem& problem, const DuctSubdivision& subdivision, int degree, Symmetry symmetry)
      : DuctDiscrete(problem, subdivision, {{}, degree}, symmetry, side_breaks(subdivision)) {}
  DuctDiscrete(const Problem&, const DuctSubdivision&, const Resolution&, Symmetry,
               const std::vector<double>& side_breaks);

  DuctSpace& space() { return *space_; }
  const DuctSpace& space() const { return *space_; }
  DuctSystem& system() override { return *system_; }
  const DuctSystem& system() const { return *system_; }
  double half_length() const override { return space().mesh().geometry().end(); }

  Contour contour(const Problem&, const VectorXd& unknowns) const override;
  /// By the least principal stretch and tension anywhere (docs/theory-square.md, eq:square-biot).
  double stability_margin(const Problem&, const VectorXd& unknowns) const override;
  bool is_wrinkled(const Problem&, const VectorXd& unknowns) const override;
  StateNumbers numbers(const Problem&, const VectorXd& unknowns) const override;
  void describe(const Problem&, const VectorXd& unknowns, StationaryState&) const override;
  VectorXd transfer_from(const Discrete& other, const VectorXd& unknowns) const override;
  VectorXd carry_from(const Discrete& other, const VectorXd& unknowns) const override;
  void move_to(const Problem&) override;

 private:
  /// At the same resolution, with the side cut so, and nodes of the liquid as those of another one.
  std::shared_ptr<DuctDiscrete> with(const std::vector<double>& side_breaks, const DuctSpace& points_as) const;
  double mesh_quality(const VectorXd& unknowns) const override;
  double surface_evenness(const VectorXd& unknowns) const override;
  std::shared_ptr<Discrete> made_as(const Discrete& other) const override;
  std::shared_ptr<Discrete> cut_again(const VectorXd& unknowns, double evenly) const override;
  void fit(const VectorXd& unknowns) override;
  std::shared_ptr<DuctSpace> make_space(const Problem&, const std::vector<double>& side_breaks) const;
  std::unique_ptr<DuctSystem> make_system(const Problem&) const;

  Problem problem_;  ///< that it was made for
  DuctSubdivision subdivision_;
  Symmetry symmetry_;
  std::shared_ptr<DuctSpace> space_;  ///< with those who write its fields later
  std::unique_ptr<DuctSystem> system_;
};

/// Deformation of the silhouette that the camera sees.
double duct_deformation(const DuctSpace&, const VectorXd& unknowns, Camera);

/// Of a cell in a duct, or (to compare) in a tube, in three dimensions, and of its search.
Geometry duct_geometry(const Problem&);

}  // namespace rheocyte
