// Elongated cells whose shapes are known in closed form, with the tendencies of real ones.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "table/elongated_table.h"

namespace rheocyte::test {

inline TableSpec invented_elongated_spec() {
  return parse_table_spec(
      "[channel]\nsection = \"square\"\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\nviscosity_mPas = 15\n"
      "[cell.bulk]\nlaw = \"neo-hookean\"\n[table]\nidentifier = \"invented\"\n"
      "axial_ratio = [-0.1, 0.0, 0.1, 0.22, 0.35, 0.45]\ncomputed_radii = 7\ncomputed_states = 6\n",
      "spec.toml");
}

/// The flow makes c_3 and some of c_2, the tension c_2; a long cell leaves the flow less to do.
struct InventedElongated {
  double radius_um, axial_ratio, modulus_kPa;

  double compliance() const { return std::pow(radius_um / 6, 1.5) / (10 * modulus_kPa); }
  double mode_2() const { return 0.75 * axial_ratio * (1 - 0.2 * axial_ratio) + 1.5 * compliance() * compliance(); }
  double mode_3() const { return compliance() * (1 - 0.9 * axial_ratio) * (1 + 0.5 * compliance()); }
  double deformation() const { return 0.75 * mode_2() * mode_2() + 2 * mode_3() * mode_3(); }
  double inertia_ratio() const { return 1 + 2 * mode_2() + 0.5 * mode_3() * mode_3(); }
  double area_um2() const { return std::numbers::pi * radius_um * radius_um * (1 + 0.4 * axial_ratio); }
};

inline double invented_softest(double radius_um, double axial_ratio) {
  return std::pow(radius_um / 6, 1.5) * (1 - 0.5 * axial_ratio) / 1.2;
}

inline std::vector<SampledBranch> invented_elongated_branches() {
  const TableSpec spec = invented_elongated_spec();
  std::vector<SampledBranch> branches;
  for (const SweepPoint& place : sweep_places(spec)) {
    SampledBranch branch;
    branch.radius_um = place.radius_um;
    branch.axial_ratio = place.axial_ratio;
    const int states = *spec.computed_states;
    branch.value = Eigen::MatrixXd::Zero(states, measure_count);
    for (int k = 0; k < states; ++k) {
      const double height = 0.05 + 0.95 * std::pow(std::sin(0.5 * std::numbers::pi * k / (states - 1)), 2);
      const InventedElongated cell{place.radius_um, place.axial_ratio,
                                   invented_softest(place.radius_um, place.axial_ratio) / height};
      branch.stiffness.push_back(cell.modulus_kPa);
      branch.error.push_back(1e-4);
      for (const auto& [measure, value] :
           {std::pair(Measure::area_um2, cell.area_um2()), std::pair(Measure::deformation, cell.deformation()),
            std::pair(Measure::named("inertia_ratio"), cell.inertia_ratio()),
            std::pair(Measure::named("mode_2"), cell.mode_2()), std::pair(Measure::named("mode_3"), cell.mode_3())})
        branch.value(k, int(measure)) = value;
    }
    branches.push_back(std::move(branch));
  }
  return branches;
}

inline ElongatedContent invented_elongated_content() {
  return elongated_content(invented_elongated_spec(), invented_elongated_branches(), "test");
}

}  // namespace rheocyte::test
