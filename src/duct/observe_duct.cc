#include "duct/observe_duct.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "shape/curve.h"

namespace rheocyte {
namespace {

/// A face of the surface: the last layer of nodes of an element of the ring.
std::vector<std::vector<int>> surface_faces(const DuctSpace& space) {
  std::vector<std::vector<int>> faces;
  const int n = space.reference().degree() + 1;
  for (std::size_t e = 0; e < space.elements().size(); ++e) {
    const DuctElement& element = space.mesh().elements()[e];
    if (element.part != Part::ring || element.outward[1] != 1) continue;
    const auto& nodes = space.nodes().of_element[e];
    faces.emplace_back(nodes.end() - n * n, nodes.end());
  }
  return faces;
}

/// Kronecker product of the tables of two directions, the first fastest.
MatrixXd on_face(const MatrixXd& first, const MatrixXd& second) {
  MatrixXd product(first.rows() * second.rows(), first.cols() * second.cols());
  for (int j = 0; j < second.cols(); ++j) {
    for (int q = 0; q < second.rows(); ++q)
      product.block(q * first.rows(), j * first.cols(), first.rows(), first.cols()) = second(q, j) * first;
  }
  return product;
}

/// An edge of the surface in a plane of symmetry, from front to rear.
struct MeridianEdge {
  std::vector<int> face;   ///< nodes
  std::vector<int> nodes;  ///< of the edge
  int side;                ///< of the face: second coordinate 0 or 1, first coordinate 0 or 1
  bool reversed;           ///< whether its coordinate runs from rear to front
};

std::vector<MeridianEdge> meridian_edges(const DuctSpace& space, Camera camera) {
  constexpr double tiny = 1e-10;
  const int n = space.reference().degree() + 1;
  const auto in_plane = [&](int node) {
    const DuctPoint& X = space.node_points()[node];
    return (camera == Camera::side ? X(2) : X(1) - X(2)) < tiny;
  };
  const auto place = [&](const MeridianEdge& edge) { return space.node_points()[edge.nodes.front()](0); };
  std::vector<MeridianEdge> edges;
  for (const auto& face : surface_faces(space)) {
    for (int side = 0; side < 4; ++side) {
      MeridianEdge edge{face, {}, side, false};
      for (int k = 0; k < n; ++k) {
        const int i = side < 2 ? k : (side - 2) * (n - 1), j = side < 2 ? side * (n - 1) : k;
        edge.nodes.push_back(face[i + n * j]);
      }
      if (!std::all_of(edge.nodes.begin(), edge.nodes.end(), in_plane)) continue;
      edge.reversed = place(edge) < space.node_points()[edge.nodes.back()](0);
      if (edge.reversed) std::reverse(edge.nodes.begin(), edge.nodes.end());
      edges.push_back(std::move(edge));
    }
  }
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return place(a) > place(b); });
  return edges;
}

/// The surface at points of an edge: position and its derivatives with respect to the coordinate along the edge (u) and
/// the other one of the face (v), in the order x, x_u, x_v, x_uu, x_uv, x_vv.
struct EdgeOfSurface {
  std::array<Eigen::MatrixX3d, 6> now, rest;

  EdgeOfSurface(const DuctSpace& space, const VectorXd& unknowns, const MeridianEdge& edge, const VectorXd& along) {
    const int degree = space.reference().degree();
    const bool first = edge.side < 2;  // whether u is the face's first coordinate
    const VectorXd across = VectorXd::Constant(1, edge.side % 2);
    const MatrixXd to_nodes = lagrange_slopes(degree, space.reference().nodes_1d);
    const std::array u{lagrange_basis(degree, along), lagrange_slopes(degree, along),
                       MatrixXd(lagrange_slopes(degree, along) * to_nodes)},
        v{lagrange_basis(degree, across), lagrange_slopes(degree, across),
          MatrixXd(lagrange_slopes(degree, across) * to_nodes)};
    Eigen::MatrixX3d x(edge.face.size(), 3), X(edge.face.size(), 3);
    for (int k = 0; k < int(edge.face.size()); ++k) {
      x.row(k) = duct_point(space, unknowns, edge.face[k]).transpose();
      X.row(k) = space.node_points()[edge.face[k]].transpose();
    }
    constexpr std::array<std::array<int, 2>, 6> orders{{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};
    for (std::size_t i = 0; i < orders.size(); ++i) {
      const auto [a, b] = orders[i];
      const MatrixXd table = first ? on_face(u[a], v[b]) : on_face(v[b], u[a]);
      now[i] = table * x;
      rest[i] = table * X;
    }
  }

  /// Along the meridian, and across it by the stretch of the area.
  Eigen::Vector2d stretches(int q) const {
    const auto area = [q](const auto& at) { return DuctPoint(at[1].row(q)).cross(DuctPoint(at[2].row(q))).norm(); };
    const double along = now[1].row(q).norm() / rest[1].row(q).norm();
    return {along, area(now) / area(rest) / along};
  }

  /// Along and across; both 1/a for a sphere of radius a. A meridian in a plane of symmetry is a line of curvature.
  Eigen::Vector2d curvatures(int q) const {
    const DuctPoint u = now[1].row(q), v = now[2].row(q), uu = now[3].row(q), uv = now[4].row(q), vv = now[5].row(q);
    DuctPoint normal = u.cross(v).normalized();
    if (normal.dot(DuctPoint(rest[0].row(q))) < 0) normal = -normal;
    const double E = u.dot(u), F = u.dot(v), G = v.dot(v);
    const double e = uu.dot(normal), f = uv.dot(normal), g = vv.dot(normal);
    const double both = -(e * G - 2 * f * F + g * E) / (E * G - F * F), along = -e / E;
    return {along, both - along};
  }
};

/// At parameters of each edge that lie symmetrically in [0, 1].
DuctMeridian meridian_at(const VectorXd& parameters, const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  const auto edges = meridian_edges(space, camera);
  const Eigen::Index per_edge = parameters.size(), all = per_edge * Eigen::Index(edges.size());
  DuctMeridian meridian{VectorXd(all), Eigen::MatrixX2d(all, 2), Eigen::MatrixX2d(all, 2), Eigen::MatrixX2d(all, 2)};
  Eigen::Index row = 0;
  for (const MeridianEdge& edge : edges) {
    VectorXd along = parameters;
    if (edge.reversed) along.reverseInPlace();
    const EdgeOfSurface patch(space, unknowns, edge, along);
    for (int q = 0; q < int(per_edge); ++q, ++row) {
      const DuctPoint x = patch.now[0].row(q), X = patch.rest[0].row(q);
      meridian.rest_angle(row) = std::atan2(X.tail<2>().norm(), X(0));
      meridian.point.row(row) << x(0), x.tail<2>().norm();
      meridian.stretch.row(row) = patch.stretches(q).transpose();
      meridian.curvature.row(row) = patch.curvatures(q).transpose();
    }
  }
  return meridian;
}

/// At products of parameters in [0, 1] on each face.
DuctSurface surface_at(const VectorXd& at, const DuctSpace& space, const VectorXd& unknowns) {
  const int degree = space.reference().degree();
  const MatrixXd value = lagrange_basis(degree, at), slope = lagrange_slopes(degree, at);
  const MatrixXd shape = on_face(value, value), slope1 = on_face(slope, value), slope2 = on_face(value, slope);
  const auto faces = surface_faces(space);
  const Eigen::Index points = shape.rows(), all = points * Eigen::Index(faces.size());
  DuctSurface surface{Eigen::MatrixX3d(all, 3), Eigen::MatrixX2d(all, 2), Eigen::MatrixX2d(all, 2)};
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Eigen::MatrixX3d x(faces[f].size(), 3), X(faces[f].size(), 3);
    for (int k = 0; k < int(faces[f].size()); ++k) {
      x.row(k) = duct_point(space, unknowns, faces[f][k]).transpose();
      X.row(k) = space.node_points()[faces[f][k]].transpose();
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

DuctPoint duct_point(const DuctSpace& space, const VectorXd& unknowns, int node) {
  DuctPoint x = space.node_points()[node];
  for (int c = 0; c < 3; ++c) {
    if (const int unknown = space.displacement(node, c); unknown >= 0) x(c) += unknowns(unknown);
  }
  return x;
}

Contour duct_contour(const DuctSpace& space, const VectorXd& unknowns, Camera camera) {
  Contour contour;
  for (const MeridianEdge& edge : meridian_edges(space, camera)) {
    CurvePiece& piece = contour.pieces.emplace_back(edge.nodes.size(), 2);
    for (int k = 0; k < piece.rows(); ++k) {
      const DuctPoint x = duct_point(space, unknowns, edge.nodes[k]);
      piece.row(k) << x(0), x.tail<2>().norm();
    }
  }
  return contour;
}

DuctMeridian duct_meridian(const DuctSpace& space, const VectorXd& unknowns, Camera camera, int per_edge) {
  return meridian_at(VectorXd::LinSpaced(per_edge, 0, 1), space, unknowns, camera);
}

DuctSurface duct_surface(const DuctSpace& space, const VectorXd& unknowns, int per_edge) {
  return surface_at(VectorXd::LinSpaced(per_edge, 0, 1), space, unknowns);
}

Eigen::MatrixX2d duct_principal_stretches(const DuctSpace& space, const VectorXd& unknowns) {
  const VectorXd at = gauss_legendre(space.reference().degree()).points;
  // In a plane of symmetry the principal directions lie along the meridian and across it.
  const Eigen::MatrixX2d of_faces = surface_at(at, space, unknowns).stretch,
                         of_side = meridian_at(at, space, unknowns, Camera::side).stretch,
                         of_diagonal = meridian_at(at, space, unknowns, Camera::diagonal).stretch;
  Eigen::MatrixX2d all(of_faces.rows() + of_side.rows() + of_diagonal.rows(), 2);
  all << of_faces, of_side, of_diagonal;
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
  CellVolume sum;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.elements()[e].liquid) continue;
    const MatrixXd G = numbers_at_points<MapFields<double, 3>>(space, element, e, unknowns);
    VectorXd x(space.reference().nodes());
    for (int k = 0; k < x.size(); ++k) x(k) = duct_point(space, unknowns, space.nodes().of_element[e][k])(0);
    const MatrixXd at = element.at_points(0, x);
    for (int q = 0; q < G.rows(); ++q) {
      const Eigen::Map<const Eigen::Matrix3d, 0, Eigen::InnerStride<>> map(&G(q, 0), Eigen::InnerStride<>(G.rows()));
      const double volume = 8 * space.reference().weights(q) * map.determinant();
      sum.volume += volume;
      sum.barycentre += volume * at(q, 0);
    }
  }
  sum.barycentre /= sum.volume;
  return sum;
}

double duct_inlet_pressure(const DuctSpace& space, const VectorXd& unknowns) {
  const ReferenceElement<2> face(space.reference().degree());
  double force = 0, area = 0;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const DuctElement& element = space.mesh().elements()[e];
    if (element.part != Part::end || element.face != Face::rear || element.outward[1] != 1) continue;
    const int n = face.nodes();
    const auto& nodes = space.nodes().of_element[e];
    Eigen::MatrixX2d X(n, 2);
    for (int k = 0; k < n; ++k) X.row(k) = space.node_points()[nodes[nodes.size() - n + k]].tail<2>().transpose();
    const Eigen::MatrixX2d G1 = face.shape.slope[0] * X, G2 = face.shape.slope[1] * X;
    const int points_1d = int(face.points_1d.size());
    for (int q = 0; q < face.points(); ++q) {
      const VectorXd modes =
          space.reference().pressure_modes({face.points_1d(q % points_1d), face.points_1d(q / points_1d), 1});
      double p = 0;
      for (int k = 0; k < modes.size(); ++k) p += modes(k) * unknowns(space.pressure(e, k));
      const double weight = face.weights(q) * std::abs(G1(q, 0) * G2(q, 1) - G1(q, 1) * G2(q, 0));
      force += p * weight;
      area += weight;
    }
  }
  return force / area;
}

VectorXd transfer(const DuctSpace& from, const VectorXd& unknowns, const DuctSpace& to) {
  const ReferenceElement<3>&source = from.reference(), &target = to.reference();
  const MatrixXd basis = source.lagrange(target.nodes_1d);
  VectorXd result = VectorXd::Zero(to.unknowns());
  result(to.cell_velocity()) = unknowns(from.cell_velocity());
  double shift = 0;  // of the node that is held there
  for (int e = 0; e < int(to.elements().size()); ++e) {
    const auto &nodes = from.nodes().of_element[e], &nodes_to = to.nodes().of_element[e];
    const bool liquid = to.elements()[e].liquid;
    MatrixXd field(source.nodes(), 3);
    for (int k = 0; k < source.nodes(); ++k) {
      for (int c = 0; c < 3; ++c) {
        field(k, c) = liquid ? from.velocity(nodes[k], c).value(unknowns)
                             : duct_point(from, unknowns, nodes[k])(c) - from.node_points()[nodes[k]](c);
      }
    }
    const MatrixXd values = apply_in_each_direction(basis, field);
    for (int k = 0; k < target.nodes(); ++k) {
      if (!liquid && nodes_to[k] == to.held_node()) shift = values(k, 0);
      for (int c = 0; c < 3; ++c) {
        const int unknown = liquid ? to.velocity(nodes_to[k], c).unknown : to.displacement(nodes_to[k], c);
        if (unknown >= 0 && unknown != to.cell_velocity()) result(unknown) = values(k, c);
      }
    }
    // The modes are orthonormal, and those of a degree begin with those of lower ones.
    for (int k = 0; k < std::min(source.pressures(), target.pressures()); ++k)
      result(to.pressure(e, k)) = unknowns(from.pressure(e, k));
  }
  for (int i = 0; i < to.nodes().count; ++i) {
    if (const int unknown = to.displacement(i, 0); unknown >= 0) result(unknown) -= shift;
  }
  return result;
}

}  // namespace rheocyte
