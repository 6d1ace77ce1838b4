#include "duct/sample_duct_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "duct/duct_nodal_fields.h"
#include "duct/observe_duct.h"

namespace rheocyte {

namespace {

constexpr int surface_divisions = 6;

/// A face of an element, by the numbers of its nodes within it; first coordinate fastest.
struct PlaneFace {
  int element;
  std::vector<int> nodes;
};

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
std::vector<PlaneFace> plane_faces(const DuctSpace& space, const Eigen::Vector2d& across) {
  const int per_edge = space.reference().degree() + 1;
  std::vector<PlaneFace> faces;
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

/// The whole surface: all images of the part that was computed.
void add_surface(const DuctSpace& space, const VectorXd& unknowns, double um, SampledFields& s) {
  const int per_edge = surface_divisions + 1;
  const Eigen::MatrixX3d part = um * duct_surface(space, unknowns, per_edge).point;
  const Eigen::Index points = part.rows(), faces = points / (per_edge * per_edge);
  std::vector<std::uint32_t> triangles;
  for (Eigen::Index f = 0; f < faces; ++f)
    add_grid_triangles(std::uint32_t(f * per_edge * per_edge), surface_divisions, triangles);
  const std::vector<Image> copies = copies_of(space.mesh().symmetry());
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

}  // namespace

SampledFields sample_duct_fields(const DuctSpace& space, const Media& media, const VectorXd& unknowns,
                                 const Scales& scales, Camera camera, int points) {
  using Fields = DuctNodalFields;
  const double angle = nearest_mirror(space.mesh().symmetry(), camera).degrees * std::numbers::pi / 180;
  const Eigen::Vector2d across(std::cos(angle), std::sin(angle));
  const std::vector<PlaneFace> faces = plane_faces(space, across);
  const int divisions = sampling_divisions(points, faces.size());
  const MatrixXd grid = sampling_grid(space.reference().lagrange(VectorXd::LinSpaced(divisions + 1, 0, 1)));
  const Eigen::Index of_face = grid.rows(), all = of_face * Eigen::Index(faces.size());
  const Fields nodal(space, media, unknowns, scales);
  SampledFields s;
  for (auto* vectors : {&s.point_um, &s.velocity_m_per_s, &s.displacement_um}) vectors->resize(all, 2);
  for (auto* numbers : {&s.pressure_Pa, &s.shear_rate_per_s, &s.stress_Pa, &s.stretch}) numbers->resize(all);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Eigen::Index first = Eigen::Index(i) * of_face;
    const MatrixXd f = grid * nodal.of_element(faces[i].element)(faces[i].nodes, Eigen::all);
    const auto in_plane = [&](int column, SampledFields::Vectors& to) {
      to.block(first, 0, of_face, 1) = f.col(column).cast<float>();
      to.block(first, 1, of_face, 1) = (across(0) * f.col(column + 1) + across(1) * f.col(column + 2)).cast<float>();
    };
    in_plane(Fields::x, s.point_um);
    in_plane(Fields::w, s.velocity_m_per_s);
    in_plane(Fields::u, s.displacement_um);
    s.pressure_Pa.segment(first, of_face) = f.col(Fields::pressure).cast<float>();
    s.shear_rate_per_s.segment(first, of_face) = f.col(Fields::rate).cast<float>();
    s.stress_Pa.segment(first, of_face) = f.col(Fields::stress).cast<float>();
    s.stretch.segment(first, of_face) = f.col(Fields::stretch).cast<float>();
    s.in_cell.insert(s.in_cell.end(), std::size_t(of_face), space.elements()[faces[i].element].liquid ? 0 : 1);
    add_grid_triangles(std::uint32_t(first), divisions, s.triangles);
  }
  add_surface(space, unknowns, scales.length_um(), s);
  return s;
}

}  // namespace rheocyte
