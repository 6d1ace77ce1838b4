#include "duct/turning_surface.h"

#include <Eigen/LU>

#include "duct/duct_surface.h"
#include "shape/curve.h"

namespace rheocyte {

TurningSurface::TurningSurface(const DuctSpace& space)
    : space_(space), face_of_element_(space.mesh().elements().size(), -1) {
  if (!space.turns()) return;
  std::vector<int> faces_at(space.nodes().count, 0);
  for (int e = 0; e < int(face_of_element_.size()); ++e) {
    if (!touches_cell(space.mesh().elements()[e])) continue;
    face_of_element_[e] = int(faces_.size());
    faces_.push_back(face_of(e));
    for (const int node : faces_.back().nodes) ++faces_at[node];
  }
  for (Face& face : faces_) {
    face.fraction.resize(Eigen::Index(face.nodes.size()));
    for (int k = 0; k < face.fraction.size(); ++k) face.fraction(k) = 1.0 / faces_at[face.nodes[k]];
  }
}

/// The undeformed surface turns with e_z x (X - centre), which is made of its tangents: what is derived along them is
/// known on the surface alone.
TurningSurface::Face TurningSurface::face_of(int element) const {
  const int n = space_.reference().degree() + 1, all = n * n;
  const MatrixXd slope = lagrange_slopes(n - 1, space_.reference().nodes_1d);
  const auto& nodes = space_.nodes().of_element[element];
  std::array<MatrixXd, 2> slopes{MatrixXd::Zero(all, all), MatrixXd::Zero(all, all)};
  for (int k = 0; k < all; ++k) {
    for (int i = 0; i < n; ++i) {
      slopes[0](k, i + k / n * n) = slope(k % n, i);
      slopes[1](k, k % n + i * n) = slope(k / n, i);
    }
  }
  Face face{{nodes.begin(), nodes.begin() + all}, MatrixXd(all, all), {}};
  const DuctPoint centre(0, space_.mesh().geometry().shape().offset, 0);
  Eigen::MatrixX3d X(all, 3);
  for (int k = 0; k < all; ++k) X.row(k) = (space_.node_points()[face.nodes[k]] - centre).transpose();
  const Eigen::MatrixX3d first = slopes[0] * X, second = slopes[1] * X;
  for (int k = 0; k < all; ++k) {
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << first.row(k).transpose(), second.row(k).transpose();
    const DuctPoint turning(-X(k, 1), X(k, 0), 0);
    const Eigen::Vector2d along = (tangents.transpose() * tangents).inverse() * (tangents.transpose() * turning);
    face.rate.row(k) = along(0) * slopes[0].row(k) + along(1) * slopes[1].row(k);
  }
  return face;
}

Eigen::MatrixX3d TurningSurface::velocity(const Face& face, const VectorXd& unknowns) const {
  Eigen::MatrixX3d x(face.nodes.size(), 3);
  for (int k = 0; k < x.rows(); ++k) x.row(k) = duct_point(space_, unknowns, face.nodes[k]).transpose();
  return face.rate * x;
}

double TurningSurface::rate_of_displacement(int unknown, const VectorXd& unknowns) const {
  return unknown < 0 || motion_.rate == 0 ? 0 : motion_.rate * unknowns(unknown) + motion_.unknowns(unknown);
}

void TurningSurface::add_residual(const VectorXd& unknowns, VectorXd& total) const {
  for (const Face& face : faces_) {
    const Eigen::MatrixX3d rate = velocity(face, unknowns);
    for (int k = 0; k < rate.rows(); ++k) {
      for (int c = 0; c < 3; ++c) {
        const int own = space_.velocity(face.nodes[k], c).unknown;
        if (own < 0) continue;
        const double changing = rate_of_displacement(space_.displacement(face.nodes[k], c), unknowns);
        total(own) += face.fraction(k) * (unknowns(own) - unknowns(space_.spin()) * rate(k, c) - changing);
      }
    }
  }
}

void TurningSurface::add_tangent(int element, const VectorXd& unknowns, const std::vector<int>& place,
                                 Eigen::MatrixXf& matrix) const {
  if (face_of_element_[element] < 0) return;
  const Face& face = faces_[face_of_element_[element]];
  const Eigen::MatrixX3d rate = velocity(face, unknowns);
  const double spin = unknowns(space_.spin());
  for (int k = 0; k < rate.rows(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const int own = space_.velocity(face.nodes[k], c).unknown;
      if (own < 0) continue;
      const int row = place[own];
      matrix(row, row) += float(face.fraction(k));
      matrix(row, place[space_.spin()]) -= float(face.fraction(k) * rate(k, c));
      if (const int changing = space_.displacement(face.nodes[k], c); changing >= 0)
        matrix(row, place[changing]) -= float(face.fraction(k) * motion_.rate);
      for (int j = 0; j < rate.rows(); ++j) {
        const int moved = space_.displacement(face.nodes[j], c);
        if (moved >= 0) matrix(row, place[moved]) -= float(face.fraction(k) * spin * face.rate(k, j));
      }
    }
  }
}

}  // namespace rheocyte
