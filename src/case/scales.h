// From physical units to the dimensionless problem (docs/theory.md, eq:scales).
#pragma once
#include "case/case.h"
#include "case/physical_scales.h"

namespace rheocyte {

struct Liquid;
struct Problem;
struct WallTable;

/// A square channel of width L and a tube of radius 0.547 L have the same pressure drop (Mokbel et al. 2017).
inline constexpr double tube_radius_per_channel_width = 0.547;

/// The cell's radius must lie between these fractions of the tube's.
inline constexpr double min_radius_ratio = 0.05, max_radius_ratio = 0.965;

/// Fraction of the half width that a cell off the axis may reach.
inline constexpr double max_reach_off_axis = 0.95;
/// How far off the axis a cell may be where the half width is `half`, in the same unit.
inline double max_offset(double half, double cell_radius) { return max_reach_off_axis * half - cell_radius; }

/// Surface tension of the cell, given or a fraction of the modulus of its cortex.
double tension_mN_per_m(const Case&);

/// Elements along the surface of the sphere that a grid of time.grid_um has; 0: not given.
int surface_elements(const Case&);

/// Radius of the tube in um: given, mapped from the width of the square channel, or the least one of the profile.
double tube_radius_um(const Case&);

/// The wall that the cell passes, in um: as given, or the tube of the widths' speeds (docs/theory-time.md, eq:funnel).
WallTable wall_um(const ChannelProfile&);

/// Of a duct, where it varies the least one.
double least_width_um(const Channel&);

/// Of corners of walls in ducts, in units of length: less is a kink within an element.
inline constexpr double least_rounding = 0.3;

/// The wall that the cell passes, in the units of WallTable.
WallTable wall_of(const Case&);

/// The unit of lengths: the tube's radius, or half the lesser of width and height where the duct itself is computed.
double unit_length_um(const Case&);

/// Of the channel, in units of this length.
Extent extent_of(const Case&);

/// R, U = Q / (pi R^2), and S, the stress of the liquid at the shear rate U / R, in SI units. Where the pressure drop
/// is given, U is the mean speed of the liquid without the cell. In a duct of area A they are h, U = Q / A and
/// eta(U/h) U/h, and where the pressure drop is given, Q is that of the tube that lets the same Newtonian flow pass.
Scales scales_of(const Case&);

/// R / U of such a channel that is so many times as large, at this flow rate.
double unit_time_s(const Case&, double length_factor, double rate_ul_s);

/// pi R^2 U, the unit of flow rates.
double unit_rate_ul_per_s(const Scales&);

/// The law of the liquid in SI units; a floor of shear rates stays relative to U/R.
Liquid liquid_of(const Flow&);

/// The dimensionless groups of a complete case.
Problem problem_of(const Case&);

}  // namespace rheocyte
