// The outlet's part of the residual (docs/theory.md, eq:boundary, eq:weak).
#pragma once
#include "fem/discretisation.h"

namespace rheocyte {

/// Traction of the outlet, whose pressure is chosen so that the undisturbed pressure vanishes at the cell: the
/// pressures of cell and liquid then stay of the size of the stresses that deform the cell. By unknowns.
VectorXd outlet_load(const Discretisation&, const Liquid&);

}  // namespace rheocyte
