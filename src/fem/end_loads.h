// The parts of the residual that the open ends of the channel have (docs/theory.md, eq:boundary, eq:weak).
#pragma once
#include "fem/discretisation.h"

namespace rheocyte {

/// Traction of the outlet, whose pressure is chosen so that the undisturbed pressure vanishes at the cell: the
/// pressures of cell and liquid then stay of the size of the stresses that deform the cell. By unknowns.
VectorXd outlet_load(const Discretisation&, const Liquid&);

/// Traction of an open inlet per pressure there; zero where velocities are given.
VectorXd inlet_load(const Discretisation&);

/// Pressure at an open inlet, with that of outlet_load at the outlet, that drives the undisturbed flow.
double undisturbed_inlet_pressure(const Discretisation&, const Liquid&);

}  // namespace rheocyte
