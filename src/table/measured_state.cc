#include "table/measured_state.h"

#include "shape/curve.h"
#include "solve/describe.h"

namespace rheocyte {
namespace {

constexpr double um_per_m = 1e6;
constexpr int intervals_per_sector = 64;  // of front and rear, twice as many on top

/// Points at parameters of the sectors front, top, rear that are the same on all meshes.
Eigen::MatrixX2d resampled(const Contour& contour) {
  const int edges = int(contour.pieces.size()), quarter = edges / 4;  // a top has as many as front and rear together
  Eigen::MatrixX2d points(4 * intervals_per_sector + 1, 2);
  for (int i = 0; i < points.rows(); ++i) {
    const double along = double(i) / intervals_per_sector * quarter;
    const int edge = std::min(int(along), edges - 1);
    points.row(i) = evaluate(contour.pieces[edge], along - edge).transpose();
  }
  return points;
}

}  // namespace

MeasuredState measure_state(const Discretisation& space, const Problem& problem, const Scales& scales,
                            const VectorXd& unknowns) {
  const Contour curve = contour(space, unknowns);
  const SurfaceState surface = surface_state(space, unknowns, 4 * space.reference().degree() + 1);
  const StateNumbers numbers = numbers_of({problem, problem, space, unknowns}, curve, surface);
  MeasuredState state;
  state.value.resize(measure_count);
  for (int m = 0; m < measure_count; ++m) state.value(m) = table_measures[std::size_t(m)].physical(numbers, scales);
  state.contour = scales.length_m * um_per_m * resampled(curve);
  return state;
}

}  // namespace rheocyte
