// The tube's table that a table of a square channel refers to.
#pragma once
#include "table/table_folder.h"

namespace rheocyte {

/// Copies the grid that the spec names as table.tube_table (as in find_table) into the folder, unless it is there.
/// UserError if there is none of that name, or it is not a grid.
void provide_tube_table(const TableFolder& folder);

}  // namespace rheocyte
