#include "case/scales.h"

#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

constexpr double m_per_um = 1e-6, m3_per_ul = 1e-9, Pas_per_mPas = 1e-3, Pa_per_kPa = 1e3;

double mooney_share(const BulkCase& bulk) {
  switch (bulk.law) {
    case BulkLaw::linear: return 0;
    case BulkLaw::neo_hookean: return 1;
    case BulkLaw::mooney_rivlin: return bulk.mooney_share.value();
  }
  return 1;
}

}  // namespace

double tube_radius_um(const Case& c) {
  return c.channel.radius_um ? *c.channel.radius_um : tube_radius_per_channel_width * c.channel.width_um.value();
}

Scales scales_of(const Case& c) {
  const double R = tube_radius_um(c) * m_per_um;
  const double Q = c.flow.rate_ul_per_s * m3_per_ul;
  const double U = Q / (std::numbers::pi * R * R);
  if (c.flow.law == LiquidLaw::newtonian) return {R, U, c.flow.viscosity_mPas.value() * Pas_per_mPas * U / R};
  return {R, U, c.flow.consistency_Pa_sn.value() * std::pow(U / R, c.flow.exponent.value())};
}

Problem problem_of(const Case& c) {
  const Scales scales = scales_of(c);
  const double U = scales.velocity_m_per_s, S = scales.stress_Pa;
  const double E = c.cell.bulk.young_modulus_kPa * Pa_per_kPa;

  Problem problem;
  problem.radius_ratio = c.cell.radius_um / tube_radius_um(c);
  problem.liquid = c.flow.law;
  if (c.flow.law == LiquidLaw::power_law) {
    problem.exponent = c.flow.exponent.value();
    problem.shear_rate_floor = c.flow.shear_rate_floor.value();
  }
  problem.reynolds = c.flow.density_kg_per_m3 * U * U / S;
  problem.bulk = c.cell.bulk.law;
  problem.shear_modulus = E / (3 * S);
  problem.mooney_share = mooney_share(c.cell.bulk);
  problem.accuracy = c.numerics.accuracy;
  return problem;
}

}  // namespace rheocyte
