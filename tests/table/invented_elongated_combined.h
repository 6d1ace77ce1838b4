// A combined table of elongated cells that are known in closed form: outlines of a few modes that the flow makes, drawn
// out by the axial tension.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "invented_combined.h"

namespace rheocyte::test {

/// The outline of a cell in um: that of the flow, drawn out.
inline Eigen::MatrixX2d invented_elongated_outline(const SweepPoint& place, double stiffness) {
  const auto& [radius, fraction, ratio, axial] = place;
  const double a = 0.3 * std::pow(radius / 8, 1.5) / stiffness, tension = fraction * ratio;
  std::array<double, mode_count> modes{};
  modes[0] = 0.8 * a * a;
  modes[1] = a * (0.5 - 0.2 * fraction);
  modes[2] = -a * (0.02 + 0.12 * fraction - 0.2 * tension);
  modes[3] = a * (0.02 + 0.1 * fraction * fraction - 0.1 * tension);
  modes[5] = a * (0.01 - 0.04 * fraction + 0.08 * tension);
  Eigen::MatrixX2d outline = outline_of_modes(modes, std::numbers::pi * radius * radius, 300);
  const double stretch = std::exp(0.5 * axial * (1 - 0.5 * tension));
  outline.col(0) *= stretch;
  outline.col(1) /= std::sqrt(stretch);
  return outline;
}

inline ShapeVector invented_elongated_features(const SweepPoint& place, double stiffness) {
  return shape_vector(outline_shape(invented_elongated_outline(place, stiffness)));
}

inline const std::string elongated_spec = R"([channel]
width_um = 20
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 6
[cell.bulk]
law = "neo-hookean"
[cell.cortex]
law = "neo-hookean"
bending_kBT = 1e4
[table]
identifier = "XC-2D-EL-26"
cortex_fraction = [0, 0.25, 0.5, 0.75]
tension_ratio = [0.05, 0.25, 0.5]
axial_ratio = [-0.1, 0, 0.15, 0.3, 0.45]
min_area_um2 = 80
max_area_um2 = 220
radii = 5
)";

inline CombinedBranch invented_elongated_branch(const SweepPoint& place) {
  return invented_branch_of(place, 12, 10 * std::pow(place.radius_um / 8, 1.5), 0.12, invented_elongated_features);
}

/// The same for all tests of a program: it takes a second.
inline const CombinedTable& whole_elongated_table() {
  static const CombinedTable table = [] {
    CombinedTable made{parse_table_spec(elongated_spec, "spec.toml"), {}};
    for (const auto& place : sweep_places(made.spec)) made.branches.push_back(invented_elongated_branch(place));
    return made;
  }();
  return table;
}

}  // namespace rheocyte::test
