#include "case/scales.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "case/problem.h"
#include "case/unit.h"
#include "laws/developed_flow.h"

namespace rheocyte {

namespace {

constexpr double m_per_um = 1e-6, m3_per_ul = 1e-9, Pas_per_mPas = 1e-3, Pa_per_kPa = 1e3, N_per_mN = 1e-3;

/// Radius, in h, of the tube through which a Newtonian liquid flows as fast as through a duct at the same pressure
/// gradient: the Fourier series of the duct's flow.
double radius_of_equal_flow(const Extent& extent) {
  const double wide = std::max(extent.width, extent.height);
  double sum = 0;
  for (int i = 1; i < 200; i += 2) sum += std::tanh(i * std::numbers::pi * wide / 2) / std::pow(i, 5);
  const double flow = 4.0 / 3 * wide * (1 - 192 / std::pow(std::numbers::pi, 5) / wide * sum);
  return std::pow(8 * flow / std::numbers::pi, 0.25);
}

double given_gradient(const Case& c) { return *c.flow.pressure_drop_Pa / (*c.channel.length_um * m_per_um); }

/// Of the channel, in units of length.
double area_of(const Case& c) {
  return is_duct(c.channel.section) ? 4 * extent_of(c).width * extent_of(c).height : std::numbers::pi;
}

/// U / R at the given pressure drop. The area is in units of R^2.
double undisturbed_rate(const Case& c, const Liquid& liquid, double area) {
  const double tube = is_duct(c.channel.section) ? radius_of_equal_flow(extent_of(c)) : 1;
  const double radius_m = tube * unit_length_um(c) * m_per_um;
  return undisturbed_mean_speed(liquid, given_gradient(c) * radius_m) * tube * tube * tube * std::numbers::pi / area;
}

}  // namespace

Liquid liquid_of(const Flow& flow) {
  Liquid liquid;
  liquid.law = flow.law;
  switch (flow.law) {
    case LiquidLaw::newtonian: liquid.viscosity = 1e-3 * flow.viscosity_mPas.value(); break;
    case LiquidLaw::power_law:
      liquid.viscosity = flow.consistency_Pa_sn.value();
      liquid.exponent = flow.exponent.value();
      liquid.shear_rate_floor = flow.shear_rate_floor.value();
      break;
    case LiquidLaw::carreau:
      liquid.viscosity = 1e-3 * flow.zero_shear_viscosity_mPas.value();
      liquid.infinite_viscosity = 1e-3 * flow.infinite_shear_viscosity_mPas.value();
      liquid.relaxation_time = 1e-3 * flow.relaxation_time_ms.value();
      liquid.exponent = flow.exponent.value();
      liquid.yasuda_exponent = flow.yasuda_exponent.value();
      break;
  }
  return liquid;
}

double tube_radius_um(const Case& c) {
  if (const WallTable wall = wall_um(c.channel.profile); !wall.is_straight())
    return *std::ranges::min_element(wall.radius);
  return c.channel.radius_um ? *c.channel.radius_um : tube_radius_per_channel_width * c.channel.width_um.value();
}

WallTable wall_um(const ChannelProfile& profile) {
  if (profile.width_um.empty()) return {profile.x_um, profile.R_um};
  constexpr int parts = 8;  // of a linear change of width, whose radius is no cubic
  const std::vector<double>&x = profile.x_um, &width = profile.width_um;
  const double least = *std::ranges::min_element(width);
  WallTable wall;
  const auto add = [&](double at, double w) {
    wall.x.push_back(at);
    wall.radius.push_back(tube_radius_per_channel_width * std::sqrt(w * least));
  };
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (int k = 0; k < parts; ++k)
      add(std::lerp(x[i], x[i + 1], double(k) / parts), std::lerp(width[i], width[i + 1], double(k) / parts));
  add(x.back(), width.back());
  return wall;
}

double least_width_um(const Channel& channel) {
  const std::vector<double>& widths = channel.profile.width_um;
  return widths.empty() ? channel.width_um.value() : *std::ranges::min_element(widths);
}

WallTable wall_of(const Case& c) {
  const double h = unit_length_um(c);
  WallTable wall = wall_um(c.channel.profile);
  double least = h;
  if (is_duct(c.channel.section) && !wall.is_straight()) {
    wall = {c.channel.profile.x_um, c.channel.profile.width_um,
            c.channel.profile.rounding_um.value_or(least_rounding * h) / h};
    least = least_width_um(c.channel);
  }
  for (double& x : wall.x) x /= h;
  for (double& radius : wall.radius) radius /= least;
  return wall;
}

double unit_length_um(const Case& c) {
  if (!is_duct(c.channel.section)) return tube_radius_um(c);
  const double width = least_width_um(c.channel);
  return std::min(width, c.channel.height_um.value_or(width)) / 2;
}

Extent extent_of(const Case& c) {
  if (c.channel.section != Section::rectangle) return {};
  const double h = unit_length_um(c);
  return {least_width_um(c.channel) / (2 * h), c.channel.height_um.value() / (2 * h)};
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
  const double area = area_of(c);
  const double rate = c.flow.drive == Drive::pressure_drop ? undisturbed_rate(c, liquid, area)
                                                           : *c.flow.rate_ul_per_s * m3_per_ul / (area * R * R * R);
  return {R, rate * R, stress_at_rate(liquid, rate)};
}

double unit_time_s(const Case& c, double length_factor, double rate_ul_s) {
  constexpr double mm_per_um = 1e-3;
  return area_of(c) * std::pow(unit_length_um(c) * mm_per_um * length_factor, 3) / rate_ul_s;
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
  // In time in a duct inertia is left out (docs/theory-time.md, sec. 5).
  const double inertia = is_duct(c.channel.section) && c.time.scheme != TimeScheme::stationary ? 0 : U * U / S;
  problem.liquid.reynolds = c.flow.density_kg_per_m3 * inertia;
  problem.bulk = {.law = c.cell.bulk.law,
                  .shear_modulus = E / (3 * S),
                  .c1_fraction = c.cell.bulk.c1_fraction.value_or(1),
                  .viscosity = c.cell.viscosity_mPas.value_or(0) * Pas_per_mPas * U / (S * R),
                  .reynolds = c.cell.density_kg_per_m3.value_or(0) * inertia,
                  .rest_stretch = std::pow(c.cell.rest_aspect, 2.0 / 3),
                  .stiffening = c.cell.bulk.stiffening.value_or(1)};
  if (const auto kind = c.cell.viscoelasticity; kind == Viscoelasticity::maxwell) {
    problem.bulk.branch_modulus = std::exchange(problem.bulk.shear_modulus, 0);
  } else if (kind == Viscoelasticity::standard_linear_solid) {
    problem.bulk.branch_modulus = c.cell.branch_modulus_kPa.value() * Pa_per_kPa / (3 * S);
  }
  problem.cortex = {.law = c.cell.cortex.law,
                    .modulus = c.cell.cortex.modulus_mN_per_m.value_or(0) * N_per_mN / (S * R),
                    .tension = tension_mN_per_m(c) * N_per_mN / (S * R),
                    .bending = c.cell.cortex.bending_kBT * thermal_energy_J / (S * R * R * R),
                    .rest_stretch = problem.bulk.rest_stretch,
                    .area_constant = c.cell.cortex.area_constant.value_or(1)};
  axial_tension(problem) = c.flow.axial_tension_Pa / S;
  problem.section = c.channel.section;
  problem.extent = extent_of(c);
  problem.camera = camera_of(c.channel);
  problem.radius_ratio = c.cell.radius_um / unit_length_um(c);
  if (!is_centred(c.cell)) problem.offset = (c.cell.offset_um[0] + c.cell.offset_um[1]) / unit_length_um(c);
  problem.place = c.cell.place;
  problem.drive = c.flow.drive;
  if (c.flow.drive == Drive::pressure_drop) problem.pressure_gradient = given_gradient(c) * R / S;
  problem.channel_length = c.channel.length_um.value_or(0) / unit_length_um(c);
  problem.start_stretch = c.time.start_stretch.value_or(1);
  if (const auto& tension_Pa = c.channel.profile.axial_tension_Pa; !tension_Pa.empty()) {
    for (std::size_t i = 0; i < tension_Pa.size(); ++i) {
      problem.tension_profile.x.push_back(c.channel.profile.x_um[i] / unit_length_um(c));
      problem.tension_profile.tension.push_back(tension_Pa[i] / S);
    }
  }
  problem.wall = wall_of(c);
  problem.accuracy = c.numerics.accuracy;
  problem.accuracy_of = c.numerics.accuracy_of.value_or(AccuracyOf::deformation);
  return problem;
}

}  // namespace rheocyte
