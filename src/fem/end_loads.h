// The parts of the residual that the open ends of the channel have (docs/theory.md, eq:boundary, eq:weak).
#pragma once
#include "fem/discretisation.h"

namespace rheocyte {

/// Traction of the outlet per pressure there, by unknowns.
VectorXd outlet_load(const Discretisation&);

/// Traction of an open inlet per pressure there; zero where velocities are given.
VectorXd inlet_load(const Discretisation&);

/// Pressure at an open inlet that drives the undisturbed flow. The outlet has its negative: the undisturbed pressure
/// vanishes at the cell, and the pressures of cell and liquid stay of the size of the stresses that deform the cell.
double undisturbed_inlet_pressure(const Discretisation&, const Liquid&);

}  // namespace rheocyte
