// The undisturbed flow of a liquid through the duct: one axial velocity that depends on y and z alone
// (docs/theory-square.md, eq:duct-flow), on the cross-section of the duct's mesh and in the same polynomials, such that
// it is a discrete solution of the problem in three dimensions, too.
#pragma once
#include "duct/duct_mesh.h"
#include "fem/reference_element.h"
#include "laws/liquid.h"

namespace rheocyte {

/// At mean speed 1.
struct DuctFlow {
  double pressure_gradient = 0;  ///< positive number, in S/h
  VectorXd velocity;             ///< at the nodes of the cross-section, in U
};

class CrossSection {
 public:
  CrossSection(const DuctGeometry& geometry, int degree)
      : CrossSection(geometry, degree, symmetry_of(geometry.section())) {}
  /// `across` as in DuctSubdivision.
  CrossSection(const DuctGeometry&, int degree, Symmetry, int across = 0);

  /// Newton's method; a shear-thinning liquid is approached from the Newtonian one. The pressure gradient is not a
  /// number if that fails.
  DuctFlow flow(const Liquid&) const;

  /// The pressure gradient at another mean speed.
  double gradient_at(const Liquid&, double mean_speed) const;

  const std::vector<Eigen::Vector2d>& nodes() const { return points_; }
  /// Number of the node at (y, z).
  int node_at(const Eigen::Vector2d&) const;
  /// Mean over the duct's area of the function with these values at the nodes.
  double mean(const VectorXd& values) const { return weights_.dot(values) / weights_.sum(); }

 private:
  struct Element {
    std::vector<int> nodes;
    std::array<MatrixXd, 2> slope;  ///< d/dy, d/dz at the quadrature points: points x nodes
    VectorXd weights;               ///< times area
  };
  /// Newton from the given state at the same gradient and velocity; false if it fails.
  bool improve(const Liquid&, DuctFlow&) const;

  ReferenceElement<2> reference_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Element> elements_;
  std::vector<bool> wall_;
  VectorXd weights_;  ///< integrals of the shape functions
};

}  // namespace rheocyte
