#include "case/channel_flow.h"

#include <cmath>
#include <numbers>

#include "case/scales.h"

namespace rheocyte {

namespace {

// eta / K of eta = K g^(n-1) at the wall's shear rate g (1/s).
double thinning(double width_um, double rate_ul_s, double n) {
  const double width_mm = 1e-3 * width_um;
  const double shear_rate = 8 * rate_ul_s / (width_mm * width_mm * width_mm) * (0.6671 + 0.2121 / n);
  return std::pow(shear_rate, n - 1);
}

double effective_viscosity_mPas(const Flow& flow, double channel_width_um) {
  if (flow.law == LiquidLaw::newtonian) return flow.viscosity_mPas.value();
  return 1e3 * flow.consistency_Pa_sn.value() *
         thinning(channel_width_um, flow.rate_ul_per_s.value(), flow.exponent.value());
}

}  // namespace

ChannelFlow channel_flow_of(const Case& c) {
  const double width = c.channel.width_um ? *c.channel.width_um : tube_radius_um(c) / tube_radius_per_channel_width;
  return {.width_um = width,
          .rate_ul_s = c.flow.rate_ul_per_s.value(),
          .viscosity_mPas = effective_viscosity_mPas(c.flow, width),
          .exponent = c.flow.law == LiquidLaw::power_law ? c.flow.exponent.value() : 1};
}

double consistency_Pa_sn(const ChannelFlow& flow) {
  return 1e-3 * flow.viscosity_mPas / thinning(flow.width_um, flow.rate_ul_s, flow.exponent);
}

double wall_shear_stress_Pa(const ChannelFlow& at) {
  const double R = tube_radius_per_channel_width * at.width_um * 1e-6, n = at.exponent;
  const double shear_rate = 4 * at.rate_ul_s * 1e-9 / (std::numbers::pi * R * R * R) * (3 * n + 1) / (4 * n);
  return consistency_Pa_sn(at) * std::pow(shear_rate, n);
}

double reynolds_number(double density_kg_per_m3, const ChannelFlow& at) {
  const double R = tube_radius_per_channel_width * at.width_um * 1e-6, Q = at.rate_ul_s * 1e-9;
  return density_kg_per_m3 * Q / (std::numbers::pi * R * at.viscosity_mPas * 1e-3);
}

ScaleFactors scale_factors(const ChannelFlow& from, const ChannelFlow& to) {
  const double length = to.width_um / from.width_um, area = length * length, volume = area * length;
  const double load = to.rate_ul_s * to.viscosity_mPas / (from.rate_ul_s * from.viscosity_mPas);
  return {.length = length,
          .area = area,
          .volume = volume,
          .modulus = load / volume,
          .cortex_modulus = load / area,
          .load = load};
}

}  // namespace rheocyte
