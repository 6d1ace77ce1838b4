#include "sweep/measured_state.h"

#include <algorithm>

#include "shape/curve.h"

namespace rheocyte {
namespace {

constexpr int intervals_per_sector = 64;  // of front and rear, twice as many on top

/// Points at parameters of the sectors front, top, rear that are the same on all meshes: the front has so many edges,
/// the rear as many.
Eigen::MatrixX2d resampled(const Contour& contour, int front) {
  const int edges = int(contour.pieces.size()), top = edges - 2 * front;
  Eigen::MatrixX2d points(4 * intervals_per_sector + 1, 2);
  for (int i = 0; i < points.rows(); ++i) {
    const double sectors = double(i) / intervals_per_sector;
    const double along = front * std::min(sectors, 1.0) + top * std::clamp((sectors - 1) / 2, 0.0, 1.0) +
                         front * std::max(sectors - 3, 0.0);
    const int edge = std::min(int(along), edges - 1);
    points.row(i) = evaluate(contour.pieces[edge], along - edge).transpose();
  }
  return points;
}

/// A top of the tube's mesh has as many edges as front and rear together.
int front_edges(const Contour& contour) { return int(contour.pieces.size()) / 4; }
/// Two quadrilaterals of the duct's mesh lie along the edge of a triangle.
constexpr int front_edges_in_duct = 2;

Eigen::VectorXd physical(const StateNumbers& numbers, const Scales& scales) {
  Eigen::VectorXd value(measure_count);
  for (int m = 0; m < measure_count; ++m) value(m) = table_measures[std::size_t(m)].physical(numbers, scales);
  return value;
}

}  // namespace

MeasuredState measure_state(const Discretisation& space, const Problem& problem, const Scales& scales,
                            const VectorXd& unknowns) {
  const Contour curve = contour(space, unknowns);
  const SurfaceState surface =
      surface_state(space, unknowns, 4 * space.reference().degree() + 1, problem.bulk.rest_stretch);
  const StateNumbers numbers = numbers_of({problem, space, unknowns}, curve, surface);
  return {physical(numbers, scales), scales.length_um() * resampled(curve, front_edges(curve))};
}

MeasuredState measure_state(const StationaryState& state, const Scales& scales) {
  StateNumbers numbers = state;
  numbers.shape.volume = state.volume_of_revolution;
  return {physical(numbers, scales), scales.length_um() * resampled(state.contour, front_edges_in_duct)};
}

}  // namespace rheocyte
