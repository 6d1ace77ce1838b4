// Fields on the deformed mesh as a VTU file with high-order cells, for ParaView and for the picture.
#pragma once
#include <string>

#include "fem/element_integrals.h"

namespace rheocyte {

/// Writes, in um, m/s and Pa: `velocity` (laboratory frame), `velocity_relative` (to the cell), `pressure` (zero at
/// the cell in the undisturbed flow), `stress` (von Mises norm of the elastic stress; 0 in the liquid),
/// `shear_stress` (norm sqrt(s:s/2) of the viscous stress s; 0 in the cell), `displacement`, `region` (0 liquid,
/// 1 cell). Returns false if the file could not be written.
bool write_fields(const Discretisation&, const Media&, const VectorXd& unknowns, const Scales&,
                  const std::string& path);

}  // namespace rheocyte
