#include "duct/duct_cortex.h"

#include "duct/duct_surface.h"

namespace rheocyte {
namespace {

constexpr int numbers = MembraneFields<double>::count;
using Numbers = std::array<double, numbers>;

Numbers numbers_at(const MatrixXd& slope_s, const MatrixXd& slope_t, int q) {
  return {slope_s(q, 0), slope_s(q, 1), slope_s(q, 2), slope_t(q, 0), slope_t(q, 1), slope_t(q, 2)};
}

std::array<ceres::Jet<double, numbers>, numbers> duals(const Numbers& values) {
  std::array<ceres::Jet<double, numbers>, numbers> result;
  for (int i = 0; i < numbers; ++i) result[i] = {values[i], i};
  return result;
}

}  // namespace

DuctCortex::DuctCortex(const DuctSpace& space)
    : space_(space), reference_(space.reference().degree()), face_of_element_(space.elements().size(), -1) {
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (space.mesh().elements()[e].foot != e) continue;
    face_of_element_[e] = int(faces_.size());
    const auto& nodes = space.nodes().of_element[e];
    Face& face = faces_.emplace_back(Face{{nodes.begin(), nodes.begin() + reference_.nodes()}, {}});
    const MatrixXd rest = positions(face, VectorXd::Zero(space.unknowns()));
    const MatrixXd s = reference_.shape.slope[0] * rest, t = reference_.shape.slope[1] * rest;
    for (int q = 0; q < reference_.points(); ++q)
      face.rest.push_back({s.row(q).squaredNorm(), s.row(q).dot(t.row(q)), t.row(q).squaredNorm()});
  }
}

MatrixXd DuctCortex::positions(const Face& face, const VectorXd& unknowns) const {
  MatrixXd x(face.nodes.size(), 3);
  for (int k = 0; k < x.rows(); ++k) x.row(k) = duct_point(space_, unknowns, face.nodes[k]).transpose();
  return x;
}

std::vector<int> DuctCortex::unknowns_of(int face) const {
  std::vector<int> unknowns;
  for (int c = 0; c < 3; ++c) {
    for (const int node : faces_[face].nodes) unknowns.push_back(space_.displacement(node, c));
  }
  return unknowns;
}

void DuctCortex::integrate(int index, const Cortex& law, const VectorXd& unknowns, Want want,
                           FaceSystem& system) const {
  const Face& face = faces_[index];
  const MatrixXd x = positions(face, unknowns);
  const std::array<const MatrixXd*, 2> slopes{&reference_.shape.slope[0], &reference_.shape.slope[1]};
  const MatrixXd s = *slopes[0] * x, t = *slopes[1] * x;
  const int points = reference_.points(), n = reference_.nodes();
  MatrixXd flux(points, numbers), flux_slopes(points, numbers * numbers);
  for (int q = 0; q < points; ++q) {
    const MembranePoint energy{law, face.rest[q]};
    const double weight = reference_.weights(q);
    if (want == Want::residual) {
      const auto work = value_and_slopes<numbers, double>(energy, numbers_at(s, t, q)).second;
      for (int i = 0; i < numbers; ++i) flux(q, i) = weight * work[i];
      continue;
    }
    const auto work = value_and_slopes<numbers, ceres::Jet<double, numbers>>(energy, duals(numbers_at(s, t, q))).second;
    for (int i = 0; i < numbers; ++i) {
      flux(q, i) = weight * work[i].a;
      for (int j = 0; j < numbers; ++j) flux_slopes(q, i * numbers + j) = weight * work[i].v(j);
    }
  }
  system.residual.setZero(3 * n);
  for (int i = 0; i < numbers; ++i) system.residual.segment(i % 3 * n, n) += slopes[i / 3]->transpose() * flux.col(i);
  if (want == Want::residual) return;
  system.tangent.setZero(3 * n, 3 * n);
  for (int i = 0; i < numbers; ++i) {
    for (int j = 0; j < numbers; ++j) {
      const MatrixXd weighted = flux_slopes.col(i * numbers + j).asDiagonal() * *slopes[j / 3];
      system.tangent.block(i % 3 * n, j % 3 * n, n, n).noalias() += slopes[i / 3]->transpose() * weighted;
    }
  }
}

}  // namespace rheocyte
