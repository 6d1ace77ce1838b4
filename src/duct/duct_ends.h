// Inlet and outlet of the duct: pressures on them, and what flows through.
#pragma once
#include "duct/duct_space.h"

namespace rheocyte {

/// Area of each free axial test function on the outlet (Face::front) or the inlet (Face::rear), where the mesh ends.
VectorXd duct_end_load(const DuctSpace&, Face);

/// Mean pressure over the plane at an end of the reported duct, in S.
double duct_end_pressure(const DuctSpace&, const VectorXd& unknowns, Face);

/// Mean velocity of the liquid at the inlet, in U; 1 where it is given.
double duct_flow_rate(const DuctSpace&, const VectorXd& unknowns);

}  // namespace rheocyte
