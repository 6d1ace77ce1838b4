// The undisturbed flow of a liquid through a tube of radius 1 (docs/theory.md, eq:developed). Exact for power laws,
// whose floor it leaves out; to 1e-12 for every other law whose stress rises with the shear rate.
#pragma once
#include "laws/liquid.h"

namespace rheocyte {

/// Pressure gradient (positive number) that drives a mean speed.
double undisturbed_pressure_gradient(const Liquid&, double mean_speed = 1);

/// Mean speed that a pressure gradient drives.
double undisturbed_mean_speed(const Liquid&, double pressure_gradient);

/// Axial velocity at distance r from the axis, at mean speed 1.
double undisturbed_velocity(const Liquid&, double r);

/// The unit of stress: that of the liquid at a shear rate.
double stress_at_rate(const Liquid&, double rate);

}  // namespace rheocyte
