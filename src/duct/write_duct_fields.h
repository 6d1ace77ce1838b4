// Fields on the deformed mesh of one eighth of the duct as a VTU file with high-order hexahedra, for ParaView.
#pragma once
#include <string>

#include "duct/duct_integrals.h"

namespace rheocyte {

/// Writes the fields of write_fields (fem/write_fields.h), in um, m/s and Pa; vectors have three components. Reflect at
/// y = z and z = 0 for the whole. Returns false if the file could not be written.
bool write_duct_fields(const DuctSpace&, const Media&, const VectorXd& unknowns, const Scales&,
                       const std::string& path);

}  // namespace rheocyte
