#include "duct/duct_ends.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {
namespace {

/// A face of an element in a plane across the duct.
struct EndFace {
  int element;
  double xi3;  ///< of the face in the element
  std::vector<int> nodes;
  VectorXd area;  ///< of the quadrature points
};

/// Of the elements on both sides of the plane at a place between the box and the end of the mesh.
std::vector<EndFace> faces_at(const DuctSpace& space, Face end, double outward, const ReferenceElement<2>& face) {
  std::vector<EndFace> faces;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const DuctElement& element = space.mesh().elements()[e];
    const auto side =
        std::ranges::find_if(element.outward, [&](double o) { return std::abs(o - outward) < same_place; });
    if (element.part != Part::end || element.face != end || side == element.outward.end()) continue;
    const auto& nodes = space.nodes().of_element[e];
    const double xi3 = side == element.outward.begin() ? 0 : 1;
    const auto first = xi3 == 0 ? nodes.begin() : nodes.end() - face.nodes();
    EndFace& found = faces.emplace_back(EndFace{e, xi3, {first, first + face.nodes()}, {}});
    Eigen::MatrixX2d X(face.nodes(), 2);
    for (int k = 0; k < face.nodes(); ++k) X.row(k) = space.node_points()[found.nodes[k]].tail<2>().transpose();
    const Eigen::MatrixX2d G1 = face.shape.slope[0] * X, G2 = face.shape.slope[1] * X;
    const auto det = G1.col(0).array() * G2.col(1).array() - G1.col(1).array() * G2.col(0).array();
    found.area = face.weights.array() * det.abs();
  }
  return faces;
}

std::vector<EndFace> end_faces(const DuctSpace& space, Face end, const ReferenceElement<2>& face) {
  return faces_at(space, end, space.mesh().geometry().last_outward(), face);
}

}  // namespace

VectorXd duct_end_load(const DuctSpace& space, Face end) {
  const ReferenceElement<2> face(space.reference().degree());
  VectorXd load = VectorXd::Zero(space.unknowns());
  for (const EndFace& self : end_faces(space, end, face)) {
    const VectorXd weights = face.shape.value.transpose() * self.area;
    for (int k = 0; k < weights.size(); ++k) {
      const Slot& slot = space.velocity(self.nodes[k], 0);
      if (slot.unknown >= 0 && !space.is_motion(slot.unknown)) load(slot.unknown) += weights(k);
    }
  }
  return load;
}

double duct_end_pressure(const DuctSpace& space, const VectorXd& unknowns, Face end) {
  const ReferenceElement<2> face(space.reference().degree());
  const int points_1d = int(face.points_1d.size());
  double force = 0, area = 0;
  for (const EndFace& self : faces_at(space, end, 1, face)) {
    for (int q = 0; q < face.points(); ++q) {
      const VectorXd modes =
          space.reference().pressure_modes({face.points_1d(q % points_1d), face.points_1d(q / points_1d), self.xi3});
      for (int k = 0; k < modes.size(); ++k)
        force += self.area(q) * modes(k) * unknowns(space.pressure(self.element, k));
    }
    area += self.area.sum();
  }
  return force / area;
}

double duct_flow_rate(const DuctSpace& space, const VectorXd& unknowns) {
  if (!space.has_open_inlet()) return 1;
  const ReferenceElement<2> face(space.reference().degree());
  double flow = 0, area = 0;
  for (const EndFace& self : end_faces(space, Face::rear, face)) {
    VectorXd w(face.nodes());
    for (int k = 0; k < face.nodes(); ++k) w(k) = space.velocity(self.nodes[k], 0).value(unknowns);
    flow += self.area.dot(face.shape.value * w);
    area += self.area.sum();
  }
  return flow / area + unknowns(space.cell_velocity());
}

}  // namespace rheocyte
