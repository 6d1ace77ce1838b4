#include "duct/duct_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "duct/observe_duct.h"
#include "fem/element_quadrature.h"
#include "fem/sample_fields.h"
#include "laws/weak_form.h"

namespace rheocyte {
namespace {

constexpr int surface_divisions = 6;

std::vector<int> nodes_of_face(int per_edge, int direction, bool far) {
  std::vector<int> nodes;
  const int fixed = far ? per_edge - 1 : 0;
  for (int b = 0; b < per_edge; ++b) {
    for (int a = 0; a < per_edge; ++a) {
      std::array<int, 3> at{a, b, b};
      if (direction == 0) at[1] = a;
      at[std::size_t(direction)] = fixed;
      nodes.push_back(at[0] + per_edge * (at[1] + per_edge * at[2]));
    }
  }
  return nodes;
}

/// Faces in the plane of symmetry that a camera looks at.
std::vector<FaceInPlane> plane_faces(const DuctSpace& space, const Eigen::Vector2d& across) {
  const int per_edge = space.reference().degree() + 1;
  std::vector<FaceInPlane> faces;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const auto& nodes = space.nodes().of_element[e];
    const auto in_plane = [&](int k) {
      const DuctPoint& X = space.node_points()[nodes[k]];
      return std::abs(across(0) * X(2) - across(1) * X(1)) < same_place;
    };
    for (int side = 0; side < 6; ++side) {
      std::vector<int> face = nodes_of_face(per_edge, side / 2, side % 2 == 1);
      if (std::ranges::all_of(face, in_plane)) faces.push_back({e, std::move(face)});
    }
  }
  return faces;
}

}  // namespace

ElementState DuctFields::state_of(int e) const {
  using OfLiquid = LiquidFields<double, 3>;
  const HexahedronUnknowns& self = space_.elements()[e];
  const auto& nodes = space_.nodes().of_element[e];
  const int n = int(nodes.size());
  ElementState state{self.liquid, MatrixXd(n, 3), MatrixXd::Zero(n, 3), MatrixXd::Zero(n, 3), {}, {}};
  for (int k = 0; k < n; ++k) state.rest.row(k) = space_.node_points()[nodes[k]].transpose();
  state.rest.col(1).array() += space_.aside();
  if (self.moves) state.displacement = values_of(self.displacement, unknowns_).reshaped(n, 3);
  if (self.liquid) state.velocity = values_of(self.velocity, unknowns_).reshaped(n, 3);
  state.pressure = at_nodes(space_.reference().pressure.value * values_of(self.pressure, unknowns_));
  if (self.is_empty) return state;
  const MatrixXd numbers = self.liquid ? numbers_at_points<OfLiquid>(space_, element_, e, unknowns_)
                                       : numbers_at_points<MapFields<double, 3>>(space_, element_, e, unknowns_);
  for (int q = 0; q < numbers.rows(); ++q) {
    if (self.liquid) {
      const auto f = fields_at<OfLiquid>(numbers, q);
      state.gradients.push_back(gradient(PointMap<double, 3>(f.map), f.w, f.w_xi));
    } else {
      const PointMap<double, 3> map(fields_at<MapFields<double, 3>>(numbers, q));
      state.gradients.push_back(deformation_gradient(map, self.undeformed[q]));
    }
  }
  return state;
}

/// The whole surface: all images of the part that was computed.
void DuctFields::add_surface(SampledFields& s) const {
  const int per_edge = surface_divisions + 1;
  Eigen::MatrixX3d part = um_ * duct_surface(space_, unknowns_, per_edge).point;
  part.col(1).array() += um_ * space_.aside();
  const Eigen::Index points = part.rows(), faces = points / (per_edge * per_edge);
  std::vector<std::uint32_t> triangles;
  for (Eigen::Index f = 0; f < faces; ++f)
    add_grid_triangles(std::uint32_t(f * per_edge * per_edge), surface_divisions, triangles);
  const std::vector<Image> copies = copies_of(space_.mesh().symmetry());
  s.surface_um.resize(Eigen::Index(copies.size()) * points, 3);
  for (std::size_t copy = 0; copy < copies.size(); ++copy) {
    const Image& image = copies[copy];
    const Eigen::Index start = Eigen::Index(copy) * points;
    for (Eigen::Index i = 0; i < points; ++i)
      s.surface_um.row(start + i) = image(part.row(i).transpose()).transpose().cast<float>();
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      const auto first = std::uint32_t(start);
      const std::uint32_t a = first + triangles[i], b = first + triangles[i + 1], c = first + triangles[i + 2];
      s.surface_triangles.insert(s.surface_triangles.end(), {a, image.mirrors() ? c : b, image.mirrors() ? b : c});
    }
  }
}

SampledFields DuctFields::sample(Camera camera, int points) const {
  const double angle = nearest_mirror(space_.mesh().symmetry(), camera).degrees * std::numbers::pi / 180;
  const Eigen::Vector2d across(std::cos(angle), std::sin(angle));
  SampledFields s = sample_faces(*this, plane_faces(space_, across), across, points);
  add_surface(s);
  return s;
}

}  // namespace rheocyte
