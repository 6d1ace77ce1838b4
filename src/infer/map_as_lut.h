// The text files of the field's programs from one of rheocyte's own grids alone, without the branches that it was made
// of.
#pragma once
#include <filesystem>

#include "infer/modulus_map.h"

namespace rheocyte {

struct TableText;

/// The table on the rows of text_places(), and where it ends at its smooth branches, their ends. UserError if it is not
/// one of rheocyte's own.
TableText map_as_lut(const ModulusMap& map);

/// Isoelasticity lines of moduli that spread evenly, where the bare surface is smooth. UserError as above.
TableText lines_of_map(const ModulusMap& map);

/// The files of both; files that are not rheocyte's are kept. UserError as above, and where one cannot be written.
void write_texts_of_map(const ModulusMap& map, const std::filesystem::path& rows, const std::filesystem::path& lines);

}  // namespace rheocyte
