#include "duct/duct_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <ranges>
#include <utility>

#include "shape/curve.h"

namespace rheocyte {
namespace {

using Quadrilateral = std::array<FacePoint, 4>;

/// Breaks in [from, to] whose intervals grow by the constant factor that multiplies 1 to `ratio` over all of them.
std::vector<double> breaks(int n, double from, double to, double ratio = 1) {
  std::vector<double> at(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double t = double(i) / n;
    at[i] = from + (to - from) * (std::abs(ratio - 1) < 1e-3 ? t : (std::pow(ratio, t) - 1) / (ratio - 1));
  }
  return at;
}

/// The same seen from behind.
void mirror(std::vector<Quadrilateral>& quadrilaterals) {
  for (Quadrilateral& q : quadrilaterals) std::swap(q[1], q[2]);
}

/// Of the triangle 0 <= Z <= Y <= 1, counterclockwise in (Y, Z).
std::vector<Quadrilateral> triangle() {
  const FacePoint a(0, 0), b(1, 0), c(1, 1), ab(0.5, 0), bc(1, 0.5), ca(0.5, 0.5), centre(2.0 / 3, 1.0 / 3);
  return {{a, ab, ca, centre}, {b, bc, ab, centre}, {c, ca, bc, centre}};
}

std::vector<Quadrilateral> grid(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<Quadrilateral> quadrilaterals;
  for (std::size_t j = 0; j + 1 < second.size(); ++j) {
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
      const double a = first[i], b = first[i + 1], c = second[j], d = second[j + 1];
      quadrilaterals.push_back({{{a, c}, {b, c}, {a, d}, {b, d}}});
    }
  }
  return quadrilaterals;
}

}  // namespace

/// What of a face of the cube lies in the part that is meshed, such that all elements are right-handed.
struct CubeFace {
  CubeFace(Face which, const Image& of_wedge, std::vector<Quadrilateral> counterclockwise)
      : face(which), image(of_wedge), quadrilaterals(std::move(counterclockwise)) {
    if ((face == Face::rear) != image.mirrors()) mirror(quadrilaterals);
  }
  Face face;
  Image image;
  std::vector<Quadrilateral> quadrilaterals;
};

namespace {

/// Below a sharp rim the stress of the cell varies over its radius.
std::vector<double> ring_breaks(int n) {
  constexpr double thinner = 0.43;  // a layer than that below it
  return breaks(n, 0, 1, std::pow(thinner, n));
}

/// From the box to the end of the mesh. Where the mesh has a run-out the wall is not straight, and its corners pass by
/// all elements; else nothing is disturbed beyond the shortest duct.
std::vector<double> end_breaks(const DuctGeometry& geometry, int n) {
  constexpr double longest = 1.1;  // of the elements beyond the shortest duct, if the wall is not straight
  const double half = geometry.half_length(), way = half - geometry.box(), run_out = geometry.end() - half,
               near = (geometry.min_length() - geometry.box()) / way;
  const auto elements_in = [&](double length) { return int(std::ceil(length / longest - 1e-9)); };
  std::vector<double> ends = breaks(n, 0, std::min(1.0, near), 1.3);
  const auto add = [&](const std::vector<double>& more) { ends.insert(ends.end(), more.begin() + 1, more.end()); };
  if (near < 1) add(breaks(run_out > 0 ? elements_in((1 - near) * way) : 1, near, 1));
  if (run_out > 0) add(breaks(elements_in(run_out), 1, geometry.last_outward()));
  return ends;
}

/// `x` are the breaks of the side.
std::vector<CubeFace> cube_faces(Symmetry symmetry, const std::vector<double>& x, int across) {
  std::vector<CubeFace> faces;
  if (across == 0) {
    for (const Image& image : wedges_of(symmetry)) {
      faces.emplace_back(Face::front, image, triangle());
      faces.emplace_back(Face::side, image, grid({0, 0.5, 1}, x));
      faces.emplace_back(Face::rear, image, triangle());
    }
    return faces;
  }
  assert(symmetry == Symmetry::half && across % 2 == 0);
  const auto whole = breaks(across, -1, 1), half = breaks(across / 2, 0, 1);
  for (const Face face : {Face::front, Face::rear}) faces.emplace_back(face, Image{}, grid(whole, half));
  for (const double y : {1.0, -1.0}) faces.emplace_back(Face::side, Image{false, y}, grid(half, x));
  faces.emplace_back(Face::side, Image{true}, grid(whole, x));
  return faces;
}

}  // namespace

std::vector<DuctElement> section_elements(Symmetry symmetry, int across) {
  std::vector<DuctElement> elements;
  for (const CubeFace& face : cube_faces(symmetry, {-1, 1}, across)) {
    if (face.face != Face::front) continue;
    for (const Quadrilateral& corners : face.quadrilaterals)
      elements.push_back({Part::end, Face::front, face.image, corners, {0, 1}});
  }
  return elements;
}

std::vector<double> side_breaks(const DuctSubdivision& n) { return breaks(n.along, -1, 1, n.growth); }

int duct_layers_for(const DuctGeometry& geometry, const DuctSubdivision& n) {
  constexpr double first_layer_height = 0.5;  // relative to the width of the surface's elements
  const double width = geometry.radius() * std::numbers::pi / 2 / n.along;
  const double first = first_layer_height * width / (geometry.box() - geometry.radius());
  return std::max(1, int(std::lround(std::log2(1 + 1 / first))));
}

int DuctElement::direction_along() const {
  if (part == Part::core) return 2;
  if (face != Face::side) return -1;
  return corners[0](1) == corners[1](1) ? 1 : 0;
}

std::array<double, 2> DuctElement::along() const {
  if (part == Part::core) return outward;
  return {corners[0](1), corners[3](1)};
}

DuctPoint DuctElement::on_cube(double s, double t, double xi3) const {
  const FacePoint at =
      (1 - s) * (1 - t) * corners[0] + s * (1 - t) * corners[1] + (1 - s) * t * corners[2] + s * t * corners[3];
  if (part == Part::core) return image({outward_at(xi3), at(0), at(1)});
  if (face == Face::side) return image({at(1), 1, at(0)});
  return image({face == Face::front ? 1.0 : -1.0, at(0), at(1)});
}

DuctMesh::DuctMesh(const DuctGeometry& geometry, const DuctSubdivision& subdivision, Symmetry symmetry,
                   std::vector<double> side_breaks)
    : geometry_(subdivision.across == 0 ? geometry : geometry.across_wedges()),
      subdivision_(subdivision),
      symmetry_(symmetry),
      side_breaks_(std::move(side_breaks)) {
  const int count = subdivision.layers > 0 ? subdivision.layers : duct_layers_for(geometry, subdivision);
  const auto layers = breaks(count, 0, 1, std::pow(2.0, count));
  const auto ends = end_breaks(geometry, subdivision.axial), ring = ring_breaks(subdivision.ring);
  for (const CubeFace& face : cube_faces(symmetry, side_breaks_, subdivision.across)) {
    if (face.face == Face::front) add(Part::core, face, side_breaks_);
    add(Part::ring, face, ring);
    add(Part::layers, face, layers);
    if (face.face != Face::side) add(Part::end, face, ends);
  }
}

void DuctMesh::add(Part part, const CubeFace& face, const std::vector<double>& outward) {
  for (const Quadrilateral& corners : face.quadrilaterals) {
    const int foot = part == Part::layers ? int(elements_.size()) : -1;
    for (std::size_t i = 0; i + 1 < outward.size(); ++i)
      elements_.push_back({part, face.face, face.image, corners, {outward[i], outward[i + 1]}, foot});
  }
}

DuctPoint DuctMesh::point(int element, const Eigen::Vector3d& xi) const {
  const DuctElement& self = elements_[element];
  return geometry_.map(self.part, self.on_cube(xi(0), xi(1), xi(2)), self.outward_at(xi(2)));
}

Eigen::MatrixX3d DuctMesh::points(int element, const Eigen::VectorXd& xi) const {
  const Eigen::Index n = xi.size();
  Eigen::MatrixX3d places(n * n * n, 3);
  for (Eigen::Index k = 0; k < places.rows(); ++k)
    places.row(k) = point(element, {xi(k % n), xi(k / n % n), xi(k / (n * n))}).transpose();
  return places;
}

std::vector<double> DuctMesh::surface_places() const {
  std::vector<double> places{0, 0.5};
  for (const double height : std::views::reverse(side_breaks_)) places.push_back(2 - height);
  places.insert(places.end(), {3.5, 4});
  return places;
}

NodeNumbers DuctMesh::number_nodes(int degree) const {
  const Eigen::VectorXd& s = lobatto_nodes(degree);
  const int n = degree + 1;
  return rheocyte::number_nodes<3>(int(elements_.size()), n * n * n, [&](int e, int k) {
    return point(e, {s(k % n), s(k / n % n), s(k / (n * n))});
  });
}

}  // namespace rheocyte
