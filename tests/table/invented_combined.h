// A combined table whose cells are known in closed form: outlines of a few modes that grow with 1 / S.
#pragma once
#include <cmath>
#include <numbers>

#include "table/combined_table.h"

namespace rheocyte::test {

/// The outline of a cell in um. The cortex lifts the third mode and lowers the second, the tension changes the fourth.
inline Eigen::MatrixX2d invented_outline(const SweepPoint& place, double stiffness) {
  const auto& [radius, fraction, ratio, axial] = place;
  const double a = 0.3 * std::pow(radius / 8, 1.5) / stiffness, tension = fraction * ratio;
  std::array<double, mode_count> modes{};
  modes[0] = a * (1 - 0.4 * fraction) * (1 + 0.3 * a);
  modes[1] = -a * (0.05 + 0.35 * fraction + 0.3 * tension);
  modes[2] = a * (0.04 - 0.15 * fraction + 0.6 * tension);
  modes[3] = a * (0.1 * fraction * fraction - 0.3 * tension);
  return outline_of_modes(modes, std::numbers::pi * radius * radius * (1 + 0.2 * a), 300);
}

/// ln(area), deformation, Lambda1 / Lambda2, modes.
inline ShapeVector invented_features(const SweepPoint& place, double stiffness) {
  return shape_vector(outline_shape(invented_outline(place, stiffness)));
}

/// States of which the stiffness falls from `stiffest` to this fraction of it; `features_of` a place and a stiffness.
template <class Features>
CombinedBranch invented_branch_of(const SweepPoint& place, int samples, double stiffest, double softest_fraction,
                                  const Features& features_of) {
  CombinedBranch branch{
      place, {}, Eigen::MatrixXd(samples, feature_count), Eigen::MatrixXd(samples, feature_count), {}};
  const double step = 1e-4;
  for (int i = 0; i < samples; ++i) {
    const double S = stiffest * std::pow(softest_fraction, double(i) / (samples - 1));
    branch.stiffness_kPa.push_back(S);
    branch.error.push_back(1e-4);
    const auto exact = [&](double log_step) {
      ShapeVector features = features_of(place, S * std::exp(log_step));
      features(0) = std::exp(features(0));
      return features;
    };
    branch.value.row(i) = exact(0).transpose();
    branch.slope.row(i) = (exact(step) - exact(-step)).transpose() / (2 * step);
  }
  return branch;
}

inline CombinedBranch invented_combined_branch(const SweepPoint& place, int samples = 16) {
  return invented_branch_of(place, samples, 12 * std::pow(place.radius_um / 8, 1.5), 1.0 / 20, invented_features);
}

/// The same states as a sweep gives them: contours from pole to pole, and no modes.
inline SampledBranch invented_combined_samples(const SweepPoint& place, int samples = 16) {
  const CombinedBranch features = invented_combined_branch(place, samples);
  SampledBranch branch;
  branch.radius_um = place.radius_um;
  branch.cortex_fraction = place.cortex_fraction;
  branch.tension_ratio = place.tension_ratio;
  branch.stiffness = features.stiffness_kPa;
  branch.error = features.error;
  branch.value = Eigen::MatrixXd::Zero(samples, measure_count);
  branch.slope = branch.value;
  for (const auto& [feature, measure] : {std::pair(ShapeFeature::area_um2, Measure::area_um2),
                                         std::pair(ShapeFeature::deformation, Measure::deformation),
                                         std::pair(ShapeFeature::moment_ratio, Measure::moment_ratio)}) {
    branch.value.col(int(measure)) = features.value.col(int(feature));
    branch.slope.col(int(measure)) = features.slope.col(int(feature));
  }
  branch.value.col(int(Measure::volume_um3)).setConstant(4 * std::numbers::pi / 3 * std::pow(place.radius_um, 3));
  const double step = 1e-4;
  for (const double S : branch.stiffness) {
    const auto meridian = [&](double log_step) -> Eigen::MatrixX2d {
      const Eigen::MatrixX2d outline = invented_outline(place, S * std::exp(log_step));
      return outline.topRows(outline.rows() / 2 + 1);
    };
    branch.contour.push_back(meridian(0));
    branch.contour_slope.emplace_back((meridian(step) - meridian(-step)) / (2 * step));
  }
  branch.end = {Status::covered, ""};
  return branch;
}

inline const std::string combined_spec = R"([channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15
[cell.bulk]
law = "neo-hookean"
[cell.cortex]
law = "neo-hookean"
bending_kBT = 1e4
[table]
identifier = "XC-2D-26"
cortex_fraction = [0, 0.125, 0.25, 0.5, 0.75, 0.875, 1]
tension_ratio = [0, 0.15, 0.3]
min_area_um2 = 60
max_area_um2 = 220
radii = 9
)";

inline CombinedTable invented_combined_table(std::span<const std::string> settings = {}) {
  CombinedTable table{parse_table_spec(combined_spec, "spec.toml", settings), {}};
  for (const auto& place : sweep_places(table.spec)) table.branches.push_back(invented_combined_branch(place));
  return table;
}

/// The same for all tests of a program: it takes half a second.
inline const CombinedTable& whole_combined_table() {
  static const CombinedTable table = invented_combined_table();
  return table;
}

}  // namespace rheocyte::test
