// Cells in the channel of the published tables and figures: width 20 um (R = 10.94 um), 0.04 ul/s.
#pragma once
#include "case/problem.h"

namespace rheocyte::test {

constexpr double tube_radius_um = 10.94;

struct LaboratoryCell {
  double radius_um, young_modulus_kPa;
  BulkLaw law = BulkLaw::linear;
};

enum class Inertia { none, of_water };  ///< density 0 or 1000 kg/m3

/// In the Newtonian liquid of Mokbel et al. 2017, 15 mPa s.
Problem in_newtonian_liquid(const LaboratoryCell&, Inertia, double accuracy);

/// In the shear-thinning liquid of HE-2D-FEM-22: K = 0.4057 Pa s^n, n = 0.6039 (header of that table), 1000 kg/m3.
Problem in_power_law_liquid(const LaboratoryCell&, double accuracy);

}  // namespace rheocyte::test
