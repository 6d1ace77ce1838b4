// A channel with its flow, and how the cells of one channel become those of another (docs/theory-extract.md,
// eq:scaling).
#pragma once
#include "case/case.h"

namespace rheocyte {

/// All by which two measurements or simulations of the same cells differ.
struct ChannelFlow {
  double width_um = 0;        ///< of the square channel
  double rate_ul_s = 0;       ///< sample and sheath together
  double viscosity_mPas = 0;  ///< of a shear-thinning liquid the effective one at the wall
  double exponent = 1;        ///< n of eta ~ (shear rate)^(n - 1); 1: Newtonian
};

/// Of a case with a given flow rate. A tube stands for the square channel of the same pressure drop. The effective
/// viscosity of a power-law liquid is that at the wall of the square channel, eta = K g^(n-1) with
/// g = 8 Q / L^3 (0.6671 + 0.2121 / n), by which RT-DC programs compare buffers and tables.
ChannelFlow channel_flow_of(const Case&);

/// K of the power-law liquid that has this effective viscosity and exponent (Pa s^n).
double consistency_Pa_sn(const ChannelFlow&);

/// Shear stress of the liquid at the wall of the tube that stands for the channel, without a cell: eta g with g = 4 Q /
/// (pi R^3), R = tube_radius_per_channel_width times the width; of a power-law liquid K (g (3 n + 1) / (4 n))^n.
double wall_shear_stress_Pa(const ChannelFlow&);

/// rho Q / (pi R eta), with the mean speed and the radius R of the tube that stands for the channel.
double reynolds_number(double density_kg_per_m3, const ChannelFlow&);

/// By what lengths, areas, volumes, moduli of a bulk, moduli and tensions of a cortex, and the product of viscosity and
/// flow rate are multiplied where a state moves from one channel to another; deformations stay. Exact without inertia
/// and bending, between liquids of one exponent.
struct ScaleFactors {
  double length = 1, area = 1, volume = 1, modulus = 1, cortex_modulus = 1, load = 1;
};
ScaleFactors scale_factors(const ChannelFlow& from, const ChannelFlow& to);

}  // namespace rheocyte
