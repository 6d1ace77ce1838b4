#include "duct/duct_surface.h"

#include <Eigen/Geometry>

#include "shape/curve.h"

namespace rheocyte {

std::vector<SurfaceFace> surface_faces(const DuctSpace& space) {
  std::vector<SurfaceFace> faces;
  const int n = space.reference().degree() + 1;
  for (std::size_t e = 0; e < space.elements().size(); ++e) {
    const DuctElement& element = space.mesh().elements()[e];
    if (element.part != Part::ring || element.outward[1] != 1) continue;
    const auto& nodes = space.nodes().of_element[e];
    faces.push_back({int(e), {nodes.end() - n * n, nodes.end()}});
  }
  return faces;
}

DuctPoint duct_point(const DuctSpace& space, const VectorXd& unknowns, int node) {
  DuctPoint x = space.node_points()[node];
  for (int c = 0; c < 3; ++c) {
    if (const int unknown = space.displacement(node, c); unknown >= 0) x(c) += unknowns(unknown);
  }
  return x;
}

DuctSurfaceMap::DuctSurfaceMap(const DuctSpace& space, const VectorXd& unknowns)
    : space_(space),
      faces_(surface_faces(space)),
      slopes_at_nodes_(lagrange_slopes(space.reference().degree(), space.reference().nodes_1d)) {
  const int n = space.reference().degree() + 1;
  for (const SurfaceFace& face : faces_) {
    Nodes &now = now_.emplace_back(), &rest = rest_.emplace_back();
    now.fill(MatrixXd(n, n));
    rest.fill(MatrixXd(n, n));
    for (int k = 0; k < n * n; ++k) {
      const DuctPoint x = duct_point(space, unknowns, face.nodes[k]), &X = space.node_points()[face.nodes[k]];
      for (int c = 0; c < 3; ++c) {
        now[c](k) = x(c);
        rest[c](k) = X(c);
      }
    }
  }
}

DuctPoint DuctSurfaceMap::point(const SurfacePlace& at) const {
  const DuctPoint sphere = space_.mesh().point(faces_[at.face].element, {at.s, at.t, 1});
  return sphere + now(at).x - rest(at).x;
}

SurfaceJet DuctSurfaceMap::jet(const Nodes& nodes, const SurfacePlace& at) const {
  const int degree = space_.reference().degree();
  const auto tables = [&](double coordinate) {
    const VectorXd one = VectorXd::Constant(1, coordinate);
    const MatrixXd slopes = lagrange_slopes(degree, one);
    return std::array<MatrixXd, 3>{lagrange_basis(degree, one), slopes, slopes * slopes_at_nodes_};
  };
  const auto u = tables(at.s), v = tables(at.t);
  const auto part = [&](int a, int b) {
    DuctPoint x;
    for (int c = 0; c < 3; ++c) x(c) = (u[a] * nodes[c] * v[b].transpose())(0, 0);
    return x;
  };
  return {part(0, 0), part(1, 0), part(0, 1), part(2, 0), part(1, 1), part(0, 2)};
}

}  // namespace rheocyte
