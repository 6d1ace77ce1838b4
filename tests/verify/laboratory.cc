#include "laboratory.h"

#include "case/problem.h"
#include "case/scales.h"

namespace rheocyte::test {
namespace {

Case in_channel(const LaboratoryCell& cell, double accuracy) {
  Case c;
  c.channel.radius_um = tube_radius_um;
  c.flow.rate_ul_per_s = 0.04;
  c.cell.radius_um = cell.radius_um;
  c.cell.bulk.law = cell.law;
  c.cell.bulk.young_modulus_kPa = cell.young_modulus_kPa;
  c.numerics.accuracy = accuracy;
  return c;
}

constexpr double density_of_water = 1000;

}  // namespace

Problem in_newtonian_liquid(const LaboratoryCell& cell, Inertia inertia, double accuracy) {
  Case c = in_channel(cell, accuracy);
  c.flow.viscosity_mPas = 15;
  c.flow.density_kg_per_m3 = inertia == Inertia::none ? 0 : density_of_water;
  return problem_of(c);
}

Problem in_power_law_liquid(const LaboratoryCell& cell, double accuracy) {
  Case c = in_channel(cell, accuracy);
  c.flow.law = LiquidLaw::power_law;
  c.flow.consistency_Pa_sn = 0.4057;
  c.flow.exponent = 0.6039;
  c.flow.shear_rate_floor = 1e-2;  // a tenth or ten times of it changes d by at most 0.2 %, docs/verification.md
  c.flow.density_kg_per_m3 = density_of_water;
  return problem_of(c);
}

}  // namespace rheocyte::test
