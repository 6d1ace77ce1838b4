// The field's HDF5 file of simulations: contours and measures, one group for each modulus (docs/tables.md).
#pragma once
#include <string>
#include <vector>

#include "table/lookup_table.h"

namespace rheocyte {

/// Stiffnesses of the groups: `count` values of equal ratio over the table's range, four digits.
std::vector<double> simulation_levels(const LookupTable&, int count = 64);

/// The bytes of simulations_<identifier>.h5. Equal tables give equal bytes. std::runtime_error if HDF5 fails.
std::string simulations_file(const LookupTable&);

}  // namespace rheocyte
