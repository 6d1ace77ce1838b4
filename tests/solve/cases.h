// Cases of RT-DC: a tube of radius 10.94 um (channel of 20 um), 0.04 ul/s of a liquid of 15 mPa s.
#pragma once
#include "case/problem.h"

namespace rheocyte::test {

struct CellInChannel {
  double radius_um = 6;
  double young_modulus_kPa = 4.58;
  double c1_fraction = 0;  ///< 0: linear, 1: neo-Hookean
};

inline Problem problem(const CellInChannel& cell, double accuracy = 1e-3) {
  constexpr double tube_radius_um = 10.94;
  constexpr double stress_Pa = 145.864;  // eta U / R, U = Q / (pi R^2)
  Problem problem;
  problem.radius_ratio = cell.radius_um / tube_radius_um;
  problem.bulk.law = cell.c1_fraction == 0   ? BulkLaw::linear
                     : cell.c1_fraction == 1 ? BulkLaw::neo_hookean
                                             : BulkLaw::mooney_rivlin;
  problem.bulk.c1_fraction = cell.c1_fraction;
  problem.bulk.shear_modulus = 1e3 * cell.young_modulus_kPa / 3 / stress_Pa;
  problem.accuracy = accuracy;
  return problem;
}

/// The same cell in a shear-thinning buffer with inertia.
inline Problem in_power_law_liquid(Problem problem) {
  problem.liquid.law = LiquidLaw::power_law;
  problem.liquid.exponent = 0.6039;
  problem.liquid.reynolds = 0.2;
  return problem;
}

/// The same cell in a liquid of Carreau and Yasuda that thins tenfold round the mean shear rate.
inline Problem in_carreau_liquid(Problem problem, double exponent = 0.5) {
  Liquid liquid{LiquidLaw::carreau, exponent};
  liquid.infinite_viscosity = 0.1;
  liquid.relaxation_time = 1;
  problem.liquid = in_units_of_rate(liquid, 1);
  return problem;
}

}  // namespace rheocyte::test
