// Branches whose states are known in closed form, with the tendencies of real ones.
#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte::test {

inline constexpr double tube_um = 10.94;

/// Deformation ~ stiffness^-2 for stiff cells and less for soft ones; larger cells deform more. `bending` lowers it a
/// little.
inline double invented_deformation(double radius_um, double stiffness, double bending = 0) {
  const double q = radius_um / tube_um;
  return 0.2 * q * q * q / (stiffness * stiffness * (1 + 0.5 / stiffness)) * (1 - 1e-7 * bending);
}

inline double invented_area(double radius_um, double deformation) {
  return std::numbers::pi * radius_um * radius_um * (1 + 0.5 * deformation);
}

/// The inverse of the deformation: s^2 + s / 2 = 0.2 q^3 / d.
inline double invented_stiffness(double radius_um, double deformation) {
  const double q = radius_um / tube_um;
  return -0.25 + std::sqrt(0.0625 + 0.2 * q * q * q / deformation);
}

/// The exact answer of a table: the stiffness at an area and a deformation.
inline double invented_modulus(double area_um2, double deformation) {
  return invented_stiffness(std::sqrt(area_um2 / (std::numbers::pi * (1 + 0.5 * deformation))), deformation);
}

/// The deformation of an outline with c_3 alone is 2 c_3^2.
inline double invented_asymmetry(double deformation) { return std::sqrt(deformation / 2); }
inline double invented_mode_2(double deformation) { return 0.3 * deformation; }

/// Of all measures the values (first column) and their slopes with ln(stiffness).
inline Eigen::MatrixX2d invented_state(double radius, double stiffness, double bending = 0) {
  const double d = invented_deformation(radius, stiffness, bending);
  const double slope = d * (-2 + 0.5 / stiffness / (1 + 0.5 / stiffness));
  Eigen::MatrixX2d state = Eigen::MatrixX2d::Zero(measure_count, 2);
  const auto set = [&](Measure m, double value, double by_deformation) {
    state.row(int(m)) << value, by_deformation * slope;
  };
  const double area = invented_area(radius, d), area_by_d = std::numbers::pi * radius * radius * 0.5;
  const double root = std::sqrt(std::numbers::pi * area), perimeter = 2 * root / (1 - d);
  set(Measure::deformation, d, 1);
  set(Measure::deformation_raw, 1.01 * d, 1.01);
  set(Measure::area_um2, area, area_by_d);
  set(Measure::named("area_raw_um2"), 0.999 * area, 0.999 * area_by_d);
  set(Measure::named("perimeter_um"), perimeter, perimeter * (area_by_d / (2 * area) + 1 / (1 - d)));
  set(Measure::volume_um3, 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 0);
  set(Measure::moment_ratio, 1 - 3 * d, -3);
  set(Measure::named("moment_ratio_raw"), 1 - 3.1 * d, -3.1);
  set(Measure::named("inertia_ratio"), 1 + 1.5 * d, 1.5);
  set(Measure::named("mode_2"), invented_mode_2(d), 0.3);
  set(Measure::named("mode_3"), invented_asymmetry(d), 0.5 * invented_asymmetry(d) / d);
  set(Measure::named("mode_5"), 0.1 * invented_asymmetry(d), 0.05 * invented_asymmetry(d) / d);
  set(Measure::named("cell_velocity_m_per_s"), 0.18 + 0.1 * d, 0.1);
  set(Measure::named("additional_pressure_drop_Pa"), 300 - 100 * d, -100);
  set(Measure::min_meridional_stretch, 1 - 3 * d, -3);
  set(Measure::stability_margin, 1 - 5 * d, -5);
  return state;
}

/// An ellipse-like contour, exact in the deformation's first power.
inline Eigen::MatrixX2d invented_contour(double radius, double deformation) {
  const int points = 41;
  Eigen::MatrixX2d contour(points, 2);
  for (int i = 0; i < points; ++i) {
    const double t = std::numbers::pi * i / (points - 1);
    contour.row(i) << radius * (1 + deformation) * std::cos(t), radius * (1 - deformation / 2) * std::sin(t);
  }
  contour(points - 1, 1) = 0;
  return contour;
}

struct InventedSweep {
  double stiffest = 30, softest = 0.3;
  int samples = 24;
  double bending = 0;
  Status end = Status::covered;
};

/// Samples with equal steps of ln(stiffness).
inline SampledBranch invented_branch(double radius, const InventedSweep& sweep = {}) {
  SampledBranch branch;
  branch.radius_um = radius;
  branch.bending_kBT = sweep.bending;
  branch.value.resize(sweep.samples, measure_count);
  branch.slope.resize(sweep.samples, measure_count);
  for (int i = 0; i < sweep.samples; ++i) {
    const double fraction = double(i) / (sweep.samples - 1);
    const double stiffness = sweep.stiffest * std::pow(sweep.softest / sweep.stiffest, fraction);
    const auto state = invented_state(radius, stiffness, sweep.bending);
    branch.stiffness.push_back(stiffness);
    branch.value.row(i) = state.col(0).transpose();
    branch.slope.row(i) = state.col(1).transpose();
    branch.error.push_back(1e-4 * (1 + fraction));
    const double d = state(0, 0);
    branch.contour.push_back(invented_contour(radius, d));
    branch.contour_slope.push_back((invented_contour(radius, d + 0.5) - invented_contour(radius, d - 0.5)) *
                                   state(0, 1));
  }
  branch.end = {sweep.end,
                sweep.end == Status::covered ? "" : "the bare surface has lost its stability, it would wrinkle"};
  branch.solves = 3 * sweep.samples;
  branch.newton_iterations = 10 * sweep.samples;
  branch.seconds = 1.5;
  return branch;
}

/// The stiffness range of a branch that covers the deformations of the spec and a little more.
inline InventedSweep covering(const TableSpec& spec, double radius, int samples = 24) {
  return {1.02 * invented_stiffness(radius, spec.min_deformation),
          0.98 * invented_stiffness(radius, spec.max_deformation), samples};
}

/// One branch for each radius of the spec.
inline std::vector<SampledBranch> invented_branches(const TableSpec& spec, int samples = 24) {
  std::vector<SampledBranch> branches;
  for (const double radius : sweep_radii_um(spec))
    branches.push_back(invented_branch(radius, covering(spec, radius, samples)));
  return branches;
}

/// Deformation at which the bare branch of a radius ends.
inline double invented_end(double radius) { return 0.05 + 0.02 * (radius - 3); }

/// The same, but the bare branches of small cells end at a deformation that rises with the radius; beyond it they go on
/// with bending.
template <class End = double (*)(double)>
std::vector<SampledBranch> invented_unstable_branches(const TableSpec& spec, const End& end_at = invented_end) {
  std::vector<SampledBranch> branches;
  for (const double radius : sweep_radii_um(spec)) {
    const double end = end_at(radius);
    auto sweep = covering(spec, radius);
    if (end >= spec.max_deformation) {
      branches.push_back(invented_branch(radius, sweep));
      continue;
    }
    auto beyond = sweep;
    sweep.softest = invented_stiffness(radius, end);
    sweep.end = Status::surface_unstable;
    branches.push_back(invented_branch(radius, sweep));
    beyond.stiffest = 1.3 * sweep.softest;
    beyond.bending = 1e4;
    branches.push_back(invented_branch(radius, beyond));
  }
  return branches;
}

inline const std::string short_spec = R"([channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
[cell.bulk]
law = "linear"
[table]
identifier = "XX-2D-26"
)";

inline TableSpec spec_of_fifty_radii(std::vector<std::string> settings) {
  settings.insert(settings.begin(), "table.radii=50");
  return parse_table_spec(short_spec, "spec.toml", settings);
}

/// A question to a table.
struct Query {
  double area, deformation;
};

}  // namespace rheocyte::test
