// The text files of the field's programs from one of rheocyte's own grids alone, without the branches that it was made
// of.
#pragma once
#include "infer/modulus_map.h"
#include "table/table_text.h"

namespace rheocyte {

/// The table on the rows of text_places(), and where it ends at its smooth branches, their ends. UserError if it is not
/// one of rheocyte's own.
TableText text_of_map(const ModulusMap& map);

/// Isoelasticity lines of moduli that spread evenly, where the bare surface is smooth. UserError as above.
TableText lines_of_map(const ModulusMap& map);

}  // namespace rheocyte
