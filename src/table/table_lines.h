// Isoelasticity lines: curves of equal stiffness in the plane of area (or volume) and deformation.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "table/lookup_table.h"

namespace rheocyte {

/// Levels that fill the plane evenly: eleven values with equal steps of stiffness^(-1/2), that is of the fourth root of
/// the deformation, from the one at which the largest cell has a tenth of the greatest deformation to just above the
/// softest state of the cells a tenth of the way up from the smallest ones; three digits, ascending.
std::vector<double> line_levels(const LookupTable&);

/// The states of all radii at a stiffness that lie inside the table's ranges.
std::vector<TableRow> line_at(const LookupTable&, double stiffness);

/// Comments and metadata of a table as files of its lines have them.
TableText header_of_lines(TableText table);

/// Lines in dclab's format, in the order of the levels.
std::string lines_text(const LookupTable&, std::span<const double> levels, Abscissa);

}  // namespace rheocyte
