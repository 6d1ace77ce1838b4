// Fields on the deformed mesh as a VTU file with high-order cells, for ParaView and for the picture.
#pragma once
#include <string>

#include "fem/nodal_fields.h"

namespace rheocyte {

/// Writes, in um, m/s and Pa: `velocity` (laboratory frame), `velocity_relative` (to the cell), `pressure` (zero at
/// the cell in the undisturbed flow), `stress` (von Mises norm of the elastic stress; 0 in the liquid),
/// `shear_stress` (norm sqrt(s:s/2) of the viscous stress s; 0 in the cell), `displacement`, `region` (0 liquid,
/// 1 cell). In a duct vectors have three components, and there is the part that symmetry leaves: one eighth, say, to be
/// reflected at y = z and z = 0 for the whole. Returns false if the file could not be written.
bool write_fields(const NodalFields&, const std::string& path);

}  // namespace rheocyte
