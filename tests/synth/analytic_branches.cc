#include "synth/analytic_branches.h"

#include <cmath>

#include "shape/outline_shape.h"
#include "shape/radius_modes.h"
#include "synth/analytic_shapes.h"

namespace rheocyte::test {

SampledBranch analytic_branch(double radius_um) {
  constexpr double viscosity = 15;
  const AnalyticShapes model({.flow = {20, 0.04}, .max_deformation = 0.1});
  const auto state = [&](double radius, double stiffness) {
    return std::get<CellShape>(model.shape({radius, stiffness, viscosity}));
  };
  SampledBranch branch;
  branch.radius_um = radius_um;
  constexpr int samples = 16;
  branch.value = Eigen::MatrixXd::Zero(samples, measure_count);
  branch.slope = branch.value;
  for (int i = 0; i < samples; ++i) {
    const double stiffness = 40 * std::pow(4. / 40, i / (samples - 1.)), step = 1e-4;
    const auto here = state(radius_um, stiffness), stiffer = state(radius_um, stiffness * std::exp(step)),
               softer = state(radius_um, stiffness * std::exp(-step));
    branch.stiffness.push_back(stiffness);
    branch.error.push_back(1e-4);
    const auto take = [&](Measure m, double CellShape::*field) {
      branch.value(i, int(m)) = here.*field;
      branch.slope(i, int(m)) = (stiffer.*field - softer.*field) / (2 * step);
    };
    take(Measure::area_um2, &CellShape::area_um2);
    take(Measure::deformation, &CellShape::deformation);
    take(Measure::volume_um3, &CellShape::volume_um3);
    const auto shape_of = [](const CellShape& cell) { return shape_vector(outline_shape(mirrored(cell.meridian))); };
    const ShapeVector shape = shape_of(here), change = (shape_of(stiffer) - shape_of(softer)) / (2 * step);
    const auto ratio = int(Measure::named("inertia_ratio")), mode = int(Measure::named("mode_2"));
    const double moments = shape(int(ShapeFeature::moment_ratio));
    branch.value(i, ratio) = 1 / std::sqrt(moments);
    branch.slope(i, ratio) = -0.5 * change(int(ShapeFeature::moment_ratio)) / (moments * std::sqrt(moments));
    for (int k = 0; k <= last_radius_mode - first_radius_mode; ++k) {
      branch.value(i, mode + k) = shape(int(ShapeFeature::first_mode) + k);
      branch.slope(i, mode + k) = change(int(ShapeFeature::first_mode) + k);
    }
    branch.contour.push_back(here.meridian);
    branch.contour_slope.emplace_back((stiffer.meridian - softer.meridian) / (2 * step));
  }
  branch.end = {Status::covered, "down to 4 kPa"};
  return branch;
}

}  // namespace rheocyte::test
