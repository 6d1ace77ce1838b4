#include "duct/duct_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Of the side in (Z, X).
std::vector<Quadrilateral> strip(int along) {
  std::vector<Quadrilateral> quadrilaterals;
  const std::vector<double> x = breaks(along, -1, 1);
  for (int i = 0; i < along; ++i) {
    for (const double z : {0.0, 0.5})
      quadrilaterals.push_back({{{z, x[i]}, {z + 0.5, x[i]}, {z, x[i + 1]}, {z + 0.5, x[i + 1]}}});
  }
  return quadrilaterals;
}

/// Of a face of a wedge's image, such that all elements are right-handed.
std::vector<Quadrilateral> quadrilaterals(Face face, const Image& image, int along) {
  auto result = face == Face::side ? strip(along) : triangle();
  if ((face == Face::rear) != image.mirrors()) mirror(result);
  return result;
}

}  // namespace

std::vector<DuctElement> section_elements(Symmetry symmetry) {
  std::vector<DuctElement> elements;
  for (const Image& image : wedges_of(symmetry)) {
    for (const Quadrilateral& corners : quadrilaterals(Face::front, image, 0))
      elements.push_back({Part::end, Face::front, image, corners, {0, 1}});
  }
  return elements;
}

int duct_layers_for(const DuctGeometry& geometry, const DuctSubdivision& n) {
  constexpr double first_layer_height = 0.5;  // relative to the width of the surface's elements
  const double width = geometry.radius() * std::numbers::pi / 2 / n.along;
  const double first = first_layer_height * width / (geometry.box() - geometry.radius());
  return std::max(1, int(std::lround(std::log2(1 + 1 / first))));
}

DuctPoint DuctElement::on_cube(double s, double t, double xi3) const {
  const FacePoint at =
      (1 - s) * (1 - t) * corners[0] + s * (1 - t) * corners[1] + (1 - s) * t * corners[2] + s * t * corners[3];
  if (part == Part::core) return image({outward_at(xi3), at(0), at(1)});
  if (face == Face::side) return image({at(1), 1, at(0)});
  return image({face == Face::front ? 1.0 : -1.0, at(0), at(1)});
}

DuctMesh::DuctMesh(const DuctGeometry& geometry, const DuctSubdivision& subdivision, Symmetry symmetry)
    : geometry_(geometry), subdivision_(subdivision), symmetry_(symmetry) {
  const int count = subdivision.layers > 0 ? subdivision.layers : duct_layers_for(geometry, subdivision);
  const auto layers = breaks(count, 0, 1, std::pow(2.0, count));
  const double near = (geometry.least_length() - geometry.box()) / (geometry.half_length() - geometry.box());
  auto ends = breaks(subdivision.axial, 0, std::min(1.0, near), 1.3);
  if (near < 1) ends.push_back(1);  // where nothing is disturbed
  for (const Image& image : wedges_of(symmetry)) {
    add(Part::core, Face::front, image, breaks(subdivision.along, -1, 1));
    for (const auto& [part, outward] : {std::pair{Part::ring, breaks(1, 0, 1)}, std::pair{Part::layers, layers}}) {
      for (const Face face : {Face::front, Face::side, Face::rear}) add(part, face, image, outward);
    }
    add(Part::end, Face::front, image, ends);
    add(Part::end, Face::rear, image, ends);
  }
}

void DuctMesh::add(Part part, Face face, const Image& image, const std::vector<double>& outward) {
  for (const Quadrilateral& corners : quadrilaterals(face, image, subdivision_.along)) {
    const int foot = part == Part::layers ? int(elements_.size()) : -1;
    for (std::size_t i = 0; i + 1 < outward.size(); ++i)
      elements_.push_back({part, face, image, corners, {outward[i], outward[i + 1]}, foot});
  }
}

DuctPoint DuctMesh::point(int element, const Eigen::Vector3d& xi) const {
  const DuctElement& self = elements_[element];
  return geometry_.map(self.part, self.on_cube(xi(0), xi(1), xi(2)), self.outward_at(xi(2)));
}

NodeNumbers DuctMesh::number_nodes(int degree) const {
  const Eigen::VectorXd& s = lobatto_nodes(degree);
  const int n = degree + 1;
  return rheocyte::number_nodes<3>(int(elements_.size()), n * n * n, [&](int e, int k) {
    return point(e, {s(k % n), s(k / n % n), s(k / (n * n))});
  });
}

}  // namespace rheocyte
