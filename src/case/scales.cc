#include "case/scales.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/developed_flow.h"

namespace rheocyte {

namespace {

constexpr double m_per_um = 1e-6, m3_per_ul = 1e-9, Pas_per_mPas = 1e-3, Pa_per_kPa = 1e3, N_per_mN = 1e-3;

}  // namespace

double tube_radius_um(const Case& c) {
  if (const auto& radii = c.channel.profile.R_um; !radii.empty()) return *std::ranges::min_element(radii);
  return c.channel.radius_um ? *c.channel.radius_um : tube_radius_per_channel_width * c.channel.width_um.value();
}

double unit_length_um(const Case& c) {
  return c.channel.section == Section::square ? c.channel.width_um.value() / 2 : tube_radius_um(c);
}

int surface_elements(const Case& c) {
  const double grid = c.time.grid_um.value_or(0);
  return grid > 0 ? std::max(8, int(std::ceil(std::numbers::pi * c.cell.radius_um / grid))) : 0;
}

double tension_mN_per_m(const Case& c) {
  const CortexCase& cortex = c.cell.cortex;
  if (cortex.tension_ratio) return *cortex.tension_ratio * cortex.modulus_mN_per_m.value();
  return cortex.tension_mN_per_m.value_or(0);
}

Scales scales_of(const Case& c) {
  const Liquid liquid = liquid_of(c.flow);
  const double R = unit_length_um(c) * m_per_um;
  const double area = (c.channel.section == Section::square ? 4 : std::numbers::pi) * R * R;
  const double rate =
      c.flow.drive == Drive::pressure_drop
          ? undisturbed_mean_speed(liquid, *c.flow.pressure_drop_Pa * R / (*c.channel.length_um * m_per_um))
          : *c.flow.rate_ul_per_s * m3_per_ul / (area * R);
  return {R, rate * R, stress_at_rate(liquid, rate)};
}

double unit_rate_ul_per_s(const Scales& scales) {
  return std::numbers::pi * scales.length_m * scales.length_m * scales.velocity_m_per_s / m3_per_ul;
}

Problem problem_of(const Case& c) {
  const Scales scales = scales_of(c);
  const double U = scales.velocity_m_per_s, S = scales.stress_Pa;
  const double E = c.cell.bulk.young_modulus_kPa.value_or(0) * Pa_per_kPa, R = scales.length_m;

  Problem problem;
  problem.liquid = in_units_of_rate(liquid_of(c.flow), U / R);
  problem.liquid.reynolds = c.flow.density_kg_per_m3 * U * U / S;
  problem.bulk = {.law = c.cell.bulk.law,
                  .shear_modulus = E / (3 * S),
                  .mooney_share = c.cell.bulk.mooney_share.value_or(1),
                  .viscosity = c.cell.viscosity_mPas.value_or(0) * Pas_per_mPas * U / (S * R),
                  .reynolds = c.cell.density_kg_per_m3.value_or(0) * U * U / S};
  problem.cortex = {.law = c.cell.cortex.law,
                    .modulus = c.cell.cortex.modulus_mN_per_m.value_or(0) * N_per_mN / (S * R),
                    .tension = tension_mN_per_m(c) * N_per_mN / (S * R),
                    .bending = c.cell.cortex.bending_kBT * thermal_energy_J / (S * R * R * R)};
  problem.section = c.channel.section;
  problem.camera = c.channel.camera.value_or(Camera::side);
  problem.radius_ratio = c.cell.radius_um / unit_length_um(c);
  problem.drive = c.flow.drive;
  problem.channel_length = c.channel.length_um.value_or(0) / tube_radius_um(c);
  problem.wall = {c.channel.profile.x_um, c.channel.profile.R_um};
  for (auto* column : {&problem.wall.x, &problem.wall.radius})
    for (double& value : *column) value /= tube_radius_um(c);
  problem.accuracy = c.numerics.accuracy;
  return problem;
}

}  // namespace rheocyte
