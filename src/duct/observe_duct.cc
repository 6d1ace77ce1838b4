#include "duct/observe_duct.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "shape/curve.h"

namespace rheocyte {
namespace {

/// Kronecker product of the tables of two directions, the first fastest.
MatrixXd on_face(const MatrixXd& first, const MatrixXd& second) {
  MatrixXd product(first.rows() * second.rows(), first.cols() * second.cols());
  for (int j = 0; j < second.cols(); ++j) {
    for (int q = 0; q < second.rows(); ++q)
      product.block(q * first.rows(), j * first.cols(), first.rows(), first.cols()) = second(q, j) * first;
  }
  return product;
}

/// At products of parameters in [0, 1] on each face.
DuctSurface surface_at(const VectorXd& at, const DuctSpace& space, const VectorXd& unknowns, double rest_stretch = 1) {
  const int degree = space.reference().degree();
  const MatrixXd value = lagrange_basis(degree, at), slope = lagrange_slopes(degree, at);
  const MatrixXd shape = on_face(value, value), slope1 = on_face(slope, value), slope2 = on_face(value, slope);
  const auto faces = surface_faces(space);
  const Eigen::Index points = shape.rows(), all = points * Eigen::Index(faces.size());
  DuctSurface surface{Eigen::MatrixX3d(all, 3), Eigen::MatrixX2d(all, 2), Eigen::MatrixX2d(all, 2)};
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& nodes = faces[f].nodes;
    Eigen::MatrixX3d x(nodes.size(), 3), X(nodes.size(), 3);
    for (int k = 0; k < int(nodes.size()); ++k) {
      x.row(k) = duct_point(space, unknowns, nodes[k]).transpose();
      X.row(k) = at_rest(space.node_points()[nodes[k]], rest_stretch).transpose();
    }
    const Eigen::MatrixX3d x1 = slope1 * x, x2 = slope2 * x, X1 = slope1 * X, X2 = slope2 * X;
    surface.point.middleRows(Eigen::Index(f) * points, points) = shape * x;
    for (Eigen::Index q = 0; q < points; ++q) {
      const auto metric = [](const auto& a, const auto& b) {
        Eigen::Matrix2d g;
        g << a.squaredNorm(), a.dot(b), a.dot(b), b.squaredNorm();
        return g;
      };
      const Eigen::Matrix2d now = metric(x1.row(q), x2.row(q)), rest = metric(X1.row(q), X2.row(q));
      // Squares of the principal stretches are the eigenvalues of rest^-1 now.
      const Eigen::Matrix2d C = rest.inverse() * now;
      const double mean = C.trace() / 2, half_gap = std::sqrt(std::max(0.0, mean * mean - C.determinant()));
      const Eigen::Index row = Eigen::Index(f) * points + q;
      surface.stretch.row(row) << std::sqrt(std::max(0.0, mean - half_gap)), std::sqrt(mean + half_gap);
      surface.direction.row(row) << std::sqrt(now(0, 0) / rest(0, 0)), std::sqrt(now(1, 1) / rest(1, 1));
    }
  }
  return surface;
}

}  // namespace

DuctSurface duct_surface(const DuctSpace& space, const VectorXd& unknowns, int per_edge) {
  return surface_at(VectorXd::LinSpaced(per_edge, 0, 1), space, unknowns);
}

Eigen::MatrixX2d duct_principal_stretches(const DuctSpace& space, const VectorXd& unknowns, double rest_stretch) {
  const VectorXd at = gauss_legendre(space.reference().degree()).points;
  std::vector<Eigen::MatrixX2d> parts{surface_at(at, space, unknowns, rest_stretch).stretch};
  // In a plane of symmetry the principal directions lie along the meridian and across it.
  for (const Camera camera : mirror_cameras(space.mesh().symmetry()))
    if (!space.turns()) parts.push_back(duct_meridian(space, unknowns, camera, at, rest_stretch).stretch);
  Eigen::Index rows = 0;
  for (const auto& part : parts) rows += part.rows();
  Eigen::MatrixX2d all(rows, 2);
  for (rows = 0; const auto& part : parts) {
    all.middleRows(rows, part.rows()) = part;
    rows += part.rows();
  }
  for (auto row : all.rowwise())
    if (row(0) > row(1)) std::swap(row(0), row(1));
  return all;
}

double duct_stretch_change(const DuctSpace& space, const VectorXd& from, const VectorXd& to) {
  const int per_edge = 2 * space.reference().degree();
  const Eigen::ArrayXXd a = duct_surface(space, from, per_edge).direction,
                        b = duct_surface(space, to, per_edge).direction;
  return ((b - a) / b).abs().maxCoeff();
}

CellVolume cell_volume(const DuctSpace& space, const TensorElement& element, const VectorXd& unknowns) {
  const auto copies = double(copies_of(space.mesh().symmetry()).size());
  CellVolume sum;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.elements()[e].liquid) continue;
    const MatrixXd G = numbers_at_points<MapFields<double, 3>>(space, element, e, unknowns);
    const MatrixXd at = element.at_points(0, points_of_nodes(space, e, unknowns).col(0));
    for (int q = 0; q < G.rows(); ++q) {
      const Eigen::Map<const Eigen::Matrix3d, 0, Eigen::InnerStride<>> map(&G(q, 0), Eigen::InnerStride<>(G.rows()));
      const double volume = copies * space.reference().weights(q) * map.determinant();
      sum.volume += volume;
      sum.barycentre += volume * at(q, 0);
    }
  }
  sum.barycentre /= sum.volume;
  return sum;
}

}  // namespace rheocyte
