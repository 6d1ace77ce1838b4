#include "table/measured_state.h"

#include "fem/observe.h"
#include "shape/curve.h"
#include "shape/measures.h"
#include "solve/surface_stability.h"

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
  const ShapeMeasures shape = measure(curve);
  const SurfaceState surface = surface_state(space, unknowns, 4 * space.reference().degree() + 1);
  const double um = scales.length_m * um_per_m;
  const double gradient = undisturbed_pressure_gradient(problem.liquid);
  const double half = space.mesh().geometry().half_length();
  MeasuredState state;
  state.value.resize(measure_count);
  const auto set = [&](Measure m, double value) { state.value(int(m)) = value; };
  set(Measure::deformation, shape.deformation);
  set(Measure::deformation_raw, shape.deformation_raw);
  set(Measure::area_um2, shape.area * um * um);
  set(Measure::area_raw_um2, shape.area_raw * um * um);
  set(Measure::perimeter_um, shape.perimeter * um);
  set(Measure::volume_um3, shape.volume * um * um * um);
  set(Measure::moment_ratio, shape.moment_ratio);
  set(Measure::moment_ratio_raw, shape.moment_ratio_raw);
  set(Measure::inertia_ratio, shape.inertia_ratio);
  set(Measure::cell_velocity_m_per_s, unknowns(space.cell_velocity()) * scales.velocity_m_per_s);
  set(Measure::additional_pressure_drop_Pa, (inlet_pressure(space, unknowns) - gradient * half) * scales.stress_Pa);
  set(Measure::least_meridional_stretch, surface.stretch.col(0).minCoeff());
  set(Measure::stability_margin, stability_margin(problem, surface));
  state.contour = um * resampled(curve);
  return state;
}

}  // namespace rheocyte
