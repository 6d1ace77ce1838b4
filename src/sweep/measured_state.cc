#include "sweep/measured_state.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <vector>

#include "shape/curve.h"
#include "solve/duct.h"

namespace rheocyte {
namespace {

constexpr int intervals_per_sector = 64;  // of front and rear, twice as many on top

/// Points at places of the unstressed sphere that are the same on all meshes, by the places between which the pieces
/// lie: the front from 0 to 1, the top to 3, the rear to 4.
Eigen::MatrixX2d resampled(const Contour& contour, const std::vector<double>& ends) {
  assert(ends.size() == contour.pieces.size() + 1);
  Eigen::MatrixX2d points(4 * intervals_per_sector + 1, 2);
  for (int i = 0; i < points.rows(); ++i) {
    const double place = double(i) / intervals_per_sector;
    const auto next = std::upper_bound(ends.begin() + 1, ends.end() - 1, place);
    const auto piece = std::size_t(next - ends.begin()) - 1;
    points.row(i) =
        evaluate(contour.pieces[piece], (place - ends[piece]) / (ends[piece + 1] - ends[piece])).transpose();
  }
  return points;
}

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
  return {physical(numbers, scales), scales.length_um() * resampled(curve, space.mesh().surface_places())};
}

MeasuredState measure_state(const StationaryState& state, const Scales& scales) {
  StateNumbers numbers = state;
  numbers.shape.volume = state.volume_of_revolution;
  return {physical(numbers, scales), scales.length_um() * resampled(state.contour, state.contour_places)};
}

}  // namespace rheocyte
