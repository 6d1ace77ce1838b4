// The files of a table whose branches are complete.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "table/table_folder.h"

namespace rheocyte {

/// Writes them beside the spec and removes what claims have left; returns sentences about what could not be made.
/// Simple cells: text table, lines of these stiffnesses (none given: chosen by the table), simulations, grid. Combined
/// ones: the table of their shapes. Elongated solids: their states. UserError if a record is damaged or the disk is
/// full.
std::vector<std::string> finish_table(const TableFolder& folder, std::span<const double> levels,
                                      std::string_view version);

/// What it took: states, branches, time, and how branches ended. Two lines.
std::string summary(const TableFolder& folder);

}  // namespace rheocyte
